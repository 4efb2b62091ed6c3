// SPDX-License-Identifier: MIT
// What water pushes walls and bodies with: of single particles by hand, as the whole of the force,
// and of water at rest.
#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/device/device.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/gauge/body_push.hpp"
#include "sim-server/gauge/gauges.hpp"
#include "sim-server/gauge/thrust.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/sim-server/gauge/lattice.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

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

/// Of the floor's face around the particle, or of a body's [N].
double thrust_on_all(const WaterState& water, int body = -1,
                     const std::vector<BodyPoint>& points = {},
                     const std::vector<BodyState>& states = {}) {
  double sum = 0.0;
  for (double x = -0.03; x < 0.03; x += kStep) {
    for (double y = -0.03; y < 0.03; y += kStep) {
      Face face = floor_at({x, y, 0.0});
      face.body = body;
      sum += thrust_on(face, water, points, states) * kStep * kStep;
    }
  }
  return sum;
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
  EXPECT_NEAR(thrust_on_all(water) / (water.mass * 250.0), 1.0, 1.0e-3);
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
  EXPECT_NEAR(thrust_on_all(water, 0, points, states) / -force, 1.0, 1.0e-3);
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

/// Means over a while of what the gauges of water at rest tell.
std::vector<double> mean_row(const Scene& scene) {
  Device device;
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  constexpr int kFrames = 40;
  std::vector<double> mean(gauges.columns().size(), 0.0);
  for (int k = 0; k < kFrames; ++k) {
    static_cast<void>(simulation.advance());
    const auto row = gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies());
    for (std::size_t i = 0; i < row.size(); ++i) mean[i] += row[i] / kFrames;
  }
  return mean;
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
  const std::vector<double> row = mean_row(parse_scene(text, "box.yaml"));
  std::vector<double> shares;
  for (std::size_t i = 0; i < places.size(); ++i) {
    shares.push_back(row[1 + i] / (998.0 * 9.81 * (0.36 - places[i][2])));
  }
  return shares;
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

/// Of what the box displaces in another shape.
void expect_weight_of_water(const Shape& shape, const Quaternion& turn) {
  Scene scene = parse_scene(kBox + "    - {name: box, kind: body, body: box}\n", "sunk.yaml");
  scene.bodies[0].shape = shape;
  scene.bodies[0].rest.rotation = turn;
  EXPECT_EQ(Gauges(scene).columns()[14], "box_fx");
  const std::vector<double> row = mean_row(scene);
  const double weight = 998.0 * 9.81 * volume_of(shape);
  const Vector3 force = (1.0 / weight) * Vector3{row[14], row[15], row[16]};
  std::printf("buoyancy %.3f of the displaced weight, across %.3f, %.3f\n", force[2], force[0],
              force[1]);
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
