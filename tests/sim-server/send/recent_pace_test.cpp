// SPDX-License-Identifier: MIT
// The pace of the last second, whatever was before.
#include "sim-server/serve/pacer.hpp"

#include <gtest/gtest.h>

namespace splash::sim {
namespace {

TEST(RecentPace, ForgetsAStallAfterASecond) {
  RecentPace pace;
  EXPECT_EQ(pace.real_time_factor(), 0.0);
  double wall = 100.0;
  double simulated = 0.0;
  std::int64_t steps = 0;
  const auto run = [&](double seconds) {
    for (const double end = wall + seconds - 1.0e-9; wall < end; wall += 0.01) {
      pace.note(wall, simulated, steps);
      simulated += 0.01;
      steps += 4;
    }
  };
  run(3.0);
  EXPECT_NEAR(pace.real_time_factor(), 1.0, 1.0e-6);
  EXPECT_NEAR(pace.steps_per_second(), 400.0, 1.0e-3);
  wall += 5.0;  // stopped
  run(0.5);
  EXPECT_LT(pace.real_time_factor(), 0.2);
  run(0.6);
  EXPECT_NEAR(pace.real_time_factor(), 1.0, 1.0e-6) << "kept up fully for a second";
  EXPECT_NEAR(pace.steps_per_second(), 400.0, 1.0e-3);
}

TEST(RecentPace, KnowsTheFirstSecond) {
  RecentPace pace;
  pace.note(7.0, 0.0, 0);
  EXPECT_EQ(pace.steps_per_second(), 0.0) << "no time has passed";
  pace.note(7.2, 0.1, 30);
  EXPECT_NEAR(pace.real_time_factor(), 0.5, 1.0e-9);
  EXPECT_NEAR(pace.steps_per_second(), 150.0, 1.0e-6);
}

}  // namespace
}  // namespace splash::sim
