// SPDX-License-Identifier: MIT
#include "tests/validation/sloshing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace splash::validation {
namespace {

constexpr Basin kBasin = {.length = 0.6, .width = 0.12, .depth = 0.1};

TEST(Sloshing, IsToldFromAllElse) {
  // A stream function of the second and fourth mode, which a potential flow has, and a drift
  // across.
  const double k = std::numbers::pi / kBasin.length;
  std::vector<sim::Vector3> places;
  std::vector<sim::Vector3> velocities;
  double square = 0.0;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 10; ++j) {
      const double x = 0.01 * (i + 0.5);
      const double z = 0.01 * (j + 0.5);
      sim::Vector3 v = {0.0, 0.02, 0.0};
      for (const auto& [n, speed] : {std::pair{2.0, 0.05}, std::pair{4.0, -0.03}}) {
        v[0] += speed * std::sin(n * k * x) * std::cosh(n * k * z);
        v[2] -= speed * std::cos(n * k * x) * std::sinh(n * k * z);
      }
      square += v[0] * v[0] + v[2] * v[2];
      places.push_back({x, 0.06, z});
      velocities.push_back(v);
    }
  }
  Parts parts = split(kBasin, places, velocities);
  EXPECT_NEAR(parts.rest, 0.02, 1e-9);
  EXPECT_NEAR(parts.sloshing, std::sqrt(square / 600.0), 1e-9);
  // Motion that turns is none of it.
  for (std::size_t i = 0; i < places.size(); ++i) {
    velocities[i] = {std::sin(k * places[i][0]) * std::cos(10.0 * k * places[i][2]), 0.0, 0.0};
  }
  parts = split(kBasin, places, velocities);
  EXPECT_LT(parts.sloshing, 0.6 * parts.rest);
}

// By hand: omega 4.97 / s; of |u|^2 / k^2 the walls have 0.110, the water 0.00430 m.
TEST(Sloshing, RubsOnWallsAsByHand) {
  EXPECT_NEAR(wall_decay(kBasin, 1.0e-6, 9.81), 0.5 * 1.576e-3 * 0.1099 / 4.295e-3, 1e-4);
}

TEST(Sloshing, DecaysAsItIsMadeTo) {
  Column time;
  Column y;
  for (int k = 0; k < 600; ++k) {
    time.push_back(0.02 * k);
    y.push_back(std::exp(-0.1 * time.back()) * std::sin(5.0 * time.back()));
  }
  EXPECT_NEAR(swing_decay(time, y, 2.0), 0.1, 1e-3);
  EXPECT_TRUE(std::isnan(swing_decay(time, y, 11.0)));
}

}  // namespace
}  // namespace splash::validation
