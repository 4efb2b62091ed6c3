// SPDX-License-Identifier: MIT
// A body that goes through deep water parts it, and behind it no gap opens. The bounds for the grid
// are what it reaches, not what is wanted: fluid/pressure/grid_projected/README.md, "Limits".
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "sim-server/gauge/water_state.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

struct Case {
  const char* solver;
  const char* kind;
  double size;    ///< of the body [m]
  double before;  ///< density before it at most [rho0]
  double behind;  ///< how far it may be off behind it [rho0]
  double most;    ///< density of any particle at most [rho0]
};

void PrintTo(const Case& tried, std::ostream* out) {
  *out << tried.solver << ' ' << tried.kind;
}

/// Mean density of the particles around a place of the body.
struct Mean {
  double sum = 0.0;
  int count = 0;
  [[nodiscard]] double density() const { return count > 0 ? sum / count : 0.0; }
};

class MovingBody : public ::testing::TestWithParam<Case> {};

TEST_P(MovingBody, PartsTheWaterAndLeavesNoGap) {
  const Case& tried = GetParam();
  const std::string edge = std::to_string(tried.size);
  const Scene scene = parse_scene("fluid: {spacing: 0.024, solver: " + std::string(tried.solver) +
                                      R"(}
tank: {lower: [0.0, 0.0, 0.0], upper: [1.2, 0.6, 0.9]}
water: [{lower: [0.0, 0.0, 0.0], upper: [1.2, 0.6, 0.6]}]
bodies:
  - name: body
    shape: {kind: )" + tried.kind + ", size: [" +
                                      edge + ", " + edge + ", " + edge + R"(]}
    motion:
      kind: script
      keyframes:
        - {time: 0.0, position: [0.25, 0.3, 0.3]}
        - {time: 1.2, position: [0.85, 0.3, 0.3]}
)",
                                  "through.yaml");
  Device device;
  Simulation simulation(device, scene, {});
  Mean before, behind;
  double most = 0.0, next = 0.3;
  simulation.set_hook([&](Fluid& fluid, Step& /*step*/, Moment moment) {
    const double now = simulation.seconds();
    if (moment != Moment::between || now < next || now > 0.9) return;
    next += 0.02;
    const WaterState water = read_water(fluid, true);
    const BodyState body = simulation.bodies().state(0, now);
    for (std::size_t i = 0; i < water.position.size(); ++i) {
      const Vector3 arm = water.position[i] - body.position;
      const double off = distance_to(scene.bodies[0].shape, arm) / water.spacing;
      const double density = water.density[i] / water.rest_density;
      most = std::max(most, density);
      const double along = arm[0] / length(arm);
      Mean* const mean = along > 0.7 && off < 1.0    ? &before
                         : along < -0.7 && off < 1.5 ? &behind
                                                     : nullptr;
      if (mean == nullptr) continue;
      mean->sum += density;
      ++mean->count;
    }
  });
  while (simulation.seconds() < 1.0) static_cast<void>(simulation.advance());
  std::printf("%s, %s: %.2f before (%d), %.2f behind (%d), at most %.2f rho0\n", tried.solver,
              tried.kind, before.density(), before.count, behind.density(), behind.count, most);
  EXPECT_LT(before.density(), tried.before);
  EXPECT_NEAR(behind.density(), 1.0, tried.behind);
  EXPECT_LT(most, tried.most);
}

constexpr Case kCases[] = {
    {"weakly_compressible", "box", 0.12, 1.05, 0.05, 1.1},
    {"weakly_compressible", "sphere", 0.15, 1.05, 0.05, 1.1},
    {"grid_projected", "box", 0.12, 1.35, 0.15, 2.3},
    {"grid_projected", "sphere", 0.15, 1.3, 0.2, 2.2},
};
INSTANTIATE_TEST_SUITE_P(Solvers, MovingBody, ::testing::ValuesIn(kCases), [](const auto& tried) {
  return std::string(tried.param.solver) + "_" + tried.param.kind;
});

}  // namespace
}  // namespace splash::sim
