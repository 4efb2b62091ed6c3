// SPDX-License-Identifier: MIT
// Symplectic Euler, the speed limit and the walls, against their formulas in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

struct Moved {
  Vector3 x = {};
  Vector3 v = {};
  bool on_edge = false;  ///< of a wall's decision: rounding may take either side
};

Moved reference_integrate(const FluidParams& p, const Vector3& x0, const Vector3& v0,
                          const Vector3& a, double dt, const PistonState& piston) {
  Moved m;
  m.v = v0 + dt * a;
  const double limit = static_cast<double>(p.speed_limit);
  if (length(m.v) > limit) m.v = (limit / length(m.v)) * m.v;
  m.x = x0 + dt * m.v;
  const double least = 0.05 * static_cast<double>(p.spacing);
  for (int k = 0; k < p.wall_count; ++k) {
    const double d = wall_distance(p, k, m.x, piston.offset);
    m.on_edge = m.on_edge || std::abs(d - least) < 1.0e-6;
    if (d >= least) continue;
    const Vector3 normal = vector(p.walls[k].nx, p.walls[k].ny, p.walls[k].nz);
    m.x = m.x + (least - d) * normal;
    const double into = dot(m.v, normal) - (k == p.piston ? piston.speed : 0.0);
    m.v = m.v - std::min(into, 0.0) * normal;
  }
  return m;
}

class Integrate : public ::testing::Test {
 protected:
  /// Steps once and compares every particle; returns how many met a wall or the speed limit.
  void compare(Water& water, double activity, double dt) {
    water.start(device_);
    water.stir(activity, 21);
    FluidState state;
    water.step(dt, [&](Fluid& fluid) { state = read_state(fluid); });
    const std::vector<Vector3> a = read_acceleration(*water.fluid);
    const std::vector<Vector3> places = places_of(*water.fluid);
    const std::vector<Vector3> velocities = velocities_of(*water.fluid);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Moved reference = reference_integrate(state.params, state.position[i],
                                                  state.velocity[i], a[i], dt, water.piston);
      const Vector3 free = state.velocity[i] + dt * a[i];
      limited_ += length(free) > static_cast<double>(state.params.speed_limit);
      stopped_ += length(reference.v - free) > 1.0e-3;
      if (reference.on_edge) continue;
      const auto id = static_cast<std::size_t>(state.id[i]);
      ASSERT_LT(length(places[id] - reference.x), 1.0e-6 * (1.0 + length(reference.x)))
          << "particle " << id;
      // Far from rest an acceleration is large; its part of v rounds with it.
      ASSERT_LT(length(velocities[id] - reference.v), 1.0e-6 * (1.0 + length(free)))
          << "particle " << id;
    }
  }

  Device device_;
  int limited_ = 0;
  int stopped_ = 0;
};

TEST_F(Integrate, IsTheFormulaInAFreeCrowd) {
  Water water = crowd();
  compare(water, 0.5, 1.0e-4);
}

TEST_F(Integrate, StopsAtWallsSlopeAndPiston) {
  Water water = beach();
  compare(water, 4.0, 3.0e-3);
  EXPECT_GT(stopped_, 50);
  for (const Vector3& x : places_of(*water.fluid)) {
    EXPECT_GT(x[2], 0.0);
    EXPECT_GT(x[1], 0.0);
    EXPECT_LT(x[1], 0.2);
  }
}

TEST_F(Integrate, KeepsTheSpeedLimit) {
  Water water = spray();
  compare(water, 14.0, 1.0e-4);
  EXPECT_GT(limited_, 20);
}

}  // namespace
}  // namespace splash::sim
