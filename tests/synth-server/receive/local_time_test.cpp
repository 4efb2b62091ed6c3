// SPDX-License-Identifier: MIT
#include "synth-server/receive/local_time.hpp"

#include <gtest/gtest.h>

namespace splash::synth {
namespace {

struct Clocks {
  double unix_seconds = 1.8e9;
  double monotonic = 5000.0;
  [[nodiscard]] LocalTime make() {
    return LocalTime([this] { return unix_seconds; }, [this] { return monotonic; });
  }
};

TEST(LocalTime, MapsTagsToTheMonotonicClock) {
  Clocks clocks;
  const LocalTime time = clocks.make();
  EXPECT_NEAR(time.monotonic_of(protocol::to_time_tag(1.8e9 + 2.5)), 5002.5, 1e-6);
  EXPECT_NEAR(time.monotonic_of(protocol::to_time_tag(1.8e9 - 7200.0)), -2200.0, 1e-6);
  EXPECT_NEAR(time.unix_of(5010.0), 1.8e9 + 10.0, 1e-6);
}

TEST(LocalTime, KeepsDifferencesOfTagsExactly) {
  Clocks clocks;
  const LocalTime time = clocks.make();
  const protocol::TimeTag first = protocol::to_time_tag(1.8e9 + 0.1);
  const protocol::TimeTag second{first.value + (std::uint64_t{1} << 30U)};  // a quarter second
  EXPECT_NEAR(time.monotonic_of(second) - time.monotonic_of(first), 0.25, 2e-12);
}

TEST(LocalTime, NoticesThatTheClockWasSet) {
  Clocks clocks;
  LocalTime time = clocks.make();
  clocks.unix_seconds += 10.0002;  // slewed by 20 ppm: no step
  clocks.monotonic += 10.0;
  EXPECT_FALSE(time.refresh());
  clocks.unix_seconds += 3600.0;
  EXPECT_TRUE(time.refresh());
  EXPECT_NEAR(time.monotonic_of(protocol::to_time_tag(clocks.unix_seconds)), 5010.0, 1e-6);
  EXPECT_FALSE(time.refresh());
}

}  // namespace
}  // namespace splash::synth
