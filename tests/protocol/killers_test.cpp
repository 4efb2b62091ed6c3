// SPDX-License-Identifier: MIT
// Every killer is told by its reason and takes no time.
#include "tests/protocol/killers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <set>

#include "protocol/message.hpp"

namespace splash::protocol {
namespace {

/// Processor time of this thread [s]: a busy machine does not count.
double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Median of what reading it takes [s].
double cost(Bytes packet) {
  std::array<double, 21> times{};
  for (double& time : times) {
    const double start = processor_time();
    (void)decode(packet);
    time = processor_time() - start;
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return times[times.size() / 2];
}

TEST(Killers, AreToldByTheirReason) {
  EXPECT_GE(test::killers().size(), 40U);
  for (const auto& killer : test::killers()) {
    const Refusal refusal = gate(killer.bytes);
    EXPECT_EQ(refusal, killer.why) << killer.name << ": " << describe(refusal);
  }
}

TEST(Killers, GoByEveryReasonThereIs) {
  std::set<Refusal> reasons;
  for (const auto& killer : test::killers()) reasons.insert(killer.why);
  EXPECT_EQ(reasons.size(), static_cast<std::size_t>(Refusal::count_));
}

TEST(Killers, TakeLessThanAMillisecond) {
  double worst = 0.0;
  for (const auto& killer : test::killers()) {
    const double seconds = cost(killer.bytes);
    worst = std::max(worst, seconds);
    EXPECT_LT(seconds, 1e-3) << killer.name;
  }
  RecordProperty("worst_us", std::to_string(1e6 * worst));
}

}  // namespace
}  // namespace splash::protocol
