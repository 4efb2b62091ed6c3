// SPDX-License-Identifier: MIT
#include "sim-server/bodies/body_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// The farthest point of a body that appears moves away from its centre so fast, as in a plunge: an
/// eighth of the slowest sound that scenes have by default, about [m/s].
constexpr double kAppears = 2.0;
/// What it begins with [1].
constexpr double kSeed = 1.0e-3;

/// A body that has been still for so long is at rest [s].
constexpr double kRest = 1.0;

}  // namespace

BodyState state_of(const BodyStep& step) noexcept {
  const Quaternion q = {static_cast<double>(step.qx), static_cast<double>(step.qy),
                        static_cast<double>(step.qz), static_cast<double>(step.qw)};
  return {vector(step.px, step.py, step.pz), unit(q), vector(step.vx, step.vy, step.vz),
          vector(step.wx, step.wy, step.wz)};
}

float fastest_point(const BodyStep& b) noexcept {
  const float reach =
      0.5F * std::hypot(b.upper_x - b.lower_x, b.upper_y - b.lower_y, b.upper_z - b.lower_z);
  return std::hypot(b.vx, b.vy, b.vz) + reach * std::hypot(b.wx, b.wy, b.wz);
}

Bodies::Bodies(std::vector<BodyPoint> points, std::vector<std::unique_ptr<Motion>> motions,
               double support)
    : points_(std::move(points)),
      motions_(std::move(motions)),
      force_(motions_.size()),
      moved_at_(motions_.size(), 0.0),
      appeared_at_(motions_.size(), -std::numeric_limits<double>::infinity()),
      reach_(motions_.size(), 0.0),
      support_(support) {
  for (const auto& motion : motions_) free_.push_back(dynamic_cast<FreeMotion*>(motion.get()));
  for (const auto& motion : motions_) start_.push_back(motion->at(0.0));
  for (const BodyPoint& point : points_) {
    double& reach = reach_[static_cast<std::size_t>(point.owner)];
    reach = std::max(reach, length(point.place));
  }
}

BodyState Bodies::state(std::size_t body, double seconds) const {
  return motions_[body]->at(seconds);
}

std::vector<BodyStep> Bodies::at(double seconds) const {
  std::vector<BodyStep> steps(motions_.size());
  for (std::size_t b = 0; b < motions_.size(); ++b) {
    const BodyState s = motions_[b]->at(seconds);
    BodyStep& step = steps[b];
    step.px = as_float(s.position[0]);
    step.py = as_float(s.position[1]);
    step.pz = as_float(s.position[2]);
    step.qx = as_float(s.rotation[0]);
    step.qy = as_float(s.rotation[1]);
    step.qz = as_float(s.rotation[2]);
    step.qw = as_float(s.rotation[3]);
    step.vx = as_float(s.velocity[0]);
    step.vy = as_float(s.velocity[1]);
    step.vz = as_float(s.velocity[2]);
    step.wx = as_float(s.spin[0]);
    step.wy = as_float(s.spin[1]);
    step.wz = as_float(s.spin[2]);
    step.lower_x = step.upper_x = step.px;
    step.lower_y = step.upper_y = step.py;
    step.lower_z = step.upper_z = step.pz;
  }
  for (const BodyPoint& point : points_) {
    BodyStep& step = steps[static_cast<std::size_t>(point.owner)];
    const Quaternion q = {static_cast<double>(step.qx), static_cast<double>(step.qy),
                          static_cast<double>(step.qz), static_cast<double>(step.qw)};
    const Vector3 arm = rotate(q, point.place);
    const float x = step.px + as_float(arm[0]);
    const float y = step.py + as_float(arm[1]);
    const float z = step.pz + as_float(arm[2]);
    step.lower_x = std::min(step.lower_x, x);
    step.lower_y = std::min(step.lower_y, y);
    step.lower_z = std::min(step.lower_z, z);
    step.upper_x = std::max(step.upper_x, x);
    step.upper_y = std::max(step.upper_y, y);
    step.upper_z = std::max(step.upper_z, z);
  }
  const float grown = as_float(support_);
  for (BodyStep& step : steps) {
    step.lower_x -= grown;
    step.lower_y -= grown;
    step.lower_z -= grown;
    step.upper_x += grown;
    step.upper_y += grown;
    step.upper_z += grown;
    step.speed = fastest_point(step);
  }
  for (std::size_t b = 0; b < steps.size(); ++b) {
    if (!appears(b, seconds)) continue;
    const double rate = kAppears / reach_[b];
    steps[b].lacks = as_float(1.0 - std::max(rate * (seconds - appeared_at_[b]), kSeed));
    steps[b].grows = as_float(rate);
    steps[b].speed += as_float(kAppears);
  }
  return steps;
}

bool Bodies::appears(std::size_t body, double seconds) const {
  return kAppears * (seconds - appeared_at_[body]) < (1.0 - kSeed) * reach_[body];
}

void Bodies::note_jump(std::size_t body, const BodyState& before, double seconds) {
  const BodyState now = state(body, seconds);
  const double turn = length(to_turn(compose(now.rotation, inverse(before.rotation))));
  if (length(now.position - before.position) + turn * reach_[body] > support_) {
    appeared_at_[body] = seconds;
  }
}

double Bodies::fastest_ever() const {
  double fastest = 0.0;
  for (const auto& motion : motions_) fastest = std::max(fastest, motion->fastest());
  return fastest;
}

int Bodies::nearest(const Vector3& place, double seconds) const {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < motions_.size(); ++b) {
    const double distance = length(place - state(b, seconds).position);
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(b);
    }
  }
  return nearest;
}

void Bodies::put(std::size_t body, const BodyState& state, const BodyForce& force, double seconds) {
  free_[body]->put(state, seconds);
  force_[body] = force;
  const double speed = length(state.velocity) + length(state.spin) * reach_[body];
  if (speed > static_cast<double>(SPLASH_TREMBLE)) moved_at_[body] = seconds;
}

void Bodies::hold(double seconds, bool still) {
  for (FreeMotion* motion : free_) {
    if (motion == nullptr) continue;
    if (still) motion->zero_velocities();
    motion->hold(seconds);
  }
}

void Bodies::reset(double seconds) {
  for (FreeMotion* motion : free_) {
    if (motion != nullptr) motion->reset(seconds);
  }
  std::fill(moved_at_.begin(), moved_at_.end(), seconds);
  for (std::size_t b = 0; b < motions_.size(); ++b) note_jump(b, start_[b], seconds);
}

bool Bodies::restless(double seconds) const noexcept {
  for (std::size_t b = 0; b < free_.size(); ++b) {
    if (free_[b] != nullptr && seconds - moved_at_[b] < kRest) return true;
  }
  return false;
}

double Bodies::fastest(double seconds) const {
  double fastest = 0.0;
  for (std::size_t b = 0; b < motions_.size(); ++b) {
    const BodyState s = motions_[b]->at(seconds);
    const double grows = appears(b, seconds) ? kAppears : 0.0;
    fastest = std::max(fastest, length(s.velocity) + length(s.spin) * reach_[b] + grows);
  }
  return fastest;
}

}  // namespace splash::sim
