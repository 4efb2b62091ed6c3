// SPDX-License-Identifier: MIT
// Pressure on walls and bodies: by hand, as the whole of the force, and of water at rest.
#include "sim-server/gauge/thrust.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/device/device.hpp"
#include "sim-server/gauge/body_push.hpp"
#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/sim-server/gauge/lattice.hpp"

namespace splash::sim {
namespace {

constexpr double kRadius = 0.02;
constexpr double kStep = 0.001;  ///< between the places of a sum over a surface [m]

Face floor_at(const Vector3& place) {
  Face face;
  face.place = place;
  face.middle = place;
  face.radius = kRadius;
  return face;
}

/// One particle of pressure 2000 Pa at (0.003, -0.002, 0.006), pushed up by the floor.
WaterState one_particle() {
  WaterState water = lattice_water({-0.002, -0.007, 0.001}, {0.008, 0.003, 0.011}, 0.01);
  water.density = {1005.0};
  water.pressure = {2000.0};
  water.image = {1.0};
  water.slope = {{0.0, 0.0, 0.0}};
  water.wall_push = {{40.0, -30.0, 250.0}};
  return water;
}

TEST(Thrust, OfOneParticleIsItsPushByTheWeightOfItsFoot) {
  const WaterState water = one_particle();
  ASSERT_EQ(water.position.size(), 1U);
  const double r = std::hypot(0.003 - 0.01, -0.002);
  EXPECT_NEAR(thrust_on(floor_at({0.01, 0.0, 0.0}), water, {}, {}),
              water.mass * 250.0 * face_weight(r, kRadius), 1.0e-9);
  EXPECT_EQ(thrust_on(floor_at({0.03, 0.0, 0.0}), water, {}, {}), 0.0);
}

TEST(Thrust, OnAllOfAFloorIsTheWholePush) {
  const WaterState water = one_particle();
  double sum = 0.0;
  for (double x = -0.03; x < 0.03; x += kStep) {
    for (double y = -0.03; y < 0.03; y += kStep) {
      sum += thrust_on(floor_at({x, y, 0.0}), water, {}, {}) * kStep * kStep;
    }
  }
  EXPECT_NEAR(sum / (water.mass * 250.0), 1.0, 1.0e-3);
}

TEST(Thrust, OnAllOfABodysFaceIsItsWholeForce) {
  const WaterState water = one_particle();
  std::vector<BodyPoint> points(2);
  points[0].place = {0.0, 0.0, -0.005};
  points[0].volume = 1.0e-6;
  points[1].place = {0.007, -0.004, -0.005};
  points[1].volume = 2.0e-6;
  const std::vector<BodyState> states(1);
  const double force = body_force(water, points, 0, states[0]).force[2];
  ASSERT_LT(force, 0.0);
  double sum = 0.0;
  for (double x = -0.03; x < 0.03; x += kStep) {
    for (double y = -0.03; y < 0.03; y += kStep) {
      Face face = floor_at({x, y, 0.0});
      face.body = 0;
      sum += thrust_on(face, water, points, states) * kStep * kStep;
    }
  }
  EXPECT_NEAR(sum / -force, 1.0, 1.0e-3);
}

TEST(Thrust, IsFilledUpWhereAnEdgeCutsTheFace) {
  const WaterState water = one_particle();
  Face face = floor_at({0.003, -0.002, 0.0});
  const double whole = thrust_on(face, water, {}, {});
  face.cover = 0.5;
  EXPECT_NEAR(thrust_on(face, water, {}, {}), 2.0 * whole, 1.0e-9);
  face.middle = face.place + Vector3{0.0, 0.0, 0.01};  // the covered half lies higher: less deep
  WaterState heavy = water;
  heavy.gravity = {0.0, 0.0, -9.81};
  EXPECT_NEAR(thrust_on(face, heavy, {}, {}), 2.0 * whole + 1000.0 * 9.81 * 0.01, 1.0e-6);
}

const std::string kBox = R"(
fluid: {spacing: 0.02, solver: weakly_compressible}
tank: {lower: [0, 0, 0], upper: [0.4, 0.4, 0.6]}
water: [{lower: [0, 0, 0], upper: [0.4, 0.4, 0.36]}]
bodies:
  - name: box
    shape: {size: [0.16, 0.16, 0.16]}
    rest: {position: [0.2, 0.2, 0.16]}
gauges:
  probes:
)";

/// Means over a while of the pressures at `places`, of those expected.
std::vector<double> readings(const std::vector<Vector3>& places) {
  std::string text = kBox;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3& x = places[i];
    text += "    - {name: p" + std::to_string(i) + ", kind: pressure, place: [" +
            std::to_string(x[0]) + ", " + std::to_string(x[1]) + ", " + std::to_string(x[2]) +
            "]}\n";
  }
  Device device;
  const Scene scene = parse_scene(text, "box.yaml");
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  constexpr int kFrames = 40;
  std::vector<double> mean(places.size(), 0.0);
  for (int k = 0; k < kFrames; ++k) {
    static_cast<void>(simulation.advance());
    const auto row = gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies());
    for (std::size_t i = 0; i < places.size(); ++i) {
      mean[i] += row[1 + i] / (998.0 * 9.81 * (0.36 - places[i][2])) / kFrames;
    }
  }
  return mean;
}

// The packing carries a part of the weight by shear, sideways (tests/validation/README.md), and an
// edge of a body is blunt by a support: the sensors on the box are as far from its edges.
TEST(Thrust, OfWaterAtRestIsItsWeightOnFloorsSidesAndBodies) {
  std::vector<Vector3> all;
  for (int k = 0; k < 16; ++k) all.push_back({0.02 + 0.12 * (k % 4), 0.02 + 0.12 * (k / 4), 0.0});
  for (int k = 0; k < 16; ++k) all.push_back({0.0, 0.05 + 0.1 * (k % 4), 0.05 + 0.05 * (k / 4)});
  for (int k = 0; k < 4; ++k) all.push_back({0.18 + 0.04 * (k % 2), 0.18 + 0.04 * (k / 2), 0.24});
  for (int k = 0; k < 4; ++k) all.push_back({0.28, 0.18 + 0.04 * (k % 2), 0.14 + 0.04 * (k / 2)});
  const std::vector<double> read = readings(all);
  const auto mean = [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) sum += read[i];
    return sum / static_cast<double>(last - first);
  };
  const double floor = mean(0, 16), side = mean(16, 32), top = mean(32, 36), flank = mean(36, 40);
  std::printf("floor %.3f, side %.3f, top %.3f, flank %.3f of the weight\n", floor, side, top,
              flank);
  EXPECT_NEAR(floor, 1.0, 0.06);
  EXPECT_NEAR(side, 1.0, 0.1);
  EXPECT_NEAR(top, 1.0, 0.16);
  EXPECT_NEAR(flank, 1.0, 0.12);
}

}  // namespace
}  // namespace splash::sim
