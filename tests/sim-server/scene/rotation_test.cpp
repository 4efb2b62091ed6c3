// SPDX-License-Identifier: MIT
// The quaternion formulas against each other and against turns that anyone can check by hand.
#include "sim-server/scene/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

void expect_near(const Vector3& a, const Vector3& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "axis " << i;
}

TEST(Rotation, QuarterTurnAboutZTakesXToY) {
  const Quaternion q = from_turn({0.0, 0.0, std::numbers::pi / 2});
  expect_near(rotate(q, {1.0, 0.0, 0.0}), {0.0, 1.0, 0.0}, 1e-15);
  expect_near(rotate(inverse(q), {0.0, 1.0, 0.0}), {1.0, 0.0, 0.0}, 1e-15);
}

TEST(Rotation, ComposeAppliesTheSecondFirst) {
  const Quaternion z = from_turn({0.0, 0.0, std::numbers::pi / 2});
  const Quaternion x = from_turn({std::numbers::pi / 2, 0.0, 0.0});
  expect_near(rotate(compose(z, x), {0.0, 1.0, 0.0}), {0.0, 0.0, 1.0}, 1e-15);
  expect_near(rotate(compose(x, z), {0.0, 1.0, 0.0}), {-1.0, 0.0, 0.0}, 1e-15);
}

TEST(Rotation, TurnAndBack) {
  for (const double angle : {0.0, 1e-12, 1e-7, 1e-3, 1.0, 3.1}) {
    const Vector3 turn = {0.6 * angle, 0.0, -0.8 * angle};
    expect_near(to_turn(from_turn(turn)), turn, 1e-12 + 1e-9 * angle);
  }
}

TEST(Rotation, TakesTheShorterWay) {
  const Quaternion q = from_turn({0.0, 0.0, 0.3});
  expect_near(to_turn({-q[0], -q[1], -q[2], -q[3]}), {0.0, 0.0, 0.3}, 1e-12);
}

TEST(Rotation, UnitOfNothingIsNoRotation) {
  EXPECT_EQ(unit({0.0, 0.0, 0.0, 0.0}), (Quaternion{0.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(unit({NAN, 0.0, 0.0, 1.0}), (Quaternion{0.0, 0.0, 0.0, 1.0}));
}

TEST(ShapeGeometry, DistancesOfTheThreeShapes) {
  const Shape box{ShapeKind::box, {0.4, 0.2, 0.1}, 0.0, 0.0};
  EXPECT_NEAR(distance_to(box, {0.0, 0.0, 0.0}), -0.05, 1e-15);
  EXPECT_NEAR(distance_to(box, {0.2 + 0.3, 0.1 + 0.4, 0.0}), 0.5, 1e-15);
  const Shape sphere{ShapeKind::sphere, {0.4, 0.4, 0.4}, 0.0, 0.0};
  EXPECT_NEAR(distance_to(sphere, {0.0, 0.3, 0.4}), 0.3, 1e-15);
  const Shape disc{ShapeKind::cylinder, {0.4, 0.4, 0.1}, 0.0, 0.0};
  EXPECT_NEAR(distance_to(disc, {0.0, 0.0, -0.15}), 0.1, 1e-15);
  EXPECT_NEAR(distance_to(disc, {0.5, 0.0, 0.45}), 0.5, 1e-15);
  EXPECT_NEAR(distance_to(disc, {0.19, 0.0, 0.0}), -0.01, 1e-15);
}

}  // namespace
}  // namespace splash::sim
