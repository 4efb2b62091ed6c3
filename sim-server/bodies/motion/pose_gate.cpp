// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/pose_gate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

constexpr double kKept = 0.5;           ///< poses are remembered for so long [s]
constexpr std::size_t kMost = 512;      ///< but no more of them
constexpr double kTooOld = 1.0;         ///< before the newest [s]
constexpr std::size_t kForPeriod = 12;  ///< poses
constexpr double kLeastStep = 0.010;    ///< poses closer in time are late or early arrivals [s]

/// What a body is never off its motion by [m, rad], and what it can do [m/s2, rad/s2]: a wrist that
/// snaps, a fist that hits, a foot that stamps.
constexpr double kBase = 0.020;
constexpr double kTurnBase = 0.35;
constexpr double kJerking = 200.0;
constexpr double kLasting = 80.0;
constexpr double kShort = 0.08;  // way of what jerks [m]
constexpr double kSpinGain = 3000.0;
/// How many times its doubt a moment may be wrong.
constexpr double kDoubts = 3.0;
/// What stays off for so long and so often is where the body is.
constexpr double kStays = 0.050;  // [s]
constexpr std::size_t kOften = 3;
/// A motion is known from so many poses of so short a time.
constexpr std::ptrdiff_t kMotion = 3;
constexpr double kRecent = 0.15;     // [s]
constexpr double kForgotten = 0.25;  // [s]

bool finite(const Vector3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// Distance of `place` from the way between two others: a body may stop at any moment.
double off_way(const Vector3& place, const Vector3& from, const Vector3& to) {
  const Vector3 way = to - from;
  const double square = dot(way, way);
  const double share = square > 0.0 ? std::clamp(dot(place - from, way) / square, 0.0, 1.0) : 0.0;
  return length(place - (from + share * way));
}

/// How far a body can get off its way in so much time [m]: it jerks, but not for long.
double room_in(double gap) {
  const double square = 0.5 * gap * gap;
  return std::min(kJerking * square, std::max(kShort, kLasting * square));
}

bool earlier(double time, const TimedPose& pose) {
  return time < pose.time;
}

}  // namespace

PoseRefusal PoseGate::look_at(const Vector3& position, const Quaternion& rotation) const {
  const bool numbers =
      finite(position) && std::all_of(rotation.begin(), rotation.end(),
                                      [](double part) { return std::isfinite(part); });
  if (!numbers) return PoseRefusal::not_finite;
  const double size =
      std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3]));
  if (size < 1.0e-3 || !std::isfinite(size)) return PoseRefusal::no_rotation;
  const bool far = std::any_of(position.begin(), position.end(),
                               [this](double part) { return std::abs(part) > limits_.place; });
  return far ? PoseRefusal::too_far : PoseRefusal::none;
}

double PoseGate::period() const noexcept {
  const std::size_t count = std::min(poses_.size(), kForPeriod);
  if (count < 2) return 0.0;
  const double first = poses_[poses_.size() - count].time;
  return (poses_.back().time - first) / static_cast<double>(count - 1);
}

bool PoseGate::has_jumped() noexcept {
  return std::exchange(jumped_, false);
}

PoseRefusal PoseGate::compare(const TimedPose& pose, double doubt, double scatter) const {
  const auto after = std::upper_bound(poses_.begin(), poses_.end(), pose.time, earlier);
  const TimedPose& before = after == poses_.begin() ? *after : *(after - 1);
  const double gap = std::abs(pose.time - before.time);
  const double way = length(pose.position - before.position);
  const double turn = length(to_turn(compose(pose.rotation, inverse(before.rotation))));
  const double least = std::max(gap, kLeastStep);
  if (way > limits_.speed * least || turn > limits_.spin * least) return PoseRefusal::too_fast;

  // Of a body that has just been found no motion is known.
  const auto recent =
      std::lower_bound(poses_.begin(), poses_.end(), before.time - kRecent,
                       [](const TimedPose& known, double time) { return known.time < time; });
  if (suspects_.empty() && poses_.end() - recent < kMotion) return PoseRefusal::none;

  const PoseFit fit(poses_, before.time,
                    {.period = period(), .doubt = doubt, .speed = 1.0, .spin = 3.0});
  const BodyState known = fit.at(before.time);
  const Vector3 ahead = known.position + (pose.time - before.time) * known.velocity;
  const Vector3 turned = (pose.time - before.time) * known.spin;
  const double wrong = kDoubts * scatter;
  const double place_room = kBase + room_in(gap) + wrong * length(known.velocity);
  const double turn_room = kTurnBase + 0.5 * kSpinGain * gap * gap + wrong * length(known.spin);
  const Vector3 own_turn = to_turn(compose(pose.rotation, inverse(known.rotation)));
  const double off = off_way(pose.position, known.position, ahead);
  const double off_turn = off_way(own_turn, {}, turned);
  if (off > place_room || off_turn > turn_room) return PoseRefusal::outlier;
  if (suspects_.empty() || pose.time - suspects_.back().time > kForgotten) {
    return PoseRefusal::none;
  }
  // With each pose that was refused the room has grown: what is not clearly nearer to the body's
  // own way than to those is one of them.
  const TimedPose& other = suspects_.back();
  const double beside = length(pose.position - other.position);
  const double beside_turn = length(to_turn(compose(pose.rotation, inverse(other.rotation))));
  const bool is_other =
      (0.5 * beside < off && off > kBase) || (0.5 * beside_turn < off_turn && off_turn > kTurnBase);
  return is_other ? PoseRefusal::outlier : PoseRefusal::none;
}

PoseRefusal PoseGate::take(const TimedPose& pose, double doubt, double scatter, double instant) {
  if (poses_.empty()) {
    insert(pose, instant);
    jumped_ = true;
    return PoseRefusal::none;
  }
  if (pose.time < poses_.back().time - kTooOld) return PoseRefusal::too_old;
  const PoseRefusal refusal = compare(pose, doubt, scatter);
  if (refusal != PoseRefusal::none) return suspect(pose, refusal);
  suspects_.clear();
  insert(pose, instant);
  return PoseRefusal::none;
}

PoseRefusal PoseGate::suspect(const TimedPose& pose, PoseRefusal reason) {
  if (!suspects_.empty()) {
    const TimedPose& last = suspects_.back();
    const double gap = std::max(std::abs(pose.time - last.time), kLeastStep);
    const bool goes_on = pose.time > last.time &&
                         length(pose.position - last.position) < kBase + 0.5 * limits_.speed * gap;
    if (!goes_on) suspects_.clear();
  }
  suspects_.push_back(pose);
  const double stays = pose.time - suspects_.front().time;
  if (suspects_.size() < kOften || stays < kStays) return reason;
  poses_ = std::exchange(suspects_, {});
  jumped_ = true;
  return PoseRefusal::none;
}

void PoseGate::insert(const TimedPose& pose, double instant) {
  const auto after = std::upper_bound(poses_.begin(), poses_.end(), pose.time, earlier);
  // Of poses of one instant the last one counts.
  if (after != poses_.begin() && pose.time - (after - 1)->time <= instant) {
    (after - 1)->position = pose.position;
    (after - 1)->rotation = pose.rotation;
    return;
  }
  poses_.insert(after, pose);
  const auto first_kept =
      std::upper_bound(poses_.begin(), poses_.end() - 1, poses_.back().time - kKept, earlier);
  const auto surplus =
      static_cast<std::ptrdiff_t>(poses_.size() > kMost ? poses_.size() - kMost : 0);
  poses_.erase(poses_.begin(), std::max(first_kept, poses_.begin() + surplus));
}

}  // namespace splash::sim
