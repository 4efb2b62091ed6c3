// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/grabbed_motion.hpp"

#include <algorithm>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kStaysOut = 0.5;   ///< poses that come no more have let go [s]
constexpr double kTakesHold = 0.1;  ///< the shortest way to the poses [s]
constexpr double kLetsGo = 0.5;     ///< and the shortest back [s]
/// What the blend adds to a body's speed, at most [m/s].
constexpr double kSpeed = 2.0;
/// The slope of 3 u^2 - 2 u^3 in its middle.
constexpr double kSteepest = 1.5;

}  // namespace

void GrabbedMotion::grab(bool on) {
  const std::scoped_lock lock(mutex_);
  grabbed_anew_ = grabbed_anew_ || (on && !grabbed_);
  grabbed_ = on;
}

PoseRefusal GrabbedMotion::push(const Vector3& position, const Quaternion& rotation,
                                const PoseStamp& stamp) {
  const std::scoped_lock lock(mutex_);
  if (!grabbed_) return PoseRefusal::not_tracked;
  if (hand_ == nullptr || grabbed_anew_) return PoseRefusal::none;  // this frame is the old hand's
  const PoseRefusal refusal = hand_->push(position, rotation, stamp);
  if (refusal == PoseRefusal::none) last_pose_ = stamp.arrival;
  return refusal;
}

GrabbedMotion::Share GrabbedMotion::share(double seconds) const {
  const double to = held_ ? 1.0 : 0.0;
  const double u = takes_ > 0.0 ? std::clamp((seconds - since_) / takes_, 0.0, 1.0) : 1.0;
  const double rate = takes_ > 0.0 ? 6.0 * u * (1.0 - u) / takes_ : 0.0;
  return {from_ + (to - from_) * u * u * (3.0 - 2.0 * u), (to - from_) * rate};
}

void GrabbedMotion::turn_over(double seconds, bool held) {
  const double way = length(hand_->at(seconds).position - own(seconds).position);
  from_ = share(seconds).value;
  since_ = seconds;
  takes_ = std::max(held ? kTakesHold : kLetsGo, kSteepest * way / kSpeed);
  held_ = held;
}

void GrabbedMotion::begin(const PlayedFrame& frame) {
  const std::scoped_lock lock(mutex_);
  if (grabbed_anew_ && share(frame.seconds).value == 0.0) {
    const BodyState now = own(frame.seconds);
    hand_ = std::make_unique<LiveMotion>(Keyframe{0.0, now.position, now.rotation});
    last_pose_ = 0.0;
  }
  grabbed_anew_ = false;
  if (hand_ == nullptr) return;
  hand_->begin(frame);
  const bool held = grabbed_ && last_pose_ > 0.0 && frame.wall - last_pose_ < kStaysOut;
  if (held != held_) turn_over(frame.seconds, held);
}

BodyState GrabbedMotion::at(double seconds) const {
  const BodyState script = own(seconds);
  const auto [share, rate] = this->share(seconds);
  if (share == 0.0 && rate == 0.0) return script;
  const BodyState hand = hand_->at(seconds);
  if (share == 1.0 && rate == 0.0) return hand;
  const Vector3 way = hand.position - script.position;
  const Vector3 turn = to_turn(compose(hand.rotation, inverse(script.rotation)));
  BodyState state;
  state.position = script.position + share * way;
  state.rotation = unit(compose(from_turn(share * turn), script.rotation));
  state.velocity = (1.0 - share) * script.velocity + share * hand.velocity + rate * way;
  state.spin = (1.0 - share) * script.spin + share * hand.spin + rate * turn;
  return state;
}

}  // namespace splash::sim
