// SPDX-License-Identifier: MIT
#include "protocol/time_tag.hpp"

#include <gtest/gtest.h>

namespace splash::protocol {
namespace {

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
