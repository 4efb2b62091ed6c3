// SPDX-License-Identifier: MIT
// The arithmetic that the verdicts rest on, on series whose answer is known.
#include "tests/validation/series.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace splash::validation {
namespace {

const Column kTime = {0.0, 1.0, 2.0, 3.0, 4.0};

TEST(Series, LinesBetweenPoints) {
  const Column y = {0.0, 2.0, 4.0, 1.0, 1.0};
  EXPECT_DOUBLE_EQ(interpolate(kTime, y, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(interpolate(kTime, y, 2.5), 2.5);
  EXPECT_DOUBLE_EQ(interpolate(kTime, y, -1.0), 0.0);
  EXPECT_DOUBLE_EQ(interpolate(kTime, y, 9.0), 1.0);
  EXPECT_DOUBLE_EQ(first_reach(kTime, y, 3.0), 1.5);
  EXPECT_TRUE(std::isnan(first_reach(kTime, y, 5.0)));
  EXPECT_DOUBLE_EQ(mean_between(kTime, y, 0.5, 2.5), 3.0);
  EXPECT_THROW(static_cast<void>(mean_between(kTime, y, 8.0, 9.0)), std::runtime_error);
  EXPECT_DOUBLE_EQ(largest_between(kTime, y, 2.5, 4.0), 1.0);
}

TEST(Series, CrossingsAndTrends) {
  const Column y = {-1.0, 1.0, 3.0, -3.0, -5.0};
  const Column crossings = zero_crossings(kTime, y);
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_DOUBLE_EQ(crossings[0], 0.5);
  EXPECT_DOUBLE_EQ(crossings[1], 2.5);
  const auto [offset, slope] = fit_line(kTime, combine(3.0, kTime, 2.0, Column(5, 1.0)), 1.0, 4.0);
  EXPECT_NEAR(offset, 2.0, 1e-12);
  EXPECT_NEAR(slope, 3.0, 1e-12);
}

}  // namespace
}  // namespace splash::validation
