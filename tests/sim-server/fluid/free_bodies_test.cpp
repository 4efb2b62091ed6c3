// SPDX-License-Identifier: MIT
// Bodies that the water moves: nothing of the momentum is lost between them and the water, whatever
// their mass; without water they fall, turn and knock as bodies do.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/sim-server/fluid/free_float.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

/// A mesh of a box that is turned in its file, about its centre.
Shape askew_box(const Vector3& size, double spacing) {
  return mesh_shape(make_solid(placed(box_mesh(size), from_turn({0.4, -0.7, 0.2}), {}), spacing));
}

// A turning body goes through the drop: it pushes, rubs and throws.
void expect_momentum_kept(const Shape& shape, double density) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = drop_and_body(
      shape, density,
      {{0.5, 0.49, 0.62}, from_turn({0.3, 0.2, 0.1}), {0.1, 0.0, -2.0}, {3.0, -5.0, 4.0}});
  world.start(device);
  const Balance before = world.balance();
  world.run(0.1);
  const Balance after = world.balance();
  // The water took part of it, so that there was something to lose.
  const double rounding = 2.0e-5 * before.scale;
  EXPECT_GT(length(after.water - before.water), 10.0 * rounding);
  EXPECT_LT(length(after.all() - before.all()), rounding);
}

/// The parameter is the density of the body [kg/m3].
class Momentum : public ::testing::TestWithParam<double> {};

TEST_P(Momentum, OfWaterAndBodyTogetherStays) {
  expect_momentum_kept({ShapeKind::box, {0.1, 0.08, 0.06}}, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Densities, Momentum, ::testing::Values(1.0, 500.0, 1.0e6),
                         [](const auto& density) {
                           return std::to_string(static_cast<int>(density.param));
                         });

TEST(Momentum, OfWaterAndMeshTogetherStays) {
  expect_momentum_kept(askew_box({0.1, 0.08, 0.06}, 0.02), 500.0);
}

// Slowly, so that nobody is put back out of the body, which moves without a speed.
TEST(FreeBodies, KeepTheAngularMomentumOfWaterAndBody) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world =
      drop_and_body({ShapeKind::box, {0.1, 0.08, 0.06}}, 300.0,
                    {{0.5, 0.49, 0.6}, {0, 0, 0, 1}, {0.0, 0.0, -0.2}, {0.5, -1.0, 0.8}});
  world.start(device);
  const Balance before = world.balance();
  world.run(0.2);
  const Balance after = world.balance();
  EXPECT_LT(length(after.turning - before.turning), 1.0e-4 * before.scale);
}

TEST(FreeBodies, FallAsBodiesDo) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = {tank_scene(0.05, {1.0, 1.0, 1.0}, 0.1)};
  world.add({ShapeKind::sphere, {0.1, 0.1, 0.1}}, 500.0,
            {{0.3, 0.4, 4.0}, {0, 0, 0, 1}, {0.2, 0.0, 0.0}, {0.0, 0.0, 3.0}});
  world.start(device);
  world.run(0.5);
  const BodyState s = world.state(0);
  EXPECT_NEAR(s.position[0], 0.3 + 0.2 * world.time, 1.0e-4);
  EXPECT_NEAR(s.position[2], 4.0 - 0.5 * 9.81 * world.time * (world.time + world.dt), 1.0e-4);
  EXPECT_NEAR(s.velocity[2], -9.81 * world.time, 1.0e-4);
  EXPECT_NEAR(s.spin[2], 3.0, 1.0e-5);
}

// About its middle axis a box tumbles (Dzhanibekov): angular momentum and energy say how. A mesh of
// it does whose axes are none of its file's.
void expect_tumbling(const Shape& shape, const Quaternion& turn, double rounding) {
  SCOPED_TRACE(static_cast<int>(shape.kind));
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = {tank_scene(0.046, {1.0, 1.0, 1.0}, 0.1)};
  world.scene.fluid.gravity = {0.0, 0.0, 0.0};
  world.add(shape, 500.0, {{0.5, 0.5, 0.7}, turn, {0.0, 0.0, 0.0}, {0.01, 6.0, 0.02}});
  world.start(device);
  const Balance before = world.balance();
  double least = 1.0;
  for (int k = 0; k < 800; ++k) {
    world.run(world.dt);
    const Quaternion turned = compose(world.state(0).rotation, inverse(turn));
    least = std::min(least, rotate(turned, {0.0, 1.0, 0.0})[1]);
  }
  EXPECT_LT(least, -0.9) << "it did not turn over";
  const Balance after = world.balance();
  std::printf("angular momentum off by %.2e of itself\n",
              length(after.spin - before.spin) / length(before.spin));
  EXPECT_LT(length(after.spin - before.spin), rounding * length(before.spin));
  EXPECT_NEAR(after.energy, before.energy, 5.0e-3 * before.energy);
}

TEST(FreeBodies, TumbleWithTheirAngularMomentumAndEnergy) {
  expect_tumbling({ShapeKind::box, {0.3, 0.2, 0.1}}, {0, 0, 0, 1}, 1.0e-4);
  expect_tumbling(askew_box({0.3, 0.2, 0.1}, 0.046), inverse(from_turn({0.4, -0.7, 0.2})),
                  2.0e-4);  // as many roundings more
}

TEST(FreeBodies, RestOnTheFloorAndRebound) {
  Device device(-1, false, SPLASH_TEST_LANES);
  for (const Shape& shape :
       {Shape{ShapeKind::box, {0.2, 0.14, 0.1}}, Shape{ShapeKind::sphere, {0.1, 0.1, 0.1}},
        Shape{ShapeKind::cylinder, {0.2, 0.2, 0.1}},
        mesh_shape(make_solid(box_mesh({0.2, 0.14, 0.1}), 0.05)),
        mesh_shape(make_solid(sphere_mesh(0.05, 2), 0.05))}) {
    SCOPED_TRACE(static_cast<int>(shape.kind));
    FreeFloat world = {tank_scene(0.05, {2.0, 1.0, 1.0}, 0.1)};
    // It hardly spreads to where the body falls.
    world.scene.water = {{{0.0, 0.0, 0.0}, {0.2, 1.0, 0.06}}};
    world.add(shape, 5000.0, {{1.5, 0.5, 0.3}});
    world.scene.bodies[0].motion.restitution = 0.5;
    world.start(device);
    double lowest = 1.0, second = 0.0;
    while (world.time < 1.2) {
      world.run(world.dt);
      const BodyState s = world.state(0);
      lowest = std::min(lowest, s.position[2]);
      if (world.time > 0.25) second = std::max(second, s.position[2]);
    }
    EXPECT_GT(lowest, 0.05 - 1.0e-5) << "in the floor";
    EXPECT_NEAR(second, 0.05 + 0.25 * 0.25, 0.015) << "half the speed, a quarter of the height";
    EXPECT_NEAR(world.state(0).position[2], 0.05, 0.003) << "at rest";
  }
}

// Every vertex counts, however many there are: a tumbling mesh is never beyond a wall.
TEST(FreeBodies, KeepAllOfAMeshWithinTheWalls) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = {tank_scene(0.05, {1.0, 1.0, 1.0}, 0.1)};
  world.scene.water = {{{0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}}};
  TriangleMesh star = sphere_mesh(0.08, 2);
  for (std::size_t v = 0; v < star.vertices.size(); v += 5)
    star.vertices[v] = 1.7 * star.vertices[v];
  move_mesh(star, -1.0 * mesh_mass(star).centre);
  world.add(mesh_shape(make_solid(star, 0.05)), 3000.0,
            {{0.6, 0.5, 0.3}, {0, 0, 0, 1}, {1.5, 0.7, 0.0}, {7.0, 3.0, -5.0}});
  world.scene.bodies[0].motion.restitution = 0.3;
  world.start(device);
  int touches = 0;
  while (world.time < 2.0) {
    world.run(world.dt);
    const BodyState s = world.state(0);
    double least = 1.0;
    for (const Vector3& vertex : star.vertices) {
      const Vector3 x = s.position + rotate(s.rotation, vertex);
      least = std::min({least, x[2], x[0], 1.0 - x[0], x[1], 1.0 - x[1]});
    }
    EXPECT_GT(least, -1.0e-5);
    touches += least < 1.0e-4;
  }
  EXPECT_GT(touches, 10);
}

TEST(FreeBodies, SlideAsFarAsFrictionLetsThem) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = {tank_scene(0.05, {3.0, 1.0, 1.0}, 0.1)};
  world.scene.water = {{{0.0, 0.0, 0.0}, {0.2, 1.0, 0.06}}};
  world.add({ShapeKind::box, {0.2, 0.2, 0.05}}, 8000.0,
            {{1.0, 0.5, 0.025}, {0, 0, 0, 1}, {2.0, 0.0, 0.0}});
  world.scene.bodies[0].motion.friction = 0.3;
  world.start(device);
  world.run(1.0);
  EXPECT_NEAR(world.state(0).position[0] - 1.0, 2.0 * 2.0 / (2.0 * 0.3 * 9.81), 0.02);
  EXPECT_NEAR(world.state(0).velocity[0], 0.0, 1.0e-3);
}

TEST(FreeBodies, DoTheSameTwice) {
  Device device(-1, false, SPLASH_TEST_LANES);
  std::vector<BodyState> ends;
  for (int k = 0; k < 2; ++k) {
    FreeFloat world = drop_and_body({ShapeKind::box, {0.1, 0.08, 0.06}}, 50.0,
                                    {{0.5, 0.49, 0.6}, {0, 0, 0, 1}, {0.0, 0.0, -1.0}});
    world.start(device);
    world.run(0.05);
    ends.push_back(world.state(0));
  }
  EXPECT_EQ(ends[0].position, ends[1].position);
  EXPECT_EQ(ends[0].spin, ends[1].spin);
}

TEST(Mass, IsThatOfTheShape) {
  BodySettings body;
  body.shape = {ShapeKind::sphere, {0.2, 0.2, 0.2}};
  body.motion.density = 700.0;
  EXPECT_NEAR(mass_of(body), 700.0 * 4.0 / 3.0 * M_PI * 0.001, 1.0e-9);
  body.motion.mass = 3.0;
  EXPECT_EQ(mass_of(body), 3.0);
  EXPECT_NEAR(inertia_of(body.shape, 3.0)[0], 0.4 * 3.0 * 0.01, 1.0e-12);
  const Vector3 disc = inertia_of({ShapeKind::cylinder, {0.2, 0.2, 0.1}}, 3.0);
  EXPECT_NEAR(disc[2], 0.5 * 3.0 * 0.01, 1.0e-12);
  EXPECT_NEAR(disc[0], 3.0 * (3.0 * 0.01 + 0.01) / 12.0, 1.0e-12);
  const Vector3 box = inertia_of({ShapeKind::box, {0.1, 0.2, 0.3}}, 12.0);
  EXPECT_NEAR(box[0], 0.04 + 0.09, 1.0e-12);
  EXPECT_NEAR(box[2], 0.01 + 0.04, 1.0e-12);
}

}  // namespace
}  // namespace splash::sim
