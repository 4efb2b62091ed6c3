// SPDX-License-Identifier: MIT
// Pressures read out of fields that are known.
#include "sim-server/gauge/sensors.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace splash::sim
