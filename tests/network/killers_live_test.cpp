// SPDX-License-Identifier: MIT
// The killers against both real programs, while they play: neither ends, stalls or miscounts.
#include <gtest/gtest.h>

#include "tests/protocol/killers.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"

namespace splash::network {
namespace {

using protocol::Message;
using protocol::test::Killer;
using protocol::test::killers;

TEST(LiveKillers, LeaveBothProgramsAtWork) {
  tests::Synth synth({"--rig", tests::rig_path("stereo.yaml"), "--device", "null"});
  const tests::SmallScene scene(tests::plunging());
  tests::Simulator simulator(
      {"--scene", scene.path(), "--target", protocol::to_string(synth.endpoint())});
  std::uint64_t deadly = 0;
  for (const Killer& killer : killers()) {
    synth.send(killer.bytes);
    simulator.send(killer.bytes);
    deadly += killer.why == protocol::Refusal::none ? 0U : 1U;
  }
  for (const int sequence : {0, 0, 5}) {
    synth.send(
        protocol::encode(protocol::kImmediately,
                         {protocol::to_message(protocol::Frame{1, sequence, sequence, 0.0F}),
                          protocol::to_message(protocol::Bubble{1, 0, 0.01F, 0.05F, {}, 0.0F})}));
  }
  EXPECT_EQ(synth.ask({"/sync", {7}}, "/synced"), (Message{"/synced", {7}}));
  EXPECT_EQ(simulator.ask({"/sync", {7}}, "/synced"), (Message{"/synced", {7}}));
  const auto heard = synth.status();
  EXPECT_EQ(heard.refused, deadly + 1) << "and an address that it does not know";
  EXPECT_EQ(heard.duplicates, 1U);
  EXPECT_EQ(heard.lost, 4U);
  EXPECT_EQ(simulator.status().refused, deadly + 1);
  EXPECT_TRUE(synth.process().running()) << synth.process().output();
  EXPECT_TRUE(simulator.process().running()) << simulator.process().output();
}

}  // namespace
}  // namespace splash::network
