// SPDX-License-Identifier: MIT
// What a column of water at rest carries and how dense it is.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

// rho = rho0 (1 + g (H - z) / c0^2) carries the weight above. The pressure is a twenty-fifth more
// than rho g z, since the pair forces' gradient among settled particles is that much too weak.
TEST(WeaklyCompressible, AColumnIsAsDenseAndPressesAsItsWeightAsks) {
  Device device;
  const double depth = 0.36;
  Water water = fill(tank_scene(0.02, {0.24, 0.2, 0.5}, depth), PressureKind::weakly_compressible);
  water.start(device);
  let_settle(water);
  run(water, 0.5);
  const FluidStats stats = water.fluid->stats();
  const double bottom = 9.81 * depth / 225.0;
  // It goes on breathing a little: a tenth of the compression, seconds long.
  EXPECT_NEAR(stats.mean_excess, bottom / 2.0, 0.25 * bottom / 2.0);
  EXPECT_LT(stats.max_excess, 1.6 * bottom);
  EXPECT_GT(stats.max_excess, bottom);
  double ratio = 0.0;
  double number = 0.0;
  water.step(1.0e-3, [&](Fluid& fluid) {
    const FluidState state = read_state(fluid);
    for (std::size_t i = 0; i < state.id.size(); ++i) {
      const double under = depth - state.position[i][2];
      if (under < 0.06) continue;
      const double pressure = state.pressure_term[i] * state.density[i] * state.density[i];
      ratio += pressure / (998.0 * 9.81 * under);
      ++number;
    }
  });
  std::printf("mean ratio of the pressure to that of the weight %.3f\n", ratio / number);
  EXPECT_GT(number, 1000.0);
  EXPECT_NEAR(ratio / number, 1.04, 0.03);
}

}  // namespace
}  // namespace splash::sim
