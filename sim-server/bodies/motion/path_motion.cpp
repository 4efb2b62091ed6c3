// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/path_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

/// A stretch between two poses is looked at in so many parts.
constexpr int kParts = 4;

/// Slope at a knot between two stretches of lengths h and mean slopes d.
double slope(Between between, double h0, double d0, double h1, double d1) {
  if (between == Between::through) return (h1 * d0 + h0 * d1) / (h0 + h1);
  if (d0 * d1 <= 0.0) return 0.0;
  // Fritsch & Butland's weighted harmonic mean keeps each stretch monotone.
  const double w0 = 2.0 * h1 + h0;
  const double w1 = h1 + 2.0 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

Vector3 slope(Between between, double h0, const Vector3& d0, double h1, const Vector3& d1) {
  Vector3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = slope(between, h0, d0[i], h1, d1[i]);
  return result;
}

/// Mean velocity and mean spin (in either end's own frame: its axis is theirs) of a stretch.
struct Mean {
  double h;
  Vector3 velocity;
  Vector3 spin;
};

}  // namespace

PathMotion::PathMotion(const std::vector<Keyframe>& poses, Between between, bool repeat,
                       double start)
    : straight_(between == Between::straight), repeat_(repeat), start_(start) {
  if (poses.empty()) throw std::invalid_argument("a path needs at least one pose");
  for (const Keyframe& pose : poses) {
    if (!knots_.empty() && !(pose.time > knots_.back().time)) {
      throw std::invalid_argument("the times of a path must increase");
    }
    knots_.push_back({pose.time, pose.position, unit(pose.rotation), {}, {}});
  }
  if (knots_.size() > 1 && !(start_ < knots_.back().time)) {
    throw std::invalid_argument("the motion starts at " + std::to_string(start_) +
                                " s, but the recording ends at " +
                                std::to_string(knots_.back().time) + " s");
  }
  if (knots_.size() > 1 && !straight_) set_slopes(between);
  if (repeat_) check_repeat();
}

void PathMotion::set_slopes(Between between) {
  std::vector<Mean> means;
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const Knot& a = knots_[i];
    const Knot& b = knots_[i + 1];
    const double h = b.time - a.time;
    means.push_back({h, (1.0 / h) * (b.position - a.position),
                     (1.0 / h) * to_turn(compose(inverse(a.rotation), b.rotation))});
  }
  const auto set = [between](Knot& knot, const Mean& before, const Mean& after) {
    knot.velocity = slope(between, before.h, before.velocity, after.h, after.velocity);
    knot.spin = slope(between, before.h, before.spin, after.h, after.spin);
  };
  for (std::size_t i = 1; i < means.size(); ++i) set(knots_[i], means[i - 1], means[i]);
  if (repeat_ && start_ <= knots_.front().time) {
    set(knots_.front(), means.back(), means.front());
    set(knots_.back(), means.back(), means.front());
  } else if (between == Between::through) {
    // A recording is cut out of a motion that went on: it begins and ends at speed.
    knots_.front().velocity = means.front().velocity;
    knots_.front().spin = means.front().spin;
    knots_.back().velocity = means.back().velocity;
    knots_.back().spin = means.back().spin;
  }
}

void PathMotion::check_repeat() const {
  constexpr double kNear = 0.01;    // m
  constexpr double kTurned = 0.09;  // rad, 5 degrees
  const BodyState first = on_path(start_);
  const Knot& last = knots_.back();
  const double gap = length(last.position - first.position);
  const double turn = length(to_turn(compose(inverse(first.rotation), last.rotation)));
  if (gap <= kNear && turn <= kTurned) return;
  throw std::invalid_argument("the motion cannot repeat: its last pose is " + std::to_string(gap) +
                              " m and " + std::to_string(turn) +
                              " rad from its first (allowed: 0.01 m and 0.09 rad)");
}

BodyState PathMotion::at(double seconds) const {
  double time = start_ + (std::isnan(seconds) ? 0.0 : seconds);
  const double first = std::max(start_, knots_.front().time);
  const double period = knots_.back().time - first;
  if (repeat_ && period > 0.0 && std::isfinite(time) && time > knots_.back().time) {
    time = first + std::fmod(time - first, period);
  }
  return on_path(time);
}

std::vector<double> PathMotion::moments() const {
  std::vector<double> moments = {0.0};
  for (std::size_t k = 1; k < knots_.size(); ++k) {
    const double from = knots_[k - 1].time;
    for (int part = 1; part <= kParts; ++part) {
      const double time = from + (knots_[k].time - from) * part / kParts - start_;
      if (time > 0.0) moments.push_back(time);
    }
  }
  return moments;
}

double PathMotion::fastest() const {
  // Between two poses speed is a parabola of time along each axis, or constant: five places in each
  // stretch miss at most a sixteenth of what bends.
  double fastest = 0.0;
  for (std::size_t k = 1; k < knots_.size(); ++k) {
    const Knot& from = knots_[k - 1];
    const Knot& to = knots_[k];
    if (to.time <= start_) continue;
    for (int part = 0; part <= kParts; ++part) {
      const double time = from.time + (to.time - from.time) * part / kParts;
      const BodyState state = straight_ ? straight(from, to, time) : cubic(from, to, time);
      fastest = std::max(fastest, length(state.velocity));
    }
  }
  return fastest;
}

BodyState PathMotion::on_path(double time) const {
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), time,
                                      [](double t, const Knot& knot) { return t < knot.time; });
  if (after == knots_.begin() || after == knots_.end()) {
    const Knot& end = after == knots_.begin() ? knots_.front() : knots_.back();
    return {end.position, end.rotation, {}, {}};
  }
  const Knot& from = *(after - 1);
  return straight_ ? straight(from, *after, time) : cubic(from, *after, time);
}

BodyState PathMotion::straight(const Knot& from, const Knot& to, double time) const {
  const double h = to.time - from.time;
  const double s = (time - from.time) / h;
  const Vector3 way = to.position - from.position;
  const Vector3 turn = to_turn(compose(inverse(from.rotation), to.rotation));
  const Quaternion rotation = unit(compose(from.rotation, from_turn(s * turn)));
  return {from.position + s * way, rotation, (1.0 / h) * way,
          rotate(from.rotation, (1.0 / h) * turn)};
}

BodyState PathMotion::cubic(const Knot& from, const Knot& to, double time) const {
  const double h = to.time - from.time;
  const double s = (time - from.time) / h;
  const double r = 1.0 - s;
  BodyState state;
  // Position: cubic Hermite.
  const Vector3 way = to.position - from.position;
  state.position = from.position + (s * s * (3.0 - 2.0 * s)) * way +
                   (h * s * r * r) * from.velocity - (h * s * s * r) * to.velocity;
  state.velocity = (6.0 * s * r / h) * way + (r * (1.0 - 3.0 * s)) * from.velocity +
                   (s * (3.0 * s - 2.0)) * to.velocity;
  // Rotation: Kim, Kim & Shin 1995, cumulative Bezier q = q0 e(b1 w1) e(b2 w2) e(b3 w3) with
  // b1 = 1 - (1-s)^3, b2 = 3 s^2 - 2 s^3, b3 = s^3, w1 and w3 from the spins at the ends.
  const Vector3 w1 = (h / 3.0) * from.spin;
  const Vector3 w3 = (h / 3.0) * to.spin;
  const Quaternion middle = compose(compose(inverse(from_turn(w1)), inverse(from.rotation)),
                                    compose(to.rotation, inverse(from_turn(w3))));
  const Vector3 w2 = to_turn(middle);
  const Quaternion q1 = compose(from.rotation, from_turn((1.0 - r * r * r) * w1));
  const Quaternion q2 = compose(q1, from_turn((s * s * (3.0 - 2.0 * s)) * w2));
  state.rotation = unit(compose(q2, from_turn((s * s * s) * w3)));
  state.spin = rotate(from.rotation, (3.0 * r * r / h) * w1) + rotate(q1, (6.0 * s * r / h) * w2) +
               rotate(q2, (3.0 * s * s / h) * w3);
  return state;
}

}  // namespace splash::sim
