// SPDX-License-Identifier: MIT
// Pressures and velocities read out of fields that are known, heights of lattices whose height is
// known, in the open, at walls and in corners, and fronts of columns whose edge is known.
#include "sim-server/gauge/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/fluid/air/air_cells.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/gauge/lattice.hpp"

namespace splash::sim {
namespace {

constexpr double kDepth = 0.2;

WaterState at_rest() {
  WaterState water = lattice_water({0.0, 0.0, 0.0}, {0.1, 0.1, kDepth}, 0.01);
  for (const Vector3& x : water.position) water.pressure.push_back(9810.0 * (kDepth - x[2]));
  return water;
}

TEST(Pressure, OfWaterAtRestIsItsWeightWhereverTheSensorIs) {
  const WaterState water = at_rest();
  for (const Vector3& place :
       {Vector3{0.05, 0.05, 0.1}, Vector3{0.05, 0.05, 0.0}, Vector3{0.0, 0.05, 0.031},
        Vector3{0.1, 0.0, 0.0}, Vector3{0.043, 0.057, 0.17}}) {
    EXPECT_NEAR(pressure_at(water, place), 9810.0 * (kDepth - place[2]), 1.0e-6);
  }
}

TEST(Pressure, OfAFieldThatRisesSidewaysIsItsMeanAround) {
  WaterState water = at_rest();
  water.gravity = {0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    water.pressure[i] = 500.0 + 2000.0 * water.position[i][0];
  }
  EXPECT_NEAR(pressure_at(water, {0.05, 0.05, 0.1}), 600.0, 1.0e-6);
  // Half of the neighbourhood is missing at a wall: the reading comes from half a spacing inside.
  EXPECT_NEAR(pressure_at(water, {0.0, 0.05, 0.1}), 510.0, 5.0);
}

TEST(Pressure, IsNoneWhereThereIsNoWater) {
  const WaterState water = at_rest();
  EXPECT_EQ(pressure_at(water, {0.05, 0.05, kDepth + 0.02}), 0.0);
  EXPECT_EQ(pressure_at(water, {0.05, 0.05, 0.5}), 0.0);
}

TEST(Velocity, IsThatOfAUniformFlowWhereverThereIsWater) {
  WaterState water = at_rest();
  for (Vector3& v : water.velocity) v = {0.3, -0.2, 0.1};
  for (const Vector3& place : {Vector3{0.05, 0.05, 0.1}, Vector3{0.0, 0.03, 0.0}}) {
    EXPECT_NEAR(length(flow_at(water, place).velocity - Vector3{0.3, -0.2, 0.1}), 0.0, 1.0e-12);
  }
  EXPECT_NEAR(flow_at(water, {0.05, 0.05, 0.1}).colour, 1.0, 1.0e-3);
  EXPECT_NEAR(flow_at(water, {0.05, 0.05, kDepth}).colour, 0.5, 0.02);
}

TEST(Velocity, OfAShearIsItsOwnWithinTheWater) {
  WaterState water = at_rest();
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    water.velocity[i] = {2.0 * water.position[i][2], 0.0, 0.0};
  }
  EXPECT_NEAR(flow_at(water, {0.05, 0.05, 0.1}).velocity[0], 0.2, 1.0e-9);
  EXPECT_NEAR(flow_at(water, {0.05, 0.05, 0.0}).velocity[0], 0.01, 0.003) << "half a dp inside";
}

TEST(Velocity, IsNoneWhereThereIsNoWater) {
  WaterState water = at_rest();
  for (Vector3& v : water.velocity) v = {1.0, 0.0, 0.0};
  EXPECT_EQ(flow_at(water, {0.05, 0.05, kDepth + 0.024}).velocity[0], 0.0);
  EXPECT_EQ(flow_at(water, {0.05, 0.05, 0.5}).colour, 0.0);
}

TEST(Pressure, IsNeverBelowThatOfTheAir) {
  WaterState water = at_rest();
  for (double& p : water.pressure) p = 0.0;  // a jet in free fall
  EXPECT_GE(pressure_at(water, {0.05, 0.05, kDepth}), 0.0);
}

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

TEST(Front, IsTheEdgeOfAColumn) {
  const WaterState water = lattice_water({0.2, 0.0, 0.0}, {0.5, 0.06, 0.1}, 0.01);
  EXPECT_NEAR(front_position(water, 0, 1.0, 0.06), 0.5, 1e-12);
  EXPECT_NEAR(front_position(water, 0, -1.0, 0.06), 0.2, 1e-12);
  EXPECT_NEAR(front_position(water, 1, 1.0, 0.3), 0.06, 1e-12);
}

TEST(Front, FollowsAFilmButNoDrops) {
  WaterState water = lattice_water({0.0, 0.0, 0.0}, {0.2, 0.06, 0.1}, 0.01);
  const WaterState film = lattice_water({0.2, 0.0, 0.0}, {0.3, 0.06, 0.01}, 0.01);
  water.position.insert(water.position.end(), film.position.begin(), film.position.end());
  water.position.push_back({0.4, 0.03, 0.005});
  water.position.push_back({0.405, 0.03, 0.005});
  water.position.push_back({0.389, 0.05, 0.005});  // half a row, but not in one slab
  EXPECT_NEAR(front_position(water, 0, 1.0, 0.06), 0.3, 1e-12);
  water.position.push_back({0.402, 0.01, 0.005});  // half a row: a front
  EXPECT_NEAR(front_position(water, 0, 1.0, 0.06), 0.41, 1e-12);
}

TEST(Front, OfTooFewParticlesIsNowhere) {
  const WaterState water = lattice_water({0.0, 0.0, 0.0}, {0.01, 0.02, 0.01}, 0.01);
  EXPECT_TRUE(std::isnan(front_position(water, 0, 1.0, 1.0)));
}

}  // namespace
}  // namespace splash::sim
