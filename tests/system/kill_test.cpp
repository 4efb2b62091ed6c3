// SPDX-License-Identifier: MIT
// Three random kills of either program and both orders of starting; ./splash bench faults does
// more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/system/kills.hpp"

namespace splash::tests {
namespace {

constexpr int kRounds = 3;

void expect_all_well(const Kills& kills, int rounds) {
  EXPECT_EQ(kills.survived, rounds);
  EXPECT_EQ(kills.recovery.size(), static_cast<std::size_t>(rounds));
  EXPECT_THAT(kills.complaints, testing::IsEmpty());
  if (kills.recovery.empty()) return;
  std::cout << "first event after at most "
            << *std::max_element(kills.recovery.begin(), kills.recovery.end()) << " s\n";
}

TEST(Kill, OfSimulatorsLeavesTheSynthPlaying) {
  std::mt19937 random(1);
  const Kills kills = kill_simulators(kRounds, random, [](int) {});
  expect_all_well(kills, kRounds);
  EXPECT_GT(kills.largest_step, 0.0) << "something was heard";
  EXPECT_LE(kills.largest_step, kills.slew_limit) << "no click";
}

TEST(Kill, OfARecordingSimulatorLeavesWholeBundles) {
  const SmallScene scene(plunging());
  const TemporaryFolder folder;
  const std::string log = folder / "killed.osc";
  Simulator simulator({"--scene", scene.path(), "--record", log});
  ASSERT_TRUE(simulator.process().wait_for_text("real time x"));
  simulator.kill();
  const auto entries = protocol::read_log(log);
  ASSERT_GT(entries.size(), 3U);
  // "  2.0 s  450 steps/s  real time x 1.00": so much had been simulated when that was printed.
  const std::string text = simulator.process().output();
  const double told = std::stod(text.substr(text.rfind('\n', text.find("real time x"))));
  // The disc goes in once a second and is heard for a part of it.
  EXPECT_GT(entries.back().seconds, told - 0.8) << "until shortly before";
}

TEST(Kill, OfSynthsLeavesTheSimulatorTelling) {
  std::mt19937 random(2);
  expect_all_well(kill_synths(kRounds, random, [](int) {}), kRounds);
}

TEST(Start, InAnyOrderComesToTheSame) {
  std::mt19937 random(3);
  expect_all_well(start_in_any_order(2, random, [](int) {}), 2);
}

}  // namespace
}  // namespace splash::tests
