// SPDX-License-Identifier: MIT
// A free mesh in the whole simulation: it floats as deep as it has to, and stays upright.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.02;
constexpr double kTank = 0.4;   ///< edge [m]
constexpr double kLevel = 0.2;  ///< of the water without the body [m]
constexpr double kDensity = 499.0;

/// A slab afloat, as a box.
Scene slab() {
  return parse_scene(R"(
fluid: {spacing: 0.02, solver: weakly_compressible}
tank: {lower: [0.0, 0.0, 0.0], upper: [0.4, 0.4, 0.5]}
water:
  - {lower: [0.0, 0.0, 0.0], upper: [0.4, 0.4, 0.2]}
bodies:
  - name: slab
    shape: {size: [0.2, 0.16, 0.1]}
    rest: {position: [0.2, 0.2, 0.2]}
    motion: {kind: free, density: 499}
)",
                     "slab.yaml");
}

/// By how much deeper it lies than it should, over the last second [m].
double excess_draught(const Shape& shape, const Quaternion& turn) {
  Device device;
  Scene scene = slab();
  scene.bodies[0].shape = shape;
  scene.bodies[0].rest.rotation = turn;
  Simulation simulation(device, scene, {});
  double height = 0.0;
  int count = 0;
  while (simulation.seconds() < 2.5) {
    const FrameResult frame = simulation.advance();
    EXPECT_FALSE(frame.step_fault) << describe(*frame.step_fault);
    if (simulation.seconds() < 1.5) continue;
    height += simulation.bodies().state(0, simulation.seconds()).position[2];
    ++count;
  }
  const BodyState end = simulation.bodies().state(0, simulation.seconds());
  const Quaternion tilted = compose(end.rotation, inverse(turn));
  EXPECT_GT(rotate(tilted, {0.0, 0.0, 1.0})[2], 0.995) << "upright";
  // What it displaced at rest has been cut from the water, half of it: the level stands.
  const double wet = 0.5 * 0.1 * kDensity / 499.0;
  const double raised = kLevel + 0.2 * 0.16 * (wet - 0.05) / (kTank * kTank);
  return raised - (height / count - 0.05 + wet);
}

TEST(FreeMesh, AskewInItsFileFloatsAsDeepAsABox) {
  const Quaternion turn = from_turn({0.4, -0.7, 0.2});
  const TriangleMesh askew = placed(box_mesh({0.2, 0.16, 0.1}), turn, {0.0, 0.0, 0.0});
  const double excess = excess_draught(mesh_shape(make_solid(askew, kSpacing)), inverse(turn));
  std::printf("too deep, in spacings: %.3f\n", excess / kSpacing);
  EXPECT_LT(std::abs(excess), 0.5 * kSpacing);
}

}  // namespace
}  // namespace splash::sim
