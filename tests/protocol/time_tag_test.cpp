// SPDX-License-Identifier: MIT
// Time tags against moments that are known, and readings of two clocks while a thread is preempted.
#include "protocol/time_tag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace splash::protocol {
namespace {

TEST(TimeTag, KnownMoments) {
  EXPECT_EQ(to_time_tag(0.0).value, 2208988800ULL << 32U);                  // 1970
  EXPECT_EQ(to_time_tag(0.5).value, (2208988800ULL << 32U) | 0x80000000U);  // half a second on
  EXPECT_EQ(to_time_tag(1700000000.25).value, (3908988800ULL << 32U) | 0x40000000U);
}

TEST(TimeTag, ComesBackWithinAMicrosecond) {
  for (const double time : {0.0, 1.0e9 + 0.123456, 1763638117.999999, 2085978495.75}) {
    EXPECT_NEAR(to_unix_seconds(to_time_tag(time)), time, 5e-7) << time;
  }
}

// 2036-02-07 06:28:16: the seconds wrap, the next era begins (RFC 4330, section 3).
TEST(TimeTag, CrossesTheEra) {
  const double wrap = 4294967296.0 - kNtpUnixOffset;
  EXPECT_EQ(to_time_tag(wrap).value >> 32U, 0U);
  EXPECT_NEAR(to_unix_seconds(to_time_tag(wrap - 0.5)), wrap - 0.5, 1e-6);
  EXPECT_NEAR(to_unix_seconds(to_time_tag(wrap + 1000.5)), wrap + 1000.5, 1e-6);
  const double in_2100 = 4102444800.0;
  EXPECT_NEAR(to_unix_seconds(to_time_tag(in_2100)), in_2100, 1e-6);
}

TEST(TimeTag, AFractionRoundedUpCarries) {
  const double almost = std::nextafter(1.0, 0.0);
  EXPECT_EQ(to_time_tag(almost).value, (2208988801ULL << 32U));
}

TEST(TimeTag, WhatCannotBeSaidIsAtOnce) {
  EXPECT_EQ(to_time_tag(std::numeric_limits<double>::quiet_NaN()), kImmediately);
  EXPECT_EQ(to_time_tag(std::numeric_limits<double>::infinity()), kImmediately);
  EXPECT_EQ(to_time_tag(-3.0e9), kImmediately);
  EXPECT_EQ(to_time_tag(1e300), kImmediately);
}

TEST(ScoreTag, CountsFromZero) {
  EXPECT_EQ(to_score_tag(0.0).value, 0U);
  EXPECT_EQ(to_score_tag(1.5).value, (1ULL << 32U) | 0x80000000U);
  EXPECT_EQ(to_score_tag(-1.0).value, 0U);
  EXPECT_EQ(to_score_tag(std::numeric_limits<double>::quiet_NaN()).value, 0U);
  EXPECT_EQ(to_score_tag(1e12).value, 0xffffffffULL << 32U);
  for (const double time : {0.001, 9.99999, 3600.125, 86400.5}) {
    EXPECT_NEAR(to_score_seconds(to_score_tag(time)), time, 2e-10 + time * 1e-15) << time;
  }
}

constexpr double kEpoch = 1000.0;     ///< the system clock is so far ahead [s]
constexpr double kStep = 1.0e-6;      ///< reading a clock takes [s]
constexpr double kPreempted = 0.010;  ///< and so much longer at the wrong moment [s]
double true_time = 0.0;               // [s]
int monotonic_reads = 0;
int preempted_at = 0;  ///< the reading of the monotonic clock behind which the thread is preempted

double monotonic() {
  true_time += kStep;
  const double read = true_time;
  if (++monotonic_reads == preempted_at) true_time += kPreempted;
  return read;
}

double system_clock() {
  true_time += kStep;
  return kEpoch + true_time;
}

TEST(ClockReading, APreemptedReadingIsNotTaken) {
  for (preempted_at = 0; preempted_at < 9; ++preempted_at) {
    monotonic_reads = 0;
    const ClockReading read = read_clocks(monotonic, system_clock);
    EXPECT_NEAR(read.unix_time - read.monotonic, kEpoch, 2.0 * kStep) << preempted_at;
  }
}

TEST(ClockReading, IsOfNow) {
  const double before = monotonic_now();
  const double unix_before = unix_now();
  const ClockReading read = read_clocks();
  EXPECT_GE(read.monotonic, before);
  EXPECT_LE(read.monotonic, monotonic_now());
  EXPECT_GE(read.unix_time, unix_before);
  EXPECT_LE(read.unix_time, unix_now());
}

}  // namespace
}  // namespace splash::protocol
