// SPDX-License-Identifier: MIT
// Forces in a tank that turns, against the same in double precision, and free flight in it: who
// stands outside sees a straight line.
#include "sim-server/fluid/pressure/tank_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

const TankState kTank = {{0.0, 0.0, 0.0}, {0.7, -1.1, 2.3}, {4.0, 1.0, -3.0}};
const Vector3 kPivot = {0.1, 0.2, -0.1};

class TankTurns : public ::testing::TestWithParam<int> {};

TEST_P(TankTurns, AsTheFormulaSays) {
  Device device(-1, false, GetParam());
  Water water;
  water.scene = tank_scene(0.02, {0.3, 0.3, 0.4}, 0.1);
  water.particles = random_places(333, {0.02, 0.02, 0.02}, {0.28, 0.28, 0.2}, 7);
  water.start(device);
  water.stir(1.0, 3);
  const std::vector<Vector3> places = places_of(*water.fluid);
  const std::vector<Vector3> before = velocities_of(*water.fluid);
  const double dt = 2.0e-3;
  TankTurning turning(device);
  turning.set(device, turn_of(kTank, kPivot, dt));
  turning.push(*water.fluid);
  const std::vector<Vector3> after = velocities_of(*water.fluid);
  EXPECT_EQ(places, places_of(*water.fluid));
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vector3 r = places[i] - kPivot;
    const Vector3 pushed = cross(kTank.spin_rate, r) + cross(kTank.spin, cross(kTank.spin, r));
    const Vector3 wanted = rotate(from_turn(-2.0 * dt * kTank.spin), before[i]) - dt * pushed;
    ASSERT_LT(length(after[i] - wanted), 1.0e-6) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Lanes, TankTurns, kScalarAndVector, lanes_name);

TEST(TankTurn, LetsWhatFliesGoStraightOnForWhoStandsOutside) {
  // In double precision, step by step as the kernel does it: the world turns back by -w t.
  const TankState tank = {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.5}, {0.0, 0.0, 0.0}};
  const Vector3 start = {0.3, 0.0, 0.0}, speed = {0.2, 0.5, 0.0};  // of the world
  Vector3 x = start;
  Vector3 v = speed - cross(tank.spin, start);
  const double dt = 1.0e-4;
  const TankTurn turn = turn_of(tank, {0.0, 0.0, 0.0}, dt);
  for (int step = 0; step < 10000; ++step) {
    Vector3 next = {0.0, 0.0, 0.0};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) {
        next[row] += static_cast<double>(turn.turned[3 * row + k]) * v[k] +
                     static_cast<double>(turn.pushed[3 * row + k]) * x[k];
      }
    }
    v = next;
    x = x + dt * v;
  }
  const Vector3 seen = rotate(from_turn({0.0, 0.0, 1.5}), x);
  EXPECT_LT(length(seen - (start + speed)), 1.0e-3);
}

}  // namespace
}  // namespace splash::sim
