// SPDX-License-Identifier: MIT
// Fronts of columns whose edge is known.
#include "sim-server/gauge/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim-server/gauge/lattice.hpp"

namespace splash::sim {
namespace {

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
