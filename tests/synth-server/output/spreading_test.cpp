// SPDX-License-Identifier: MIT
// Where events are felt: near tiles only, the nearest most, with the same power everywhere.
#include "synth-server/output/spreading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace splash::synth {
namespace {

Output floor_of_36() {
  Output output;
  output.name = "floor";
  output.kind = OutputKind::tiles;
  output.place = {-0.5, 1.0, 0.0};
  return output;
}

std::vector<double> gains_at(const Output& output, double x, double y) {
  std::vector<double> gains(static_cast<std::size_t>(channel_count(output)), -1.0);
  spread(output, {static_cast<float>(x), static_cast<float>(y), 0.1F}, gains.data());
  return gains;
}

double power(const std::vector<double>& gains) {
  double sum = 0.0;
  for (const double g : gains) sum += g * g;
  return sum;
}

TEST(Tiles, SpreadConstantPowerOverTheWholeFloorAndMoveTheNearestMost) {
  const Output output = floor_of_36();
  const double edge = 6 * 0.305;
  for (double x = 0.001; x < edge; x += 0.047) {
    for (double y = 0.001; y < edge; y += 0.047) {
      const auto gains = gains_at(output, x - 0.5, y + 1.0);
      EXPECT_NEAR(power(gains), 1.0, 1e-9) << x << " " << y;
      const auto nearest = static_cast<int>(y / 0.305) * 6 + static_cast<int>(x / 0.305);
      const auto loudest = std::max_element(gains.begin(), gains.end()) - gains.begin();
      EXPECT_EQ(loudest, nearest) << x << " " << y;
    }
  }
}

TEST(Tiles, AreNumberedAlongXThenRowByRow) {
  const Output output = floor_of_36();
  const auto middle = [](int tile) { return (tile + 0.5) * 0.305; };
  const auto gains = gains_at(output, -0.5 + middle(4), 1.0 + middle(2));
  EXPECT_EQ(std::max_element(gains.begin(), gains.end()) - gains.begin(), 2 * 6 + 4);
}

TEST(Tiles, BeyondReachStayStill) {
  const Output output = floor_of_36();
  const auto gains = gains_at(output, -0.5 + 0.4, 1.0 + 0.4);
  for (int tile = 0; tile < 36; ++tile) {
    const double dx = (tile % 6 + 0.5) * 0.305 - 0.4;
    const double dy = (tile / 6 + 0.5) * 0.305 - 0.4;
    const bool near = std::hypot(dx, dy) < output.reach;
    EXPECT_EQ(gains[static_cast<std::size_t>(tile)] > 0.0, near) << tile;
  }
}

TEST(Tiles, GainsChangeSmoothlyWithThePlace) {
  const Output output = floor_of_36();
  auto last = gains_at(output, -0.5, 1.7);
  for (double x = 0.001; x < 1.83; x += 0.001) {
    const auto gains = gains_at(output, x - 0.5, 1.7);
    for (std::size_t tile = 0; tile < 36; ++tile) EXPECT_NEAR(gains[tile], last[tile], 0.01);
    last = gains;
  }
}

TEST(Tiles, BesideTheFloorTheEdgeSpeaksAndFadesWithDistance) {
  const Output output = floor_of_36();
  const double y = 1.0 + 0.9;
  EXPECT_NEAR(power(gains_at(output, -0.5, y)), 1.0, 1e-9);
  const double near = power(gains_at(output, -0.6, y));
  const double far = power(gains_at(output, -0.8, y));
  EXPECT_LT(near, 1.0);
  EXPECT_LT(far, near);
  EXPECT_GT(far, 0.0);
  EXPECT_EQ(power(gains_at(output, -0.95, y)), 0.0);
}

TEST(Stereo, PansFromLeftToRightWithConstantPower) {
  Output output;
  output.kind = OutputKind::stereo;
  output.place = {1.0, 0.0, 0.0};
  output.width = 2.0;
  for (double x = -1.0; x < 3.0; x += 0.1) EXPECT_NEAR(power(gains_at(output, x, 5)), 1.0, 1e-9);
  EXPECT_NEAR(gains_at(output, 1.0, 0)[0], gains_at(output, 1.0, 0)[1], 1e-6);
  EXPECT_EQ(gains_at(output, -3.0, 0)[1], 0.0);
  EXPECT_NEAR(gains_at(output, 4.0, 0)[0], 0.0, 1e-12);
  EXPECT_GT(gains_at(output, 0.5, 0)[0], gains_at(output, 0.5, 0)[1]) << "left is -x";
}

TEST(Single, HearsEverythingAlike) {
  const Output output;
  EXPECT_EQ(gains_at(output, 100, -100), std::vector<double>{1.0});
}

}  // namespace
}  // namespace splash::synth
