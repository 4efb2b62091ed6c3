// SPDX-License-Identifier: MIT
// A tracker puts a body into the midst of the water from one pose to the next: no frame is given
// up, none is computed again, and the water stays water, however fine it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

struct Case {
  const char* solver;
  int spacing;     ///< of the particles [mm]
  double densest;  ///< how much too dense water may be [1]
};

class AppearingBody : public ::testing::TestWithParam<Case> {};

TEST_P(AppearingBody, DrivesTheWaterAway) {
  Device device;
  const Scene scene = parse_scene("fluid: {solver: " + std::string(GetParam().solver) +
                                      ", spacing: " + std::to_string(GetParam().spacing / 1000.0) +
                                      R"(}
tank: {lower: [0.0, 0.0, 0.0], upper: [0.24, 0.24, 0.6]}
water: [{lower: [0.0, 0.0, 0.0], upper: [0.24, 0.24, 0.24]}]
bodies:
  - name: ball
    shape: {kind: sphere, size: [0.1, 0.1, 0.1]}
    rest: {position: [0.12, 0.12, 0.5]}
    motion: {kind: osc}
)",
                                  "appears.yaml");
  Simulation simulation(device, scene, {});
  double densest = 0.0, fastest = 0.0;
  const Vector3 middle = {0.12, 0.12, 0.12};
  while (simulation.seconds() < 0.5) {
    const double now = simulation.seconds();
    if (now > 0.1) {
      static_cast<void>(simulation.live_body(0)->push(middle, {0, 0, 0, 1}, {now, {}}));
    }
    const FrameResult frame = simulation.advance();
    ASSERT_FALSE(frame.step_fault) << describe(*frame.step_fault);
    densest = std::max(densest, frame.stats.max_excess);
    fastest = std::max(fastest, frame.stats.speed);
  }
  std::printf("density at most %.0f %% too high, water at most %.2f m/s fast\n", 100.0 * densest,
              fastest);
  EXPECT_EQ(simulation.totals().retried, 0U);
  EXPECT_EQ(simulation.totals().calmed + simulation.totals().resets, 0U);
  EXPECT_LT(densest, GetParam().densest);
  EXPECT_LT(fastest, 7.0);  // its skin goes at 2 m/s
  EXPECT_LT(length(simulation.bodies().state(0, simulation.seconds()).position - middle), 1.0e-3);
}

constexpr Case kCases[] = {
    {"weakly_compressible", 25, 0.45}, {"weakly_compressible", 20, 0.45},
    {"weakly_compressible", 13, 0.45}, {"weakly_compressible", 9, 0.45},
    {"grid_projected", 25, 0.8},       {"grid_projected", 20, 0.8},
    {"grid_projected", 13, 0.8},       {"grid_projected", 9, 0.8},
};
INSTANTIATE_TEST_SUITE_P(Solvers, AppearingBody, ::testing::ValuesIn(kCases),
                         [](const auto& tried) {
                           return std::string(tried.param.solver) + "_" +
                                  std::to_string(tried.param.spacing);
                         });

}  // namespace
}  // namespace splash::sim
