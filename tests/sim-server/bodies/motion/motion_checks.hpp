// SPDX-License-Identifier: MIT
// What holds for every motion: its velocities are the derivatives of its poses.
#pragma once

#include <gtest/gtest.h>

#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

/// Central differences over 2 microseconds against velocity and spin at `time`.
inline void expect_consistent(const Motion& motion, double time, double tolerance) {
  constexpr double kHalf = 1e-6;
  const BodyState before = motion.at(time - kHalf);
  const BodyState after = motion.at(time + kHalf);
  const BodyState now = motion.at(time);
  const Vector3 velocity = (0.5 / kHalf) * (after.position - before.position);
  const Vector3 spin = (0.5 / kHalf) * to_turn(compose(after.rotation, inverse(before.rotation)));
  EXPECT_LT(length(velocity - now.velocity), tolerance) << "at " << time;
  EXPECT_LT(length(spin - now.spin), tolerance) << "at " << time;
}

}  // namespace splash::sim
