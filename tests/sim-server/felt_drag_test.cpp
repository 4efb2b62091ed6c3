// SPDX-License-Identifier: MIT
// The felt force on bodies that are towed through deep water at a steady speed, against the drag of
// experiments; and how much it pulses as they go from cell to cell of the grid.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "sim-server/device/device.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

constexpr double kTowSpeed = 0.5;     ///< [m/s]
constexpr double kTowSpacing = 0.03;  ///< [m]
constexpr double kSide = 0.12;        ///< of the bodies [m]

/// A force's mean, and the rms of the rest [N].
struct TowForce {
  double mean = 0.0;
  double rms = 0.0;
};

/// The force against the motion on a body of that `kind`, from 0.4 to 1.1 s; `gravity` [m/s2].
TowForce towed(const std::string& kind, const std::string& gravity) {
  Device device;
  const std::string wide = std::to_string(kSide);
  const Scene scene = parse_scene(
      "fluid: {settle: never, solver: grid_projected, spacing: " + std::to_string(kTowSpacing) +
          ", gravity: [0, 0, -" + gravity + "]}\n" +
          "tank: {lower: [-0.4, -0.4, 0], upper: [1.2, 0.4, 0.9]}\n"
          "water: [{lower: [-0.4, -0.4, 0], upper: [1.2, 0.4, 0.7]}]\n"
          "bodies:\n  - name: towed\n    shape: {kind: " +
          kind + ", size: [" + wide + ", " + wide + ", " + wide +
          "]}\n    motion: {kind: osc}\n    rest: {position: [0, 0, 0.35]}\n",
      "towed.yaml");
  Simulation simulation(device, scene, {});
  simulation.feel(true);
  int samples = 0;
  double sum = 0.0;
  double squares = 0.0;
  while (simulation.seconds() < 1.1) {
    const double now = simulation.seconds();
    const double way = kTowSpeed * (now < 0.2 ? 2.5 * now * now : now - 0.1);
    static_cast<void>(
        simulation.live_body(0)->push({way, 0.0, 0.35}, {0.0, 0.0, 0.0, 1.0}, {now, {}}));
    const FrameResult frame = simulation.advance();
    if (frame.pushes.empty() || now < 0.4) continue;
    const double force = -frame.pushes[0].force[0];
    ++samples;
    sum += force;
    squares += force * force;
  }
  const double mean = sum / samples;
  return {mean, std::sqrt(squares / samples - mean * mean)};
}

/// rho U^2 / 2 on an area [N].
double stagnation(double area) {
  return 0.5 * 998.0 * kTowSpeed * kTowSpeed * area;
}

/// At Reynolds numbers of some ten thousands a ball has 0.47 and a cube 1.05 (Hoerner 1965).
TEST(FeltDrag, OfABallAndACubeOfFourSpacingsIsAsInExperiments) {
  const TowForce ball = towed("sphere", "0");
  const TowForce cube = towed("box", "0");
  const double of_ball = ball.mean / stagnation(0.25 * std::numbers::pi * kSide * kSide);
  const double of_cube = cube.mean / stagnation(kSide * kSide);
  std::printf("ball: Cd %.2f, pulses %.2f N rms; cube: Cd %.2f, pulses %.2f N rms\n", of_ball,
              ball.rms, of_cube, cube.rms);
  EXPECT_NEAR(of_ball, 0.47, 0.25);
  EXPECT_NEAR(of_cube, 1.05, 0.5);
  EXPECT_LT(ball.rms, 1.0);
  EXPECT_LT(cube.rms, 1.0);
}

/// Though its particles lag behind the body, no hollow opens there under 35 cm of water.
TEST(FeltDrag, IsAsSteadyInWaterThatWeighs) {
  const TowForce cube = towed("box", "9.81");
  std::printf("cube: Cd %.2f, pulses %.2f N rms\n", cube.mean / stagnation(kSide * kSide),
              cube.rms);
  EXPECT_NEAR(cube.mean / stagnation(kSide * kSide), 1.05, 0.5);
  EXPECT_LT(cube.rms, 1.5);
}

}  // namespace
}  // namespace splash::sim
