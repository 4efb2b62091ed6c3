// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/live_motion.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

/// A wrong prediction fades out with this time constant, and no faster than in so many periods of
/// the poses: after them the next ones say where the body is [s, 1].
constexpr double kFades = 0.012;
constexpr double kFadesPeriods = 2.0;
/// The speed at which it fades is the body's, but for this much, and for what comes of moments that
/// are wrong by so many standard deviations [m/s, rad/s, 1].
constexpr double kSlack = 0.1;
constexpr double kTurningSlack = 1.0;
constexpr double kDoubts = 3.0;
/// What is wrong by more is no prediction any more: the body is put where it is [m, rad].
constexpr double kFarOff = 0.10;
constexpr double kTurnedOff = 1.0;
/// A frame may play so much more of the poses than its own length [s]; after a longer stall the
/// body is where it is now.
constexpr double kCatchesUp = 0.100;
/// The delay follows the lateness of the poses by these parts of the time that passes [1].
constexpr double kRises = 0.05;
constexpr double kFalls = 0.02;
constexpr double kCoasts = 2.5;  ///< periods
/// Poses without tags that come so near to each other were held up together [s].
constexpr double kInstant = 0.0015;
constexpr double kChanges = 0.008;   ///< [s]
constexpr double kLongPeriod = 0.1;  ///< slower poses are single ones [s]

/// 1 - (3 u^2 - 2 u^3) on [0, 1]: from one to zero without a corner.
double falling(double u) {
  return u >= 1.0 ? 0.0 : 1.0 - u * u * (3.0 - 2.0 * u);
}

struct Fading {
  Vector3 left;  ///< [m, rad]
  Vector3 rate;  ///< its change that is told [m/s, rad/s]
};

/// What is left of an offset `dt` later; changes slower than `slack` are not told.
Fading fading(const Vector3& offset, double fades, double slack, double dt) {
  const Vector3 left = std::exp(-dt / fades) * offset;
  const double rate = length(left) / fades;
  return {left, rate > slack ? -(1.0 - slack / rate) / fades * left : Vector3{}};
}

Vector3 at_most(double limit, const Vector3& vector) {
  const double size = length(vector);
  return size > limit ? (limit / size) * vector : vector;
}

}  // namespace

LiveMotion::LiveMotion(const Keyframe& rest, const LiveLimits& limits, const LiveGap& gap,
                       double delay_limit)
    : rest_(rest), limits_(limits), gap_(gap), delay_limit_(delay_limit), gate_(limits) {
  rest_.rotation = unit(rest_.rotation);
}

double LiveMotion::speed_left(double dt, double coast) const {
  if (dt < coast) return 1.0;
  return gap_.fade > 0.0 ? falling((dt - coast) / gap_.fade) : 0.0;
}

double LiveMotion::way_gone(double dt, double coast) const {
  if (dt <= coast || gap_.fade <= 0.0) return std::min(dt, coast);
  const double u = std::min((dt - coast) / gap_.fade, 1.0);
  return coast + gap_.fade * u * (1.0 - u * u * (1.0 - 0.5 * u));
}

/// The gate lets poses that are a fraction of a millisecond apart differ by as much as poses 10 ms
/// apart may, and a line through them can have any slope.
BodyState LiveMotion::fitted(const Plan& plan, double moment) const {
  BodyState state = plan.fit.at(moment);
  state.velocity = at_most(limits_.speed, state.velocity);
  state.spin = at_most(limits_.spin, state.spin);
  return state;
}

BodyState LiveMotion::played(const Plan& plan, double moment) const {
  if (!plan.seen) return {rest_.position, rest_.rotation, {}, {}};
  if (moment < plan.first) {
    const BodyState first = plan.fit.at(plan.first);
    return {first.position, first.rotation, {}, {}};
  }
  if (moment <= plan.last) return fitted(plan, moment);
  BodyState state = plan.fit.at(plan.last);
  // A change of speed goes on for a moment, and is not believed for longer.
  const BodyState ahead = fitted(plan, plan.last + std::min(moment - plan.last, kChanges));
  state.velocity = ahead.velocity;
  state.spin = ahead.spin;
  const double dt = moment - plan.last;
  const double gone = way_gone(dt, plan.coast);
  const double left = speed_left(dt, plan.coast);
  state.position = state.position + gone * state.velocity;
  state.rotation = unit(compose(from_turn(gone * state.spin), state.rotation));
  state.velocity = left * state.velocity;
  state.spin = left * state.spin;
  return state;
}

BodyState LiveMotion::state(const Plan& plan, double seconds) const {
  const double dt = std::isfinite(seconds) ? std::max(seconds - plan.seconds, 0.0) : 0.0;
  BodyState state = played(plan, plan.start + plan.rate * dt);
  const Fading way = fading(plan.offset, plan.fades, plan.slack, dt);
  const Fading turn = fading(plan.turn_offset, plan.fades, plan.turning_slack, dt);
  state.position = state.position + way.left;
  state.velocity = state.velocity + way.rate;
  state.rotation = unit(compose(from_turn(turn.left), state.rotation));
  state.spin = state.spin + turn.rate;
  return state;
}

BodyState LiveMotion::at(double seconds) const {
  return state(plan_, seconds);
}

PoseRefusal LiveMotion::push(const Vector3& position, const Quaternion& rotation,
                             const PoseStamp& stamp) {
  const std::scoped_lock lock(mutex_);
  const bool times =
      std::isfinite(stamp.arrival) && std::isfinite(stamp.sent.value_or(stamp.arrival));
  if (!times) return PoseRefusal::not_finite;
  const PoseRefusal refusal = gate_.look_at(position, rotation);
  if (refusal != PoseRefusal::none) return refusal;
  if (clock_.is_before(stamp.arrival)) return PoseRefusal::time_ran_back;
  const double taken = clock_.taken(stamp);
  return gate_.take({taken, position, unit(rotation)}, clock_.doubt(), clock_.scatter(),
                    stamp.sent ? 0.0 : kInstant);
}

/// The moment that is played never runs back. Where simulated time slipped, or the delay shrinks,
/// a frame plays more than its own length.
void LiveMotion::set_time(Plan& next, const PlayedFrame& frame, double lateness,
                          double period) const {
  const double hold = gap_.hold ? period + frame.length : 0.0;
  const double wanted = std::clamp(lateness, 0.0, delay_limit_) + hold;
  const double passed = std::max(frame.wall - wall_, 0.0);
  next.delay = !plan_.seen ? wanted
                           : plan_.delay + std::clamp(wanted - plan_.delay, -kFalls * passed,
                                                      kRises * passed);
  const double end = frame.wall + frame.length - next.delay;
  const double before = plan_.start + plan_.rate * (frame.seconds - plan_.seconds);
  const bool goes_on = plan_.seen && frame.length > 0.0 && frame.seconds >= plan_.seconds &&
                       end - before <= frame.length + kCatchesUp;
  next.seconds = frame.seconds;
  next.start = goes_on ? before : end - frame.length;
  next.rate = goes_on ? std::max(end - before, 0.0) / frame.length : 1.0;
}

void LiveMotion::set_offsets(Plan& next, bool jumped) const {
  const double before = plan_.start + plan_.rate * (next.seconds - plan_.seconds);
  if (jumped || !plan_.seen || next.start != before) return;
  const BodyState old = state(plan_, next.seconds);
  const BodyState now = played(next, next.start);
  next.offset = old.position - now.position;
  next.turn_offset = to_turn(compose(old.rotation, inverse(now.rotation)));
  if (length(next.offset) > kFarOff || length(next.turn_offset) > kTurnedOff) {
    next.offset = {};
    next.turn_offset = {};
  }
}

void LiveMotion::begin(const PlayedFrame& frame) {
  Plan next;
  bool jumped = false;
  {
    const std::scoped_lock lock(mutex_);
    const std::vector<TimedPose>& poses = gate_.poses();
    if (poses.empty()) return;
    const double period = gate_.period();
    next.seen = true;
    next.first = poses.front().time;
    next.last = poses.back().time;
    next.coast = gap_.coast;
    if (!gap_.hold && period < kLongPeriod) next.coast = std::max(gap_.coast, kCoasts * period);
    set_time(next, frame, clock_.lateness(), period);
    const double middle = next.start + 0.5 * next.rate * frame.length;
    const BodyState now = state(plan_, frame.seconds);
    next.fit = PoseFit(poses, std::clamp(middle, next.first, next.last),
                       {.period = period,
                        .doubt = clock_.doubt(),
                        .speed = length(now.velocity),
                        .spin = length(now.spin)});
    next.fades = std::max(kFades, kFadesPeriods * std::min(period, kLongPeriod));
    const double doubted = kDoubts * clock_.doubt() / next.fades;
    next.slack = kSlack + doubted * length(now.velocity);
    next.turning_slack = kTurningSlack + doubted * length(now.spin);
    jumped = gate_.has_jumped();
  }
  set_offsets(next, jumped);
  plan_ = next;
  wall_ = frame.wall;
}

}  // namespace splash::sim
