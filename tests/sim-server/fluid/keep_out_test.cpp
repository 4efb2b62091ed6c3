// SPDX-License-Identifier: MIT
// Nothing is caught in a body: particles put anywhere in bodies of every shape, turned and moving,
// are at most half a spacing deep after one step, on the side of the nearest face, and no longer
// on their way in. And nobody goes through one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/sim-server/fluid/small_water.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

const Vector3 kCentre = {0.5, 0.5, 0.5};
const Vector3 kMotion = {0.3, -0.2, -0.8};
const Vector3 kSpin = {0.5, 1.0, -2.0};

/// Rotation by 0.7 rad about an axis that is none of the body's.
Quaternion turned() {
  const double part = std::sin(0.35) / std::sqrt(14.0);
  return {1.0 * part, 2.0 * part, 3.0 * part, std::cos(0.35)};
}

/// Below the nearest face, a curved sole taken as what it is.
double depth_of(const Shape& shape, const Vector3& local) {
  if (shape.kind != ShapeKind::box) return -distance_to(shape, local);
  const double under = local[2] + shape.size[2] / 2.0 - rocker_rise(shape, local[0]);
  return std::min(-distance_to(shape, local), under);
}

Water body_among_particles(const Shape& shape) {
  Scene scene = tank_scene(0.05, {1.0, 1.0, 1.0}, 0.2);
  scene.bodies = {body_of("body", shape)};
  Water water = {.scene = scene, .particles = initial_particles(scene)};
  water.motions = {[](double) { return BodyState{kCentre, turned(), kMotion, kSpin}; }};
  return water;
}

/// Puts the particles at random places in and around the body.
std::vector<Vector3> scatter(Water& water) {
  const std::vector<Vector3> places =
      random_places(water.particles.size(), {0.35, 0.35, 0.35}, {0.65, 0.65, 0.65}, 5);
  change_particles(*water.fluid, [&](int id, Vector3& place, Vector3&) {
    place = places[static_cast<std::size_t>(id)];
  });
  return places;
}

Vector3 in_body(const Vector3& place) {
  return rotate(inverse(turned()), place - kCentre);
}

Shape star_shape() {
  TriangleMesh star = sphere_mesh(0.08, 1);
  for (std::size_t v = 0; v < star.vertices.size(); v += 3) {
    star.vertices[v] = 1.8 * star.vertices[v];
  }
  return mesh_shape(make_solid(star, 0.05));
}

const std::vector<Shape> kShapes = {Shape{ShapeKind::box, {0.2, 0.14, 0.1}},
                                    Shape{ShapeKind::box, {0.3, 0.14, 0.1}, 0.03, 0.4},
                                    Shape{ShapeKind::sphere, {0.2, 0.2, 0.2}},
                                    Shape{ShapeKind::cylinder, {0.2, 0.2, 0.12}},
                                    mesh_shape(make_solid(box_mesh({0.2, 0.14, 0.1}), 0.05)),
                                    mesh_shape(make_solid(sphere_mesh(0.1, 2), 0.05)),
                                    star_shape()};

/// A particle before each of a body's six sides, 3 cm off, too far from each other to push or rub.
std::vector<Vector3> before_the_sides(const Shape& shape) {
  std::vector<Vector3> places;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vector3 place = {};
      place[axis] = side * (shape.size[axis] / 2.0 + 0.03);
      places.push_back(place);
    }
  }
  return places;
}

/// Throws each at the body's middle, so that it would get `far` beyond, in its way to there.
void throw_through(Water& water, const std::vector<Vector3>& places, double far, double dt) {
  change_particles(*water.fluid, [&](int id, Vector3&, Vector3& velocity) {
    const Vector3& place = places[static_cast<std::size_t>(id)];
    velocity = (-(1.0 + far) / dt) * rotate(turned(), place);
  });
}

/// Unit vector out of the body, in the world: the gradient of its distance.
Vector3 outward(const Shape& shape, const Vector3& x) {
  const auto distance = [&](const Vector3& place) { return distance_to(shape, place); };
  const Vector3 rise = differences(distance, in_body(x), 1.0e-6);
  return rotate(turned(), (1.0 / length(rise)) * rise);
}

class KeepOut : public ::testing::TestWithParam<int> {};

TEST_P(KeepOut, LeavesNobodyDeepInside) {
  Device device(-1, false, GetParam());
  for (const Shape& shape : kShapes) {
    SCOPED_TRACE(static_cast<int>(shape.kind));
    Water water = body_among_particles(shape);
    water.start(device);
    const std::vector<Vector3> places = scatter(water);
    water.step(1.0e-7);  // next to no motion of its own
    const std::vector<Vector3> after = places_of(*water.fluid);
    const std::vector<Vector3> velocities = velocities_of(*water.fluid);
    const double kept = 0.5 * water.scene.fluid.spacing;
    int moved = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      const Vector3& before = places[i];
      const Vector3& x = after[i];
      const double deep = depth_of(shape, in_body(before));
      if (deep <= kept) {
        EXPECT_LT(length(x - before), 1.0e-5);
        continue;
      }
      ++moved;
      if (shape.kind == ShapeKind::mesh) {
        // Its distance bends between nodes: not quite straight, but as deep as health asks.
        EXPECT_NEAR(depth_of(shape, in_body(x)), kept, 1.0e-3 * water.scene.fluid.spacing);
        EXPECT_LT(length(x - before), 1.5 * (deep - kept) + 0.2 * water.scene.fluid.spacing);
      } else {
        EXPECT_LT(depth_of(shape, in_body(x)), kept + 1.0e-5);
        EXPECT_NEAR(length(x - before), deep - kept, 1.0e-5) << "not by the nearest face";
      }
      const Vector3 out = shape.kind == ShapeKind::mesh ? outward(shape, x)
                                                        : (1.0 / length(x - before)) * (x - before);
      const Vector3 skin = kMotion + cross(kSpin, x - kCentre);
      EXPECT_GT(dot(velocities[i] - skin, out), -1.0e-3);
    }
    EXPECT_GT(moved, 20);
  }
}

void expect_nobody_through(Device& device, const Shape& shape, bool free, double far) {
  const double step = 0.025;
  Water water = body_among_particles(shape);
  water.scene.fluid.gravity = {};
  water.scene.fluid.viscosity = water.scene.fluid.artificial = 0.0;
  const std::vector<Vector3> places = before_the_sides(shape);
  water.particles.clear();
  for (const Vector3& x : places) water.particles.push_back(kCentre + rotate(turned(), x));
  water.start(device);
  MotionSettings& motion = water.scene.bodies[0].motion;
  motion.kind = MotionKind::free;
  motion.density = 500.0;
  if (free)
    water.fluid->release(free_bodies(water.scene.bodies),
                         film_skins(water.scene.bodies, water.scene.fluid.spacing));
  throw_through(water, places, far, step);
  water.step(step);
  const std::vector<Vector3> after = places_of(*water.fluid);
  for (std::size_t i = 0; i < after.size(); ++i) {
    const Vector3 x = in_body(after[i]);
    const double near = shape.kind == ShapeKind::mesh ? 1.0e-3 * water.scene.fluid.spacing : 1.0e-5;
    EXPECT_NEAR(depth_of(shape, x), 0.5 * water.scene.fluid.spacing, near);
    EXPECT_GT(dot(x, places[i]), 0.0) << "on the other side";
  }
}

// As what a heavy ball squeezes against the floor: into the body's far half, or out behind it.
TEST_P(KeepOut, LetsNobodyThrough) {
  Device device(-1, false, GetParam());
  for (const bool free : {false, true}) {
    for (const Shape& shape : kShapes) {
      for (const double far : {0.3, 1.0}) {
        SCOPED_TRACE(testing::Message()
                     << "shape " << static_cast<int>(shape.kind) << free << ' ' << far);
        expect_nobody_through(device, shape, free, far);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Builds, KeepOut, kScalarAndVector, lanes_name);

}  // namespace
}  // namespace splash::sim
