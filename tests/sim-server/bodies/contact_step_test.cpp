// SPDX-License-Identifier: MIT
#include "sim-server/bodies/mass.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace splash::sim {
namespace {

BodySettings body_of(ShapeKind kind, const Vector3& size, MotionKind motion) {
  BodySettings body;
  body.shape = {.kind = kind, .size = size};
  body.motion.kind = motion;
  return body;
}

TEST(ContactStep, IsThatOfTheThinnestOfThoseThatCanMeet) {
  const BodySettings plate = body_of(ShapeKind::box, {0.12, 0.12, 0.04}, MotionKind::free);
  const BodySettings table = body_of(ShapeKind::box, {1.0, 1.0, 0.5}, MotionKind::fixed);
  const BodySettings ball = body_of(ShapeKind::sphere, {0.02, 0.02, 0.02}, MotionKind::free);
  const BodySettings drum = body_of(ShapeKind::cylinder, {0.02, 0.02, 0.1}, MotionKind::free);
  const BodySettings mesh = body_of(ShapeKind::mesh, {0.12, 0.12, 0.04}, MotionKind::free);
  const double of_plate = std::sqrt(0.01 * 0.02 / 9.81);  // 4.5 ms
  EXPECT_NEAR(longest_contact_step({plate, table}, 9.81), of_plate, 1e-9);
  EXPECT_NEAR(longest_contact_step({plate, ball, plate}, 9.81), of_plate, 1e-9);
  EXPECT_NEAR(longest_contact_step({mesh, table}, 9.81), of_plate, 1e-9);
  EXPECT_NEAR(longest_contact_step({plate, drum}, 9.81), std::sqrt(0.01 * 0.01 / 9.81), 1e-9);
  EXPECT_NEAR(longest_contact_step({plate, plate}, 98.1), of_plate / std::sqrt(10.0), 1e-9);
}

TEST(ContactStep, IsFreeWhereNothingLiesOnAnything) {
  const BodySettings plate = body_of(ShapeKind::box, {0.12, 0.12, 0.04}, MotionKind::free);
  const BodySettings table = body_of(ShapeKind::box, {1.0, 1.0, 0.5}, MotionKind::fixed);
  const BodySettings ball = body_of(ShapeKind::sphere, {0.1, 0.1, 0.1}, MotionKind::free);
  EXPECT_TRUE(std::isinf(longest_contact_step({}, 9.81)));
  EXPECT_TRUE(std::isinf(longest_contact_step({plate}, 9.81))) << "walls have no sides";
  EXPECT_TRUE(std::isinf(longest_contact_step({table, table}, 9.81)));
  EXPECT_TRUE(std::isinf(longest_contact_step({ball, ball}, 9.81)));
  EXPECT_TRUE(std::isinf(longest_contact_step({ball, table, table}, 9.81))) << "balls have none";
  EXPECT_TRUE(std::isinf(longest_contact_step({ball, plate, ball}, 9.81)));
  EXPECT_TRUE(std::isinf(longest_contact_step({plate, table}, 0.0)));
}

}  // namespace
}  // namespace splash::sim
