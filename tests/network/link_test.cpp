// SPDX-License-Identifier: MIT
// Nine of the 45 cells of loss, duplication and reordering, each with jitter and an outage; all of
// them, ten times over: ./splash bench link.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/network/link_run.hpp"

namespace splash::network {
namespace {

class Link : public testing::TestWithParam<int> {};

// Cell n of nine: every loss, every pair of duplication and reordering.
TEST_P(Link, LosesNothingThatComesAndCountsWhatDoesNot) {
  const auto n = static_cast<std::size_t>(GetParam());
  const double loss = kLosses[n % 5];
  const double duplication = kDuplications[n % 3];
  const double reordering = kReorderings[n / 3];
  const LinkReport report =
      run_link(loss, duplication, reordering, static_cast<std::uint32_t>(100 + n));
  EXPECT_THAT(report.wrong, testing::IsEmpty())
      << "loss " << loss << ", duplication " << duplication << ", reordering " << reordering;
  EXPECT_GT(report.events, 1000U);
  EXPECT_GT(report.lost, 200U) << "the outage at the least";
  EXPECT_GT(report.late, 10U) << "jitter makes some late";
  EXPECT_EQ(report.duplicates > 0, duplication > 0.0);
  EXPECT_EQ(report.too_late > 0, reordering > 0.0) << "held back so long that they are dropped";
}

INSTANTIATE_TEST_SUITE_P(Cells, Link, testing::Range(0, 9));

}  // namespace
}  // namespace splash::network
