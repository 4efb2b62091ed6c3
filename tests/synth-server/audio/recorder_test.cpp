// SPDX-License-Identifier: MIT
#include "synth-server/audio/recorder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>

namespace splash::synth {
namespace {

constexpr int kBlock = 64;

/// Two channels that count: n and -n.
struct Blocks {
  void push(Recorder& recorder) {
    for (int i = 0; i < kBlock; ++i) {
      left[static_cast<std::size_t>(i)] = static_cast<float>(next);
      right[static_cast<std::size_t>(i)] = static_cast<float>(-next);
      ++next;
    }
    const std::array<const float*, 2> channels{left.data(), right.data()};
    recorder.push(channels.data(), kBlock);
  }
  int next = 0;
  std::array<float, kBlock> left{};
  std::array<float, kBlock> right{};
};

TEST(Recorder, WritesEverySampleInOrder) {
  std::vector<float> left;
  std::vector<float> right;
  Recorder recorder(2, 48000, kBlock, 4.0, [&](const float* const* channels, int frames) {
    left.insert(left.end(), channels[0], channels[0] + frames);
    right.insert(right.end(), channels[1], channels[1] + frames);
  });
  Blocks blocks;
  for (int i = 0; i < 1000; ++i) blocks.push(recorder);  // 64000 frames: many chunks
  recorder.finish();
  ASSERT_EQ(left.size(), 64000U);
  ASSERT_EQ(right.size(), 64000U);
  for (int i = 0; i < 64000; ++i) {
    ASSERT_EQ(left[static_cast<std::size_t>(i)], static_cast<float>(i));
    ASSERT_EQ(right[static_cast<std::size_t>(i)], static_cast<float>(-i));
  }
  EXPECT_EQ(recorder.lost_frames(), 0U);
  EXPECT_TRUE(recorder.error().empty());
}

TEST(Recorder, CountsWhatASlowDiskLoses) {
  std::atomic<bool> stalled{true};
  std::int64_t written = 0;
  Recorder recorder(2, 48000, kBlock, 0.1, [&](const float* const*, int frames) {
    while (stalled) std::this_thread::yield();
    written += frames;
  });
  Blocks blocks;
  for (int i = 0; i < 1000; ++i) blocks.push(recorder);
  stalled = false;
  recorder.finish();
  EXPECT_GT(recorder.lost_frames(), 0U);
  EXPECT_EQ(written + static_cast<std::int64_t>(recorder.lost_frames()), 64000);
}

TEST(Recorder, SaysWhyItEnded) {
  Recorder recorder(2, 48000, kBlock, 0.5,
                    [](const float* const*, int) { throw std::runtime_error("disk full"); });
  Blocks blocks;
  for (int i = 0; i < 10; ++i) blocks.push(recorder);
  recorder.finish();
  EXPECT_EQ(recorder.error(), "disk full");
}

}  // namespace
}  // namespace splash::synth
