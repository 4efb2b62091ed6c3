// SPDX-License-Identifier: MIT
// Devices that die, race, refuse and come back, without a device.
#include "synth-server/audio/device_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "synth-server/audio/device_choice.hpp"
#include "synth-server/audio/null_output.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

using std::chrono::milliseconds;

/// A null clock that plays a sound card: it can die, race, or claim another rate.
class FakeDevice final : public AudioOutput {
 public:
  struct State {
    std::atomic<bool> dead{false};
    std::atomic<std::uint64_t> extra_frames{0};  ///< frames it claims without calling anybody
    std::atomic<int> alive{0};                   ///< objects that exist
  };
  explicit FakeDevice(State& state, int rate = 48000)
      : state_(state), clock_(2, rate, 64), format_{"fake", "card", 2, rate, 64} {
    ++state_.alive;
  }
  ~FakeDevice() override {
    clock_.stop();
    --state_.alive;
  }
  void start(BlockSource& source) override { clock_.start(source); }
  void stop() noexcept override { clock_.stop(); }
  [[nodiscard]] const AudioFormat& format() const noexcept override { return format_; }
  [[nodiscard]] std::uint64_t frames() const noexcept override {
    if (state_.dead) return 0;
    return clock_.frames() + state_.extra_frames;
  }
  [[nodiscard]] std::string scheduling() const override { return "fake"; }

 private:
  State& state_;
  NullOutput clock_;
  AudioFormat format_;
};

struct Source final : BlockSource {
  void render(const AudioBlock& block) noexcept override {
    if (inside.exchange(true)) overlapped = true;
    restarts += block.restart ? 1 : 0;
    ++blocks;
    inside = false;
  }
  std::atomic<bool> inside{false};
  std::atomic<bool> overlapped{false};
  std::atomic<int> restarts{0};
  std::atomic<int> blocks{0};
};

class DeviceWatchTest : public testing::Test {
 protected:
  std::unique_ptr<DeviceWatch> watch(std::unique_ptr<AudioOutput> first, std::string missing,
                                     milliseconds limits = milliseconds(60)) {
    return std::make_unique<DeviceWatch>(
        source_, std::move(first), std::move(missing),
        [this]() -> std::unique_ptr<AudioOutput> {
          ++attempts_;
          if (!present_) throw DeviceError("no card");
          return std::make_unique<FakeDevice>(next_, rate_);
        },
        [this](const std::string& line) {
          const std::lock_guard lock(mutex_);
          lines_.push_back(line);
        },
        adapt_, WatchSettings{milliseconds(5), limits, milliseconds(20)});
  }
  std::vector<std::string> lines() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

  Source source_;
  FakeDevice::State first_;
  FakeDevice::State next_;
  std::atomic<bool> present_{true};
  std::atomic<int> attempts_{0};
  int rate_ = 48000;
  DeviceWatch::Adapt adapt_;
  std::mutex mutex_;
  std::vector<std::string> lines_;
};

TEST_F(DeviceWatchTest, ReplacesADeadDeviceByTheNullClockAndTakesItBack) {
  present_ = false;
  const auto output = watch(std::make_unique<FakeDevice>(first_), "");
  ASSERT_TRUE(tests::eventually([&] { return source_.blocks > 5; }));
  first_.dead = true;
  ASSERT_TRUE(tests::eventually([&] { return output->losses() == 1; }));
  ASSERT_TRUE(tests::eventually([&] { return output->format().api == "null"; }));
  EXPECT_EQ(first_.alive, 0) << "the dead object is gone before anything else plays";
  const int blocks = source_.blocks;
  EXPECT_TRUE(tests::eventually([&] { return source_.blocks > blocks + 5; }))
      << "the clock goes on";
  EXPECT_TRUE(tests::eventually([&] { return attempts_ > 3; }));
  present_ = true;
  ASSERT_TRUE(tests::eventually([&] { return output->format().api == "fake"; }));
  EXPECT_TRUE(tests::eventually([&] { return source_.restarts == 3; }));
  EXPECT_EQ(output->losses(), 1U);
  EXPECT_FALSE(source_.overlapped);
  EXPECT_EQ(lines().size(), 3U) << "lost, refused (once, not at each attempt), plays";
}

TEST_F(DeviceWatchTest, GivesUpADeviceThatRaces) {
  present_ = false;
  const auto output = watch(std::make_unique<FakeDevice>(first_), "");
  std::atomic<bool> racing{true};
  std::thread racer([&] {
    while (racing) {
      first_.extra_frames += 48000;
      std::this_thread::sleep_for(milliseconds(10));
    }
  });
  EXPECT_TRUE(tests::eventually([&] { return output->losses() == 1; }));
  racing = false;
  racer.join();
}

TEST_F(DeviceWatchTest, TakesADeviceThatAppearsLater) {
  present_ = false;
  const auto output = watch(std::make_unique<NullOutput>(2, 48000, 64), "no card");
  ASSERT_TRUE(tests::eventually([&] { return attempts_ > 2; }));
  EXPECT_TRUE(lines().empty()) << "what is known is not said again";
  present_ = true;
  EXPECT_TRUE(tests::eventually([&] { return output->format().api == "fake"; }));
  EXPECT_EQ(output->losses(), 0U);
}

TEST_F(DeviceWatchTest, RefusesAnotherRate) {
  rate_ = 44100;
  const auto output = watch(std::make_unique<NullOutput>(2, 48000, 64), "no card");
  ASSERT_TRUE(tests::eventually([&] { return !lines().empty(); }));
  EXPECT_THAT(lines().front(), testing::HasSubstr("44100"));
  EXPECT_EQ(output->format().api, "null");
  const int blocks = source_.blocks;
  EXPECT_TRUE(tests::eventually([&] { return source_.blocks > blocks; }));
}

TEST_F(DeviceWatchTest, AdaptsToAnotherRateWhileNothingRenders) {
  Source other;
  std::atomic<int> asked_for{0};
  adapt_ = [&](const AudioFormat& format) -> BlockSource& {
    asked_for = format.sample_rate;
    return other;
  };
  rate_ = 44100;
  const auto output = watch(std::make_unique<NullOutput>(2, 48000, 64), "no card");
  ASSERT_TRUE(tests::eventually([&] { return other.blocks > 5; }));
  EXPECT_EQ(asked_for, 44100);
  const int before = source_.blocks;
  next_.dead = true;  // lost again: what stands in runs at the new rate
  ASSERT_TRUE(tests::eventually([&] { return output->losses() == 1; }));
  EXPECT_EQ(output->format().sample_rate, 44100);
  EXPECT_EQ(source_.blocks, before) << "the old source is not called any more";
}

TEST_F(DeviceWatchTest, LeavesAHealthyDeviceAlone) {
  const auto output = watch(std::make_unique<FakeDevice>(first_), "", milliseconds(10000));
  std::this_thread::sleep_for(milliseconds(150));
  EXPECT_EQ(attempts_, 0);
  EXPECT_EQ(source_.restarts, 1);
}

}  // namespace
}  // namespace splash::synth
