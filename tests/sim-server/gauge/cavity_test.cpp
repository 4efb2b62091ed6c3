// SPDX-License-Identifier: MIT
// Hollows of known volume: closed, open through a chimney, with a body in them.
#include "sim-server/gauge/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "sim-server/fluid/air/air_cells.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/gauge/lattice.hpp"

namespace splash::sim {
namespace {

constexpr double kRadius = 0.06;
constexpr double kBall = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
const Vector3 kMiddle = {0.1, 0.1, 0.1};
const Tank kTank = {{0.0, 0.0, 0.0}, {0.2, 0.2, 1.0}};

WaterState hollow(double spacing, bool chimney) {
  return lattice_water(kTank.lower, {0.2, 0.2, 0.2}, spacing, [chimney](const Vector3& x) {
    if (length(x - kMiddle) < kRadius) return false;
    return !chimney || x[2] < 0.1 || std::hypot(x[0] - 0.1, x[1] - 0.1) > 0.02;
  });
}

Cavity measure(const WaterState& water, const std::function<bool(const Vector3&)>& solid) {
  const auto points = with_images(water.position, kTank, water.support);
  return find_cavity(points, water, {0.0, 0.0, 0.0}, {0.2, 0.2, 0.2}, solid);
}

bool nothing(const Vector3& /*place*/) {
  return false;
}

TEST(Cavity, OfAClosedBallIsItsVolume) {
  const Cavity cavity = measure(hollow(0.01, false), nothing);
  EXPECT_NEAR(cavity.pocket / kBall, 1.0, 0.1);
  EXPECT_EQ(cavity.pocket, cavity.enclosed);
  EXPECT_EQ(cavity.open, 0.0);
  EXPECT_NEAR(measure(hollow(0.005, false), nothing).pocket / kBall, 1.0, 0.03);
}

TEST(Cavity, IsOpenThroughAChimney) {
  const Cavity cavity = measure(hollow(0.01, true), nothing);
  EXPECT_EQ(cavity.enclosed, 0.0);
  EXPECT_GT(cavity.open, kBall);
}

TEST(Cavity, IsNoneInFullWater) {
  const Cavity cavity = measure(lattice_water(kTank.lower, {0.2, 0.2, 0.2}, 0.01), nothing);
  EXPECT_EQ(cavity.open + cavity.enclosed, 0.0);
}

TEST(Cavity, IsSmallerByTheBodyInIt) {
  const WaterState water = hollow(0.005, false);
  constexpr double kHalf = 0.025;
  const double whole = measure(water, nothing).pocket;
  const double left = measure(water, [](const Vector3& x) {
                        return std::abs(x[0] - 0.1) < kHalf && std::abs(x[1] - 0.1) < kHalf &&
                               std::abs(x[2] - 0.1) < kHalf;
                      }).pocket;
  EXPECT_NEAR(whole - left, 8.0 * kHalf * kHalf * kHalf, 1e-9);
}

TEST(Cavity, PocketIsTheLargest) {
  const WaterState water = lattice_water(kTank.lower, {0.2, 0.2, 0.2}, 0.005, [](const Vector3& x) {
    return length(x - Vector3{0.05, 0.1, 0.1}) > 0.03 && length(x - Vector3{0.14, 0.1, 0.1}) > 0.02;
  });
  const Cavity cavity = measure(water, nothing);
  EXPECT_GT(cavity.enclosed, cavity.pocket);
  EXPECT_NEAR((cavity.enclosed - cavity.pocket) / cavity.pocket, 8.0 / 27.0, 0.1);
}

TEST(AirCells, OpenAirIsThatJoinedToTheTop) {
  for (const bool chimney : {false, true}) {
    const WaterState water = hollow(0.01, chimney);
    AirCells cells({0.0, 0.0, 0.0}, {0.2, 0.2, 0.2}, 0.01, water.support);
    for (const Vector3& point : with_images(water.position, kTank, water.support)) {
      cells.add(point, water.volume());
    }
    cells.fill(nothing);
    const auto in_the_ball = [](const Vector3& x) { return length(x - kMiddle) < kRadius; };
    EXPECT_EQ(cells.any_open(in_the_ball), chimney);
    EXPECT_FALSE(cells.any_open([](const Vector3& x) { return x[2] < 0.02; }));
  }
}

}  // namespace
}  // namespace splash::sim
