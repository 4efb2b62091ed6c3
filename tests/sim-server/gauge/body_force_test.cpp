// SPDX-License-Identifier: MIT
// The force on a body: of one pair by hand, and the weight of the water it displaces.
#include "sim-server/gauge/body_force.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/device/device.hpp"
#include "sim-server/fluid/smoothing.hpp"
#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation.hpp"
#include "tests/sim-server/gauge/lattice.hpp"

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
fluid: {spacing: 0.02}
tank: {lower: [0, 0, 0], upper: [0.4, 0.4, 0.6]}
water: [{lower: [0, 0, 0], upper: [0.4, 0.4, 0.36]}]
bodies:
  - name: box
    shape: {size: [0.12, 0.12, 0.12]}
    rest: {position: [0.2, 0.2, 0.16]}
gauges:
  probes: [{name: box, kind: body, body: box}, {name: all, kind: energy}]
)";

TEST(BodyForce, OfWaterAtRestIsTheWeightOfWhatTheBodyDisplaces) {
  Device device;
  const Scene scene = parse_scene(kSunkBox, "sunk.yaml");
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  constexpr int kFrames = 40;
  Vector3 mean = {0.0, 0.0, 0.0};
  for (int k = 0; k < kFrames; ++k) {
    static_cast<void>(simulation.advance());
    const auto row = gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies());
    for (std::size_t i = 0; i < 3; ++i) mean[i] += row[14 + i] / kFrames;
  }
  ASSERT_EQ(gauges.columns()[14], "box_fx");
  const double weight = 998.0 * 9.81 * 0.12 * 0.12 * 0.12;
  std::printf("buoyancy %.3f of the displaced weight\n", mean[2] / weight);
  EXPECT_NEAR(mean[2] / weight, 1.0, 0.1);
  EXPECT_NEAR(mean[0] / weight, 0.0, 0.05);
  EXPECT_NEAR(mean[1] / weight, 0.0, 0.05);
}

}  // namespace
}  // namespace splash::sim
