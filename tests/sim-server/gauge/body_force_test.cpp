// SPDX-License-Identifier: MIT
// The force on a body: of one pair by hand, and the weight of the water it displaces.
#include "sim-server/gauge/body_push.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/device/device.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/sim-server/gauge/lattice.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

/// One particle at (0.012, 0, 0) and two points of different bodies.
struct Pair {
  WaterState water = lattice_water({0.007, -0.005, -0.005}, {0.017, 0.005, 0.005}, 0.01);
  std::vector<BodyPoint> points;
  BodyState state;

  Pair() {
    water.density = {1005.0};
    water.image = {1.5};
    water.slope = {{0.0, 0.0, 0.0}};
    water.pressure = {2000.0};
    points.resize(2);
    points[0].place = {0.0, 0.002, 0.0};
    points[0].volume = 3.0e-7;
    points[1].place = {0.004, 0.002, 0.0};
    points[1].owner = 1;
    points[1].volume = 1.0;
    state.position = {0.0, -0.002, 0.0};
  }
};

/// dW/dr by differences.
double slope(double r, double support) {
  const double step = 1.0e-7;
  return (kernel_value(r + step, support) - kernel_value(r - step, support)) / (2.0 * step);
}

TEST(BodyForce, OfOnePairIsItsPressureTimesTheKernelsSlope) {
  const Pair pair;
  ASSERT_EQ(pair.water.position.size(), 1U);
  const BodyForce found = body_force(pair.water, pair.points, 0, pair.state);
  const double expected = pair.water.mass * 1000.0 * 3.0e-7 * 1.5 * 2000.0 / (1005.0 * 1005.0) *
                          slope(0.012, pair.water.support);
  EXPECT_NEAR(found.force[0] / expected, 1.0, 1e-5) << "pushed towards -x";
  EXPECT_LT(found.force[0], 0.0);
  EXPECT_NEAR(found.force[1], 0.0, 1e-12);
  EXPECT_NEAR(found.torque[2], -0.002 * found.force[0], 1e-12) << "arm (0, 0.002, 0)";
}

TEST(BodyForce, GrowsWhereTheBodyRunsIntoTheWater) {
  Pair pair;
  pair.water.artificial = 0.02;
  pair.state.velocity = {0.5, 0.0, 0.0};
  const double still = body_force(Pair().water, pair.points, 0, pair.state).force[0];
  const double r = 0.012;
  const double h = kLengthOfSupport * pair.water.support;
  const double rub = 0.02 * -0.5 * r / (1000.0 * (r * r + 0.01 * h * h));
  const double more = pair.water.mass * 1000.0 * 3.0e-7 * -rub * slope(r, pair.water.support);
  const double found = body_force(pair.water, pair.points, 0, pair.state).force[0];
  EXPECT_NEAR((found - still) / more, 1.0, 1e-5);
  pair.state.velocity = {-0.5, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(body_force(pair.water, pair.points, 0, pair.state).force[0], still);
}

TEST(BodyForce, IsTheSameEverywhere) {
  const Pair here;
  const double force = body_force(here.water, here.points, 0, here.state).force[0];
  for (int k = -9; k <= 9; ++k) {
    Pair there;
    const Vector3 away = {0.0037 * k, -0.0051 * k, 0.0043 * k};
    there.state.position = there.state.position + away;
    there.water.position[0] = there.water.position[0] + away;
    EXPECT_NEAR(body_force(there.water, there.points, 0, there.state).force[0] / force, 1.0, 1e-9);
    // And from the other side.
    there.water.position[0][0] -= 0.024;
    EXPECT_NEAR(body_force(there.water, there.points, 0, there.state).force[0] / force, -1.0, 1e-9);
  }
}

constexpr const char* kSunkBox = R"(
fluid: {spacing: 0.02, solver: weakly_compressible}
tank: {lower: [0, 0, 0], upper: [0.4, 0.4, 0.6]}
water: [{lower: [0, 0, 0], upper: [0.4, 0.4, 0.36]}]
bodies:
  - name: box
    shape: {size: [0.12, 0.12, 0.12]}
    rest: {position: [0.2, 0.2, 0.16]}
gauges:
  probes: [{name: box, kind: body, body: box}, {name: all, kind: energy}]
)";

/// Of water at rest on the sunk box in another shape, in the weight of what that displaces.
Vector3 buoyancy(const Shape& shape, const Quaternion& turn) {
  Device device;
  Scene scene = parse_scene(kSunkBox, "sunk.yaml");
  scene.bodies[0].shape = shape;
  scene.bodies[0].rest.rotation = turn;
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  constexpr int kFrames = 40;
  Vector3 mean = {0.0, 0.0, 0.0};
  for (int k = 0; k < kFrames; ++k) {
    static_cast<void>(simulation.advance());
    const auto row = gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies());
    for (std::size_t i = 0; i < 3; ++i) mean[i] += row[14 + i] / kFrames;
  }
  EXPECT_EQ(gauges.columns()[14], "box_fx");
  const double weight = 998.0 * 9.81 * volume_of(shape);
  std::printf("buoyancy %.3f of the displaced weight, across %.3f, %.3f\n", mean[2] / weight,
              mean[0] / weight, mean[1] / weight);
  return (1.0 / weight) * mean;
}

void expect_weight_of_water(const Shape& shape, const Quaternion& turn) {
  const Vector3 force = buoyancy(shape, turn);
  EXPECT_NEAR(force[2], 1.0, 0.1);
  EXPECT_NEAR(force[0], 0.0, 0.05);
  EXPECT_NEAR(force[1], 0.0, 0.05);
}

constexpr Quaternion kUpright = {0.0, 0.0, 0.0, 1.0};
constexpr Vector3 kCube = {0.12, 0.12, 0.12};

TEST(BodyForce, OfWaterAtRestIsTheWeightOfWhatTheBodyDisplaces) {
  expect_weight_of_water({ShapeKind::box, kCube}, kUpright);
}

TEST(BodyForce, OfWaterAtRestIsTheWeightOfWhatAMeshDisplaces) {
  expect_weight_of_water(mesh_shape(make_solid(box_mesh(kCube), 0.02)), kUpright);
  expect_weight_of_water(mesh_shape(make_solid(sphere_mesh(0.075, 3), 0.02)), kUpright);
  expect_weight_of_water({ShapeKind::sphere, {0.15, 0.15, 0.15}}, kUpright);
}

// The box stands as before, but its file has it askew: its points lie on no faces.
TEST(BodyForce, IsNoWorseWhereAMeshIsAskewInItsFile) {
  const Quaternion turn = from_turn({0.4, -0.7, 0.2});
  const TriangleMesh mesh = placed(box_mesh(kCube), turn, {0.0, 0.0, 0.0});
  expect_weight_of_water(mesh_shape(make_solid(mesh, 0.02)), inverse(turn));
}

}  // namespace
}  // namespace splash::sim
