// SPDX-License-Identifier: MIT
#include "sim-server/detect/air_account.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/detect/bubble_draw.hpp"

namespace splash::sim {
namespace {

constexpr double kFrame = 0.005;  ///< [s]

double radius_of(double volume) {
  return std::cbrt(0.75 / std::numbers::pi * volume);
}

// Whatever is drawn, its volumes are the air's, but for the last bubble's.
TEST(AirAccount, IsUsedUpByItsBubbles) {
  const DetectSettings settings;
  AirAccount account;
  double air = 0.0;
  double told = 0.0;
  for (std::uint32_t step = 0; step < 4000; ++step) {
    const double now = step % 400 < 200 ? 2.0e-6 : 0.0;  // [m3]
    account.begin(now, kFrame);
    account.add(now);
    air += now;
    const double largest = account.largest(settings);
    for (int k = 0; account.has_air(); ++k) {
      const double radius = power_law(draw(3, step, 0, k).radius, settings.radius_min, largest,
                                      settings.radius_exponent);
      account.take(radius);
      told += bubble_volume(radius);
    }
    ASSERT_NEAR(account.owed(), air - told, 1e-9 * air);
    ASSERT_LE(told - air, bubble_volume(settings.radius_max));
    ASSERT_GE(told, air * (1.0 - 1e-9));
  }
  EXPECT_NEAR(told / air, 1.0, 0.05);
}

TEST(AirAccount, ItsLargestBubbleHoldsTheAirOfATenthOfASecond) {
  const DetectSettings settings;
  constexpr double kRate = 3.0e-4;  // [m3/s]
  AirAccount account;
  EXPECT_EQ(account.largest(settings), 0.008) << "of no air";
  for (int k = 0; k < 200; ++k) account.begin(kRate * kFrame, kFrame);
  EXPECT_NEAR(account.largest(settings), radius_of(0.1 * kRate), 0.02 * radius_of(0.1 * kRate));
  account.begin(1.0, kFrame);
  EXPECT_EQ(account.largest(settings), settings.radius_max);
  for (int k = 0; k < 600; ++k) account.begin(0.0, kFrame);
  EXPECT_EQ(account.largest(settings), 0.008) << "three seconds later";
}

TEST(AirAccount, StaysWithinTheSettingsRadii) {
  DetectSettings settings = {.radius_max = 0.004};
  EXPECT_EQ(AirAccount().largest(settings), 0.004);
  settings.radius_min = 0.02;
  settings.radius_max = 0.05;
  EXPECT_EQ(AirAccount().largest(settings), 0.04);
}

// What bodies gave the water it may lose without further air, for about a second.
TEST(AirAccount, LeavesOutTheLossOfWhatBodiesGave) {
  AirAccount account;
  EXPECT_EQ(account.own_loss(2.0, 0.0, kFrame), 2.0) << "nobody gave anything";
  EXPECT_EQ(account.own_loss(2.0, 1.5, kFrame), 0.5) << "part of it";
  EXPECT_EQ(account.own_loss(2.0, 0.0, kFrame), 2.0) << "that is used up";
  EXPECT_EQ(account.own_loss(0.0, 10.0, kFrame), 0.0);
  EXPECT_EQ(account.own_loss(1.0, 0.0, 0.5), 0.0);
  const double left = 10.0 * std::exp(-0.5) - 1.0;
  EXPECT_NEAR(account.own_loss(9.0, 0.0, 1.0), 9.0 - left * std::exp(-1.0), 1e-12);
}

TEST(AirAccount, KeepsNoMoreThanItIsToldTo) {
  AirAccount account;
  account.add(5.0e-6);
  account.keep(2.0e-6);
  EXPECT_EQ(account.owed(), 2.0e-6);
  account.keep(3.0e-6);
  EXPECT_EQ(account.owed(), 2.0e-6);
}

}  // namespace
}  // namespace splash::sim
