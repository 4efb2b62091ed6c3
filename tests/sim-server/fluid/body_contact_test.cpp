// SPDX-License-Identifier: MIT
// Bodies that meet bodies: spheres part as the formula says, whatever meets keeps its momentum and
// angular momentum and gains no energy, nothing is in anything else, a stack stands.
#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/sim-server/fluid/free_float.hpp"
#include "tests/sim-server/fluid/small_water.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

const Shape kBall = {ShapeKind::sphere, {0.1, 0.1, 0.1}};
const Shape kBrick = {ShapeKind::box, {0.16, 0.12, 0.08}};
const Shape kDrum = {ShapeKind::cylinder, {0.12, 0.12, 0.14}};

/// For water so fine that a mesh's distance is off by no more than a millimetre at its edges.
Shape as_mesh(TriangleMesh surface) {
  constexpr double kFine = 0.008;  // [m]
  return mesh_shape(make_solid(std::move(surface), kFine));
}
const Shape kMeshBall = as_mesh(sphere_mesh(0.05, 3));
const Shape kMeshBrick = as_mesh(box_mesh({0.16, 0.12, 0.08}));

void set_surface(FreeFloat& world, double restitution, double friction) {
  for (BodySettings& body : world.scene.bodies) {
    body.motion.restitution = restitution;
    body.motion.friction = friction;
  }
}

/// Places all over a shape's surface, in its own axes.
std::vector<Vector3> surface_of(const Shape& shape) {
  std::vector<Vector3> places;
  constexpr int kAcross = 20;
  const Vector3 half = 0.5 * Vector3{shape.size[0], shape.size[1], shape.size[2]};
  for (int i = 0; i <= kAcross; ++i) {
    for (int j = 0; j <= kAcross; ++j) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
          // From the box around it towards the middle until the surface is met.
          Vector3 x = {2.0 * i / kAcross - 1.0, 2.0 * j / kAcross - 1.0, side};
          std::swap(x[axis], x[2]);
          x = {x[0] * half[0], x[1] * half[1], x[2] * half[2]};
          double low = 0.0;
          double high = 1.0;
          for (int k = 0; k < 30; ++k) {
            const double middle = 0.5 * (low + high);
            (distance_to(shape, middle * x) < 0.0 ? low : high) = middle;
          }
          places.push_back(low * x);
        }
      }
    }
  }
  return places;
}

/// How deep the surface of one is in the other [m].
double depth_of(const FreeFloat& world, std::size_t one, std::size_t two) {
  const BodyState a = world.state(one);
  const BodyState b = world.state(two);
  double deepest = 0.0;
  for (const Vector3& place : surface_of(world.scene.bodies[one].shape)) {
    const Vector3 there = a.position + rotate(a.rotation, place) - b.position;
    const Vector3 own = rotate(inverse(b.rotation), there);
    deepest = std::max(deepest, -distance_to(world.scene.bodies[two].shape, own));
  }
  return deepest;
}

TEST(BodyContact, SpheresPartAsNewtonSays) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(0.0);
  world.add(kBall, 1000.0, {{1.0, 1.5, 1.0}, {0, 0, 0, 1}, {2.0, 0.0, 0.0}});
  world.add(kBall, 3000.0, {{1.3, 1.5, 1.0}, {0, 0, 0, 1}, {-1.0, 0.0, 0.0}});
  set_surface(world, 0.5, 0.0);
  world.start(device);
  world.run(0.2);
  // Masses 1 and 3: the centre of mass moves at -0.25, they part at half of 3 m/s.
  EXPECT_NEAR(world.state(0).velocity[0], -0.25 - 0.75 * 1.5, 1.0e-4);
  EXPECT_NEAR(world.state(1).velocity[0], -0.25 + 0.25 * 1.5, 1.0e-4);
  EXPECT_NEAR(world.state(0).velocity[1], 0.0, 1.0e-4);
}

struct Meeting {
  Shape one, two;
  std::string name;
};

void PrintTo(const Meeting& meeting, std::ostream* out) {
  *out << meeting.name;
}

class Meetings : public ::testing::TestWithParam<Meeting> {};

// Thrown at each other askew, in four ways, turning.
TEST_P(Meetings, KeepMomentaAndNothingIsInTheOther) {
  Device device(-1, false, SPLASH_TEST_LANES);
  for (int k = 0; k < 4; ++k) {
    SCOPED_TRACE(k);
    FreeFloat world = dry_world(0.0);
    const Vector3 turn = {0.4 * k, 0.9 - 0.3 * k, 0.2 * k};
    world.add(GetParam().one, 800.0,
              {{1.3, 1.5, 1.0}, from_turn(turn), {1.5, 0.1, 0.0}, {3.0, -2.0, 1.0 * k}});
    world.add(GetParam().two, 500.0,
              {{1.6, 1.5 + 0.01 * k, 1.0 - 0.005 * k},
               from_turn({0.1 * k, 0.3, 1.1}),
               {-1.0, 0.0, 0.1},
               {-2.0, 1.0, 2.0}});
    set_surface(world, 0.3, 0.4);
    world.start(device);
    const Balance before = world.balance();
    double deepest = 0.0;
    double change = 0.0;
    const Vector3 thrown = world.state(0).velocity;
    for (int step = 0; step < 100; ++step) {
      world.run(world.dt);
      if (step % 4 == 0)
        deepest = std::max({deepest, depth_of(world, 0, 1), depth_of(world, 1, 0)});
      change = std::max(change, length(world.state(0).velocity - thrown));
    }
    const Balance after = world.balance();
    EXPECT_GT(change, 0.2) << "they did not meet";
    EXPECT_LT(length(after.bodies - before.bodies), 2.0e-6 * before.scale);
    // What overlaps by rounding is put apart, which moves but gives no speed.
    EXPECT_LT(length(after.turning - before.turning), 3.0e-4 * before.scale);
    EXPECT_LT(after.energy, before.energy * (1.0 + 1.0e-4));
    EXPECT_LT(deepest, 1.0e-3);
  }
}

const std::vector<Meeting> kMeetings = {
    {kBall, kBall, "ball_ball"},           {kBall, kBrick, "ball_brick"},
    {kBrick, kBall, "brick_ball"},         {kBall, kDrum, "ball_drum"},
    {kBrick, kBrick, "brick_brick"},       {kBrick, kDrum, "brick_drum"},
    {kDrum, kBrick, "drum_brick"},         {kDrum, kDrum, "drum_drum"},
    {kBall, kMeshBrick, "ball_mesh"},      {kMeshBrick, kBrick, "mesh_brick"},
    {kDrum, kMeshBrick, "drum_mesh"},      {kMeshBall, kMeshBrick, "meshball_mesh"},
    {kMeshBrick, kMeshBrick, "mesh_mesh"}, {kMeshBall, kMeshBall, "meshball_meshball"}};

INSTANTIATE_TEST_SUITE_P(Shapes, Meetings, ::testing::ValuesIn(kMeetings),
                         [](const auto& meeting) { return meeting.param.name; });

void expect_stacked(const FreeFloat& world, std::size_t bricks) {
  for (std::size_t k = 0; k < bricks; ++k) {
    SCOPED_TRACE(k);
    EXPECT_NEAR(world.state(k).position[2], 0.04 + 0.08 * static_cast<double>(k), 0.004);
    EXPECT_NEAR(world.state(k).position[0], 1.5, 0.004);
    EXPECT_LT(length(world.state(k).velocity), 0.02);
  }
}

class Stack : public ::testing::TestWithParam<double> {};

// Also in steps in which all fall by as much as what a knock rebounds from.
TEST_P(Stack, OfTenStands) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(-9.81);
  for (int k = 0; k < 10; ++k) {
    world.add(kBrick, 600.0, {{1.5, 1.5, 0.04 + 0.08 * k}});
  }
  world.start(device);
  world.dt = std::max(world.dt, GetParam());
  double fastest = 0.0;
  for (double t = 0.0; t < 2.0; t += world.dt) {
    world.run(world.dt);
    for (std::size_t k = 0; k < 10; ++k) {
      fastest = std::max(fastest, length(world.state(k).velocity));
    }
  }
  EXPECT_LT(fastest, 0.5 * 9.81 * world.dt) << "one of them fell before it was carried";
  expect_stacked(world, 10);
}

INSTANTIATE_TEST_SUITE_P(Steps, Stack, ::testing::Values(0.0, 0.01), [](const auto& dt) {
  return std::to_string(static_cast<int>(1000.0 * dt.param)) + "_ms";
});

// Two balls touch, a third one hits them: both take the knock within its step, none is in another.
TEST(BodyContact, ARowTakesAKnockAtOnce) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(0.0);
  world.add(kBall, 1000.0, {{1.395, 1.5, 1.0}, {0, 0, 0, 1}, {3.0, 0.0, 0.0}});
  world.add(kBall, 1000.0, {{1.5, 1.5, 1.0}});
  world.add(kBall, 1000.0, {{1.6, 1.5, 1.0}});
  set_surface(world, 0.0, 0.0);
  world.start(device);
  world.dt = 0.002;
  for (int step = 0; step < 4; ++step) {
    world.run(world.dt);
    EXPECT_GT(world.state(1).position[0] - world.state(0).position[0], 0.1 - 1.0e-4) << step;
    EXPECT_GT(world.state(2).position[0] - world.state(1).position[0], 0.1 - 1.0e-4) << step;
  }
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(world.state(k).velocity[0], 1.0, 1.0e-3) << k;
}

TEST(BodyContact, SlideOnEachOtherAsFarAsFrictionLetsThem) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(-9.81);
  world.add({ShapeKind::box, {0.2, 0.2, 0.05}}, 500.0,
            {{1.0, 1.5, 0.125}, {0, 0, 0, 1}, {2.0, 0.0, 0.0}});
  // So heavy that it does not go along.
  world.add({ShapeKind::box, {2.6, 0.6, 0.1}}, 1.0e6, {{1.6, 1.5, 0.05}});
  set_surface(world, 0.0, 0.3);
  world.start(device);
  world.run(1.0);
  EXPECT_NEAR(world.state(0).position[0] - 1.0, 2.0 * 2.0 / (2.0 * 0.3 * 9.81), 0.02);
  EXPECT_NEAR(world.state(0).velocity[0], 0.0, 2.0e-3);
}

// What goes its way does not give way: a plate shoves a ball along, and parts from it as it stops.
TEST(BodyContact, ALedBodyShovesAFreeOne) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(0.0);
  world.add(kBall, 500.0, {{1.2, 1.5, 1.0}});
  world.add_led({ShapeKind::box, {0.05, 0.4, 0.4}},
                {{1.0, 1.5, 1.0}, {0, 0, 0, 1}, {1.0, 0.0, 0.0}});
  set_surface(world, 0.0, 0.0);
  world.start(device);
  world.run(0.5);
  EXPECT_NEAR(world.state(0).velocity[0], 1.0, 1.0e-4);
  EXPECT_NEAR(world.state(0).position[0], world.state(1).position[0] + 0.075, 1.0e-3);
}

// A ball has no corner that could be nearer to a plate's side than to its top: it lies in steps in
// which it falls by five times the rounding of the plate's edges, also at an edge.
TEST(BodyContact, ABallLiesOnAPlateInLongSteps) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(-9.81);
  const Shape plate = {ShapeKind::box, {0.6, 0.3, 0.02}};
  world.add(kBall, 300.0, {{1.3, 1.5, 1.1}});
  world.add(kBall, 300.0, {{1.79, 1.5, 1.1}});
  world.add_led(plate, {{1.5, 1.5, 1.0}});
  set_surface(world, 0.0, 0.3);
  ASSERT_EQ(longest_contact_step(world.scene.bodies, 9.81), HUGE_VAL);
  world.start(device);
  world.dt = 0.01;
  world.run(2.0);
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_NEAR(world.state(k).position[2], 1.06, 1.0e-4) << k;
    EXPECT_NEAR(world.state(k).position[0], k == 0 ? 1.3 : 1.79, 1.0e-3) << k;
    EXPECT_LT(length(world.state(k).velocity), 1.0e-3) << k;
  }
}

TEST(BodyContact, AStackOfMeshesStands) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(-9.81);
  for (int k = 0; k < 4; ++k) {
    world.add(k % 2 == 0 ? kMeshBrick : kBrick, 600.0, {{1.5, 1.5, 0.04 + 0.08 * k}});
  }
  world.start(device);
  world.run(2.0);
  expect_stacked(world, 4);
}

// A mesh need not be convex: what falls into a tray lies on its floor, and goes along with it.
TEST(BodyContact, ATrayCarriesWhatLiesInIt) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(-9.81);
  constexpr double kWall = 0.03;
  world.add(kBall, 500.0, {{1.5, 1.5, 1.1}});
  world.add(kMeshBrick, 500.0, {{1.65, 1.5, 1.08}});
  world.add_led(as_mesh(tray_mesh({0.5, 0.3, 0.12}, kWall)),
                {{1.5, 1.5, 1.0}, {0, 0, 0, 1}, {0.5, 0.0, 0.0}});
  set_surface(world, 0.0, 0.5);
  world.start(device);
  world.run(1.5);
  const double floor = world.state(2).position[2] - 0.06 + kWall;
  const double middle = world.state(2).position[0];
  EXPECT_NEAR(world.state(0).position[2], floor + 0.05, 0.002);
  EXPECT_NEAR(world.state(1).position[2], floor + 0.04, 0.002);
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_LT(std::abs(world.state(k).position[0] - middle), 0.25 - kWall) << k;
  }
  EXPECT_NEAR(world.state(1).velocity[0], 0.5, 0.01);
}

}  // namespace
}  // namespace splash::sim
