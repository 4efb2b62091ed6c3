// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/free_motion.hpp"

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// More than the steps of any frame [s].
constexpr double kLookAhead = 0.1;

}  // namespace

BodyState FreeMotion::at(double seconds) const {
  BodyState state = now_;
  const double since = seconds - seconds_;
  // Not the other way round: a time that is no number is the present one.
  if (!(since > 0.0)) return state;
  state.position = now_.position + (since < kLookAhead ? since : kLookAhead) * now_.velocity;
  return state;
}

double FreeMotion::fastest() const {
  return length(start_.velocity);
}

}  // namespace splash::sim
