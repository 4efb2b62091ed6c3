// SPDX-License-Identifier: MIT
#include "sim-server/tracking/live_motion.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

constexpr double kBlend = 0.035;      // a wrong prediction is gone after this [s]
constexpr double kWindow = 0.040;     // velocities are fitted to the poses of this time [s]
constexpr double kLeastStep = 0.010;  // poses closer in time are late or early arrivals [s]
constexpr std::size_t kKept = 256;    // stretches kept for questions about the past

/// 1 - (3 u^2 - 2 u^3) on [0, 1] and its derivative: from one to zero without a corner.
double falling(double u) {
  return u >= 1.0 ? 0.0 : 1.0 - u * u * (3.0 - 2.0 * u);
}
double falling_slope(double u) {
  return u >= 1.0 ? 0.0 : -6.0 * u * (1.0 - u);
}

bool finite(const Vector3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

}  // namespace

std::string_view describe(PoseRefusal refusal) noexcept {
  switch (refusal) {
    case PoseRefusal::none:
      return "accepted";
    case PoseRefusal::not_finite:
      return "a number is not finite";
    case PoseRefusal::no_rotation:
      return "the quaternion's length is zero";
    case PoseRefusal::too_far:
      return "the place is beyond the limit";
    case PoseRefusal::too_fast:
      return "the speed is beyond the limit";
    case PoseRefusal::time_ran_back:
      return "it arrived before the pose before it";
  }
  return "unknown";
}

LiveMotion::LiveMotion(const Keyframe& rest, const LiveLimits& limits, const LiveGap& gap)
    : rest_(rest), limits_(limits), gap_(gap) {
  rest_.rotation = unit(rest_.rotation);
}

double LiveMotion::speed_left(double dt) const {
  if (dt < gap_.coast) return 1.0;
  return gap_.fade > 0.0 ? falling((dt - gap_.coast) / gap_.fade) : 0.0;
}

double LiveMotion::way_gone(double dt) const {
  if (dt <= gap_.coast || gap_.fade <= 0.0) return std::min(dt, gap_.coast);
  const double u = std::min((dt - gap_.coast) / gap_.fade, 1.0);
  return gap_.coast + gap_.fade * u * (1.0 - u * u * (1.0 - 0.5 * u));
}

BodyState LiveMotion::state(const Stretch& s, double time) const {
  const double dt = std::max(time - s.time, 0.0);
  const double left = speed_left(dt);
  const double gone = way_gone(dt);
  const double wrong = falling(dt / kBlend);
  const double wrong_slope = falling_slope(dt / kBlend) / kBlend;
  BodyState state;
  state.position = s.position + gone * s.velocity + wrong * s.offset;
  state.velocity = left * s.velocity + wrong_slope * s.offset;
  const Quaternion correction = from_turn(wrong * s.turn_offset);
  state.rotation = unit(compose(correction, compose(from_turn(gone * s.spin), s.rotation)));
  state.spin = wrong_slope * s.turn_offset + rotate(correction, left * s.spin);
  return state;
}

BodyState LiveMotion::predict(double time) const {
  if (stretches_.empty()) return {rest_.position, rest_.rotation, {}, {}};
  if (std::isnan(time)) return state(stretches_.back(), stretches_.back().time);
  const auto after =
      std::upper_bound(stretches_.begin(), stretches_.end(), time,
                       [](double t, const Stretch& stretch) { return t < stretch.time; });
  if (after != stretches_.begin()) return state(*(after - 1), time);
  // Before the first pose that is known.
  const BodyState first = state(stretches_.front(), stretches_.front().time);
  return {first.position, first.rotation, {}, {}};
}

BodyState LiveMotion::at(double seconds) const {
  const std::scoped_lock lock(mutex_);
  return predict(seconds);
}

PoseRefusal LiveMotion::check(const Vector3& position, const Quaternion& rotation,
                              double arrival) const {
  const bool numbers = finite(position) && std::isfinite(arrival) &&
                       std::all_of(rotation.begin(), rotation.end(),
                                   [](double part) { return std::isfinite(part); });
  if (!numbers) return PoseRefusal::not_finite;
  const double size =
      std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3]));
  if (size < 1.0e-3 || !std::isfinite(size)) return PoseRefusal::no_rotation;
  for (const double part : position) {
    if (std::abs(part) > limits_.place) return PoseRefusal::too_far;
  }
  if (stretches_.empty()) return PoseRefusal::none;
  const Stretch& last = stretches_.back();
  if (arrival < last.time) return PoseRefusal::time_ran_back;
  const double dt = std::max(arrival - last.time, kLeastStep);
  const double turn = length(to_turn(compose(unit(rotation), inverse(last.rotation))));
  const bool fast =
      length(position - last.position) > limits_.speed * dt || turn > limits_.spin * dt;
  return fast ? PoseRefusal::too_fast : PoseRefusal::none;
}

PoseRefusal LiveMotion::push(const Vector3& position, const Quaternion& rotation, double arrival) {
  const std::scoped_lock lock(mutex_);
  const PoseRefusal refusal = check(position, rotation, arrival);
  if (refusal != PoseRefusal::none) return refusal;
  Stretch next{arrival, position, unit(rotation), {}, {}, {}, {}};
  set_offsets(next);
  // Two poses in one instant: the later one counts.
  if (!stretches_.empty() && stretches_.back().time >= arrival) stretches_.pop_back();
  set_velocities(next);
  stretches_.push_back(next);
  if (stretches_.size() > kKept) stretches_.pop_front();
  return PoseRefusal::none;
}

void LiveMotion::set_offsets(Stretch& next) const {
  if (stretches_.empty()) return;
  const BodyState guess = predict(next.time);
  next.offset = guess.position - next.position;
  next.turn_offset = to_turn(compose(guess.rotation, inverse(next.rotation)));
  // The fade's steepest part is 1.5 times its mean. A body found elsewhere after a long silence is
  // put there at once instead of being drawn through the water.
  const double speed = 1.5 * length(next.offset) / kBlend;
  const double spin = 1.5 * length(next.turn_offset) / kBlend;
  if (speed > limits_.speed || spin > limits_.spin) {
    next.offset = {};
    next.turn_offset = {};
  }
}

/// The line of least squares through the poses of the last moments: arrival jitter of single
/// packets averages out.
void LiveMotion::set_velocities(Stretch& next) const {
  auto first = stretches_.end();
  while (first != stretches_.begin() && (first - 1)->time >= next.time - kWindow) --first;
  if (first == stretches_.end()) return;
  const double count = static_cast<double>(stretches_.end() - first) + 1.0;
  double mean_time = next.time;
  for (auto it = first; it != stretches_.end(); ++it) mean_time += it->time;
  mean_time /= count;
  double square = 0.0;
  Vector3 way = {};
  Vector3 turn = {};
  const auto add = [&](const Stretch& s) {
    const double t = s.time - mean_time;
    square += t * t;
    way = way + t * (s.position - next.position);
    turn = turn + t * to_turn(compose(s.rotation, inverse(next.rotation)));
  };
  for (auto it = first; it != stretches_.end(); ++it) add(*it);
  add(next);
  // Poses that came (almost) at once say nothing about a speed.
  if (square < 0.5 * kLeastStep * kLeastStep) {
    next.velocity = stretches_.back().velocity;
    next.spin = stretches_.back().spin;
    return;
  }
  next.velocity = (1.0 / square) * way;
  next.spin = (1.0 / square) * turn;
}

}  // namespace splash::sim
