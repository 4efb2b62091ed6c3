// SPDX-License-Identifier: MIT
#include "synth-server/audio/null_output.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

struct Listener final : BlockSource {
  void render(const AudioBlock& block) noexcept override {
    if (blocks == 0) first = block.time;
    const double ideal = first + static_cast<double>(blocks) * block.frames / 48000.0;
    worst = std::max(worst, std::abs(block.time - ideal));
    restarts += block.restart ? 1 : 0;
    for (int c = 0; c < 3; ++c) block.channels[c][block.frames - 1] = 1.0F;  // all writable
    ++blocks;
    if (stall_at == blocks) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  double first = 0.0;
  double worst = 0.0;
  int restarts = 0;
  int stall_at = -1;
  std::atomic<int> blocks{0};
};

TEST(NullOutput, AsksAtTheRateOfADeviceAndExactly) {
  NullOutput output(3, 48000, 256);
  Listener listener;
  const auto start = std::chrono::steady_clock::now();
  output.start(listener);
  ASSERT_TRUE(tests::eventually([&] { return listener.blocks >= 100; }));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  output.stop();
  EXPECT_GE(listener.blocks, 100);
  EXPECT_GE(seconds, 99 * 256 / 48000.0) << "never faster than real time";
  EXPECT_LT(listener.worst, 1e-9) << "blocks carry the moment they are due";
  EXPECT_EQ(listener.restarts, 1);
  EXPECT_EQ(output.frames(), static_cast<std::uint64_t>(listener.blocks) * 256);
}

TEST(NullOutput, CatchesUpAfterAStall) {
  NullOutput output(3, 48000, 256);
  Listener listener;
  listener.stall_at = 10;
  output.start(listener);
  ASSERT_TRUE(tests::eventually([&] { return listener.blocks >= 60; }));
  output.stop();
  EXPECT_GE(listener.blocks, 60);
  EXPECT_LT(listener.worst, 1e-9);
}

TEST(NullOutput, StopsAndStartsAgain) {
  NullOutput output(3, 48000, 64);
  Listener listener;
  output.start(listener);
  ASSERT_TRUE(tests::eventually([&] { return listener.blocks >= 2; }));
  output.stop();
  const int blocks = listener.blocks;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(listener.blocks, blocks) << "nothing is called after stop()";
  output.start(listener);
  ASSERT_TRUE(tests::eventually([&] { return listener.blocks >= blocks + 2; }));
  output.stop();
  EXPECT_EQ(listener.restarts, 2);
}

TEST(NullOutput, RefusesNonsense) {
  EXPECT_THROW(NullOutput(0, 48000, 256), std::invalid_argument);
  EXPECT_THROW(NullOutput(2, 0, 256), std::invalid_argument);
  EXPECT_THROW(NullOutput(2, 48000, -1), std::invalid_argument);
}

}  // namespace
}  // namespace splash::synth
