// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/tied_motion.hpp"

#include <algorithm>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// What poses go within a frame beyond what their speed says, before it counts as a jump.
constexpr double kJump = 0.02;    ///< [m]
constexpr double kTurned = 0.35;  ///< [rad]
/// A way over takes so long at least, and is no faster than this.
constexpr double kTakes = 0.2;    ///< [s]
constexpr double kSpeed = 0.5;    ///< [m/s]
constexpr double kTurning = 3.0;  ///< [rad/s]
/// The slope of 3 u^2 - 2 u^3 in its middle.
constexpr double kSteepest = 1.5;
constexpr double kTremble = 1.0e-3;  ///< slower, and it does not move [m/s, rad/s]

}  // namespace

void Tether::go_over(const BodyState& from, double seconds) {
  const BodyState poses = hand_.at(seconds);
  way_ = from.position - poses.position;
  turn_ = to_turn(compose(from.rotation, inverse(poses.rotation)));
  since_ = seconds;
  takes_ = std::max(kTakes, kSteepest * std::max(length(way_) / kSpeed, length(turn_) / kTurning));
}

void Tether::begin(const PlayedFrame& frame) {
  const BodyState before = at(frame.seconds);
  hand_.begin(frame);
  const BodyState now = at(frame.seconds);
  const Vector3 turn = to_turn(compose(now.rotation, inverse(before.rotation)));
  if (length(now.position - before.position) > kJump || length(turn) > kTurned) {
    go_over(before, frame.seconds);
  }
}

void Tether::begin_at(const BodyState& body, double seconds) {
  go_over(body, seconds);
}

BodyState Tether::at(double seconds) const {
  BodyState state = hand_.at(seconds);
  const double u = takes_ > 0.0 ? std::clamp((seconds - since_) / takes_, 0.0, 1.0) : 1.0;
  if (u >= 1.0) return state;
  const double left = 1.0 - u * u * (3.0 - 2.0 * u);
  const double rate = -6.0 * u * (1.0 - u) / takes_;
  state.position = state.position + left * way_;
  state.velocity = state.velocity + rate * way_;
  state.rotation = unit(compose(from_turn(left * turn_), state.rotation));
  state.spin = state.spin + rate * turn_;
  return state;
}

bool Tether::moves(double seconds, double frame) const {
  const BodyState first = at(seconds);
  const BodyState last = at(seconds + frame);
  const auto fast = [](const BodyState& s) {
    return length(s.velocity) > kTremble || length(s.spin) > kTremble;
  };
  return fast(first) || fast(last);
}

}  // namespace splash::sim
