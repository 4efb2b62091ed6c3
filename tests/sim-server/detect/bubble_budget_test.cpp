// SPDX-License-Identifier: MIT
#include "sim-server/detect/bubble_draw.hpp"

#include <gtest/gtest.h>

namespace splash::sim {
namespace {

TEST(BubbleBudget, IsSoManyASecond) {
  BubbleBudget budget(300.0);
  int told = 0;
  for (int k = 1; k <= 2000; ++k) {
    const int open = budget.open(0.005 * k);
    budget.spend(open);
    told += open;
  }
  EXPECT_GE(told, 3000);
  EXPECT_LE(told, 3015);
}

TEST(BubbleBudget, KeepsWhatFiftyMillisecondsLeft) {
  BubbleBudget budget(4000.0);
  EXPECT_EQ(budget.open(10.0), 200);
  budget.spend(200);
  EXPECT_EQ(budget.open(10.0051), 20);
  EXPECT_EQ(budget.open(10.0301), 120);
  EXPECT_EQ(budget.open(99.0), 200);
}

TEST(BubbleBudget, LetsOneThroughNowAndThenHoweverSmall) {
  BubbleBudget budget(2.0);
  EXPECT_EQ(budget.open(0.0), 1);
  budget.spend(1);
  EXPECT_EQ(budget.open(0.4), 0);
  EXPECT_EQ(budget.open(0.6), 1);
}

}  // namespace
}  // namespace splash::sim
