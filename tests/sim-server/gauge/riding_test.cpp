// SPDX-License-Identifier: MIT
// Gauges that ride on a body, and sensors with a size: in water whose pressures are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/start/scene_start.hpp"
#include "tests/sim-server/gauge/lattice.hpp"

namespace splash::sim {
namespace {

constexpr double kLevel = 0.3;  // [m]

// Pressures on a grid are read at the places themselves, whatever the faces.
const std::string kTank = R"(
fluid: {spacing: 0.01, solver: grid_projected}
tank: {lower: [0, 0, 0], upper: [0.3, 0.3, 0.6]}
water: [{lower: [0, 0, 0], upper: [0.3, 0.3, 0.3]}]
)";

WaterState at_rest() {
  WaterState water = lattice_water({0.0, 0.0, 0.0}, {0.3, 0.3, kLevel}, 0.01);
  for (const Vector3& x : water.position) {
    water.pressure.push_back(9810.0 * (kLevel - x[2]));
    water.velocity[water.pressure.size() - 1] = {x[2], 0.0, 0.0};
  }
  return water;
}

/// What the gauges of a scene tell of the water at rest, without the time.
std::vector<double> readings(const std::string& text, double seconds) {
  const Scene scene = parse_scene(text, "riding.yaml");
  std::vector<PosedMotion*> live;
  const Bodies bodies = make_bodies(scene, {}, live);
  const std::vector<double> row = Gauges(scene).read(seconds, at_rest(), bodies);
  return {row.begin() + 1, row.end()};
}

TEST(RidingGauges, GoWhereTheirBodyTakesThem) {
  // It rises by 0.1 m/s, and turns about y: its x axis points down after a second.
  const std::string text = kTank + R"(
bodies:
  - name: paddle
    shape: {size: [0.04, 0.04, 0.04]}
    motion:
      kind: script
      smooth: false
      keyframes:
        - {time: 0, position: [0.15, 0.15, 0.1]}
        - {time: 1, position: [0.15, 0.15, 0.2], rotation: [0, 0.70710678, 0, 0.70710678]}
gauges:
  probes:
    - {name: p, kind: pressure, body: paddle, place: [0.06, 0, 0]}
    - {name: v, kind: velocity, body: paddle, place: [0.06, 0, 0]}
)";
  const std::vector<double> before = readings(text, 0.0);
  EXPECT_NEAR(before[0], 9810.0 * (kLevel - 0.1), 1.0);
  EXPECT_NEAR(before[1], 0.1, 1.0e-4);
  const std::vector<double> after = readings(text, 1.0);
  EXPECT_NEAR(after[0], 9810.0 * (kLevel - 0.14), 1.0);
  EXPECT_NEAR(after[1], 0.14, 1.0e-4);
  EXPECT_NEAR(after[4], 1.0, 0.01) << "within the water";
}

TEST(SizedSensors, ReadTheMeanOverTheirDisc) {
  const std::string text = kTank + R"(
gauges:
  probes:
    - {name: small, kind: pressure, place: [0, 0.15, 0.15]}
    - {name: large, kind: pressure, place: [0, 0.15, 0.15], radius: 0.05}
    - {name: half, kind: pressure, place: [0, 0.15, 0.3], radius: 0.1}
    - {name: low, kind: pressure, place: [0, 0.15, 0.0001], radius: 0.05}
)";
  const std::vector<double> read = readings(text, 0.0);
  EXPECT_NEAR(read[0], 9810.0 * 0.15, 1.0);
  EXPECT_NEAR(read[1], read[0], 1.0) << "of what changes linearly it is that of its middle";
  // Half of it is in the air: rho g times the depth of a half disc's centroid, 4 R / (3 pi).
  EXPECT_NEAR(read[2] / (0.5 * 9810.0 * 0.4 / (3.0 * std::numbers::pi)), 1.0, 0.05);
  const double deep = kLevel - 4.0 * 0.05 / (3.0 * std::numbers::pi);
  EXPECT_NEAR(read[3] / (9810.0 * deep), 1.0, 0.005) << "half of it is under the floor";
}

TEST(SizedSensors, EndAtTheirBodysEdge) {
  const std::string text = kTank + R"(
bodies:
  - {name: box, shape: {size: [0.1, 0.1, 0.1]}, rest: {position: [0.15, 0.15, 0.1]}}
gauges:
  probes:
    - {name: flank, kind: pressure, body: box, place: [0.05, 0, 0.047], radius: 0.04}
)";
  const double deep = kLevel - 0.147 + 4.0 * 0.04 / (3.0 * std::numbers::pi);
  EXPECT_NEAR(readings(text, 0.0)[0] / (9810.0 * deep), 1.0, 0.02);
}

}  // namespace
}  // namespace splash::sim
