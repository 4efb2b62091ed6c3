// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/pose_fit.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/symmetric_matrix.hpp"

namespace splash::sim {

namespace {

/// Poses this near count: at least so long, so many periods, so many times their doubt [s].
constexpr double kNear = 0.030;
constexpr double kPeriods = 3.5;
constexpr double kDoubts = 26.0;
constexpr double kFar = 0.150;
/// What trackers are off by [m, rad], and what bodies in hand and on foot are likely to do
/// [m/s2, rad/s2]: together they say how far a change of speed is believed.
constexpr double kNoise = 0.0005;
constexpr double kTurnNoise = 0.002;
constexpr double kAcceleration = 30.0;
constexpr double kSpinGain = 200.0;
/// Fastest motions, one standard deviation: what is unknown is taken to be slow [m/s, rad/s].
constexpr double kSpeed = 10.0;
constexpr double kSpin = 50.0;
constexpr double kScale = 0.01;  ///< times are counted in these, for the sake of the numbers [s]

/// Sums of weights times powers of time; each row of `right` those of a coordinate.
struct Sums {
  Matrix<3> left = {};
  Matrix<3> right = {};

  void add(double t, double weight, const Vector3& value) {
    const Vector3 powers = {1.0, t, 0.5 * t * t};
    for (std::size_t i = 0; i < 3; ++i) {
      left[i] = left[i] + (weight * powers[i]) * powers;
      right[i] = right[i] + (weight * value[i]) * powers;
    }
  }
  /// Value, slope and bend, as far as `noise` lets believe in slopes and bends of those sizes.
  void solve_for(double noise, double slope, double bend, Vector3& value, Vector3& first,
                 Vector3& second) {
    const double doubt1 = noise / (slope * kScale);
    const double doubt2 = noise / (bend * kScale * kScale);
    left[1][1] += doubt1 * doubt1;
    left[2][2] += doubt2 * doubt2;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vector3 all = solve(left, right[axis]);
      value[axis] = all[0];
      first[axis] = all[1] / kScale;
      second[axis] = all[2] / (kScale * kScale);
    }
  }
};

}  // namespace

PoseFit::PoseFit(const std::vector<TimedPose>& poses, double time, const PoseQuality& quality)
    : time_(time) {
  const double reach =
      std::min(std::max({kNear, kPeriods * quality.period, kDoubts * quality.doubt}), kFar);
  const auto nearest =
      std::min_element(poses.begin(), poses.end(), [time](const TimedPose& a, const TimedPose& b) {
        return std::abs(a.time - time) < std::abs(b.time - time);
      });
  reference_ = nearest->rotation;
  const Vector3 origin = nearest->position;
  Sums ways;
  Sums turns;
  for (const TimedPose& pose : poses) {
    const double share = (pose.time - time) / reach;
    const bool is_nearest = &pose == &*nearest;
    if (std::abs(share) >= 1.0 && !is_nearest) continue;
    const double falls = std::max(1.0 - share * share, 0.01);
    const double t = (pose.time - time) / kScale;
    ways.add(t, falls * falls, pose.position - origin);
    turns.add(t, falls * falls, to_turn(compose(pose.rotation, inverse(reference_))));
  }
  const double noise = std::hypot(kNoise, quality.doubt * quality.speed);
  const double turn_noise = std::hypot(kTurnNoise, quality.doubt * quality.spin);
  ways.solve_for(noise, kSpeed, kAcceleration, position_, velocity_, acceleration_);
  turns.solve_for(turn_noise, kSpin, kSpinGain, turn_, spin_, spin_gain_);
  position_ = position_ + origin;
}

BodyState PoseFit::at(double time) const {
  const double dt = time - time_;
  BodyState state;
  state.position = position_ + dt * velocity_ + (0.5 * dt * dt) * acceleration_;
  state.velocity = velocity_ + dt * acceleration_;
  const Vector3 turn = turn_ + dt * spin_ + (0.5 * dt * dt) * spin_gain_;
  state.rotation = unit(compose(from_turn(turn), reference_));
  state.spin = spin_ + dt * spin_gain_;
  return state;
}

}  // namespace splash::sim
