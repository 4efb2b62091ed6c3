// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/sole_calibration.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {

namespace {

constexpr double kToesUp = 0.17;     // sine of the pitch above which only the heel can touch
constexpr double kNearFloor = 0.03;  // a heel that stays higher made no step [m]
constexpr double kReach = 0.08;      // the sole is sought this far either way [m]

using Phase = std::span<const RigidFit>;

/// Stretches of the recording with the toes up, without those cut by its ends.
std::vector<Phase> phases_with_toes_up(std::span<const RigidFit> foot) {
  const auto toes_up = [](const RigidFit& pose) {
    return rotate(pose.rotation, {1.0, 0.0, 0.0})[2] > kToesUp;
  };
  std::vector<Phase> phases;
  for (std::size_t begin = 0; begin < foot.size();) {
    if (!toes_up(foot[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < foot.size() && toes_up(foot[end])) ++end;
    if (begin > 0 && end < foot.size()) phases.push_back(foot.subspan(begin, end - begin));
    begin = end;
  }
  return phases;
}

double lowest(const Shape& shape, const Vector3& centre, const Phase& phase) {
  double height = std::numeric_limits<double>::infinity();
  for (const RigidFit& pose : phase) {
    height = std::min(height, sole_height(shape, centre, pose, true));
  }
  return height;
}

/// How high the heel stays in the step in which it stays highest.
double highest_step(const Shape& shape, const Vector3& centre, const std::vector<Phase>& steps) {
  double height = -std::numeric_limits<double>::infinity();
  for (const Phase& step : steps) height = std::max(height, lowest(shape, centre, step));
  return height;
}

}  // namespace

double sole_height(const Shape& shape, const Vector3& centre, const RigidFit& foot,
                   bool rear_only) {
  constexpr int kStations = 60;
  double height = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= (rear_only ? kStations / 2 : kStations); ++i) {
    const double x = shape.size[0] * (static_cast<double>(i) / kStations - 0.5);
    const double z = rocker_rise(shape, x) - 0.5 * shape.size[2];
    for (const double side : {-0.5, 0.5}) {
      const Vector3 point = centre + Vector3{x, side * shape.size[1], z};
      height = std::min(height, (rotate(foot.rotation, point) + foot.translation)[2]);
    }
  }
  return height;
}

Vector3 calibrate_sole(const Shape& shape, std::span<const RigidFit> foot, double width_centre) {
  Vector3 centre = {0.0, width_centre, 0.5 * shape.size[2] - kSoftness};
  std::vector<Phase> steps = phases_with_toes_up(foot);
  std::erase_if(steps, [&](const Phase& step) { return lowest(shape, centre, step) > kNearFloor; });
  // The farther back the sole, the lower its heel while the toes are up: bisect.
  const auto touches = [&](double x) {
    return highest_step(shape, {x, centre[1], centre[2]}, steps) <= -kSoftness;
  };
  double back = -kReach;
  double front = kReach;
  if (steps.empty() || !touches(back) || touches(front)) return centre;
  while (front - back > 1.0e-5) {
    const double middle = 0.5 * (back + front);
    (touches(middle) ? back : front) = middle;
  }
  centre[0] = back;
  return centre;
}

}  // namespace splash::sim
