// SPDX-License-Identifier: MIT
// Water heights of lattices whose height is known, in the open, at walls and in corners.
#include "sim-server/gauge/sensors.hpp"

#include <gtest/gtest.h>

#include "sim-server/fluid/air/air_cells.hpp"
#include "tests/sim-server/gauge/lattice.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.01;
const Tank kTank = {{0.0, 0.0, 0.0}, {0.1, 0.1, 1.0}};

Height height_at(const WaterState& water, double x, double y) {
  return water_height(with_images(water.position, kTank, water.support), water, x, y, 0.0);
}

TEST(Height, IsThatOfALattice) {
  const WaterState water = lattice_water(kTank.lower, {0.1, 0.1, 0.2}, kSpacing);
  for (const double x : {0.05, 0.043, 0.0, 0.1, 0.003}) {
    for (const double y : {0.05, 0.0}) {
      const Height height = height_at(water, x, y);
      EXPECT_NEAR(height.top, 0.2, 0.1 * kSpacing) << x << ' ' << y;
      EXPECT_NEAR(height.wetted, height.top, 1e-12) << x << ' ' << y;
    }
  }
}

TEST(Height, WithoutImagesAWallTakesHalf) {
  const WaterState water = lattice_water(kTank.lower, {0.1, 0.1, 0.2}, kSpacing);
  EXPECT_LT(water_height(water.position, water, 0.0, 0.0, 0.0).wetted, 0.01);
}

TEST(Height, OfASheetInTheAirIsItsTopAndItsThickness) {
  WaterState water = lattice_water(kTank.lower, {0.1, 0.1, 0.05}, kSpacing);
  const WaterState sheet = lattice_water({0.0, 0.0, 0.15}, {0.1, 0.1, 0.19}, kSpacing);
  water.position.insert(water.position.end(), sheet.position.begin(), sheet.position.end());
  const Height height = height_at(water, 0.05, 0.05);
  EXPECT_NEAR(height.top, 0.19, 0.1 * kSpacing);
  EXPECT_NEAR(height.wetted, 0.09, 0.3 * kSpacing);
}

TEST(Height, OfAFilmIsThatOfItsOneLayer) {
  const WaterState water = lattice_water(kTank.lower, {0.1, 0.1, kSpacing}, kSpacing);
  EXPECT_NEAR(height_at(water, 0.05, 0.05).top, kSpacing, 0.2 * kSpacing);
}

TEST(Height, DoesNotCountDrops) {
  WaterState water = lattice_water(kTank.lower, {0.1, 0.1, 0.05}, kSpacing);
  water.position.push_back({0.05, 0.05, 0.3});
  EXPECT_NEAR(height_at(water, 0.05, 0.05).top, 0.05, 0.1 * kSpacing);
  water.position = {{0.05, 0.05, 0.3}};
  EXPECT_EQ(height_at(water, 0.05, 0.05).top, 0.0);
}

TEST(Height, IsCountedFromTheFloorOfItsPlace) {
  const WaterState water = lattice_water({0.0, 0.0, 0.05}, {0.1, 0.1, 0.15}, kSpacing);
  const Tank raised = {{0.0, 0.0, 0.05}, {0.1, 0.1, 1.0}};
  const auto points = with_images(water.position, raised, water.support);
  EXPECT_NEAR(water_height(points, water, 0.05, 0.05, 0.05).top, 0.1, 0.1 * kSpacing);
}

}  // namespace
}  // namespace splash::sim
