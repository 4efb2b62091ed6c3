// SPDX-License-Identifier: MIT
// 100,000 commands; 100,000,000 by ./splash bench flood.
#include <gtest/gtest.h>

#include "tests/synth-server/receive/queue_run.hpp"

namespace splash::synth {
namespace {

TEST(CommandQueue, LosesAndReordersNothing) {
  constexpr std::uint64_t kItems = 100'000;
  const QueueReport report = run_queue(kItems);
  EXPECT_EQ(report.taken, kItems);
  EXPECT_EQ(report.wrong, 0U);
}

TEST(CommandQueue, RefusesWhenItIsFull) {
  const auto queue = std::make_unique<CommandQueue>();
  std::uint64_t pushed = 0;
  while (queue->push(numbered(pushed))) ++pushed;
  EXPECT_GE(pushed, kCommandCapacity - 1);
  std::uint64_t next = 0;
  queue->consume_all([&](const Command& command) { EXPECT_TRUE(is_number(command, next++)); });
  EXPECT_EQ(next, pushed);
}

}  // namespace
}  // namespace splash::synth
