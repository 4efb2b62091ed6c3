// SPDX-License-Identifier: MIT
#include "sim-server/detect/wake_air.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim-server/detect/cavity_laws.hpp"
#include "sim-server/detect/impacts.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kDrag = 1.1;          ///< C_d of a disc [1]
constexpr double kEddies = 1.0 / 3.0;  ///< speed of a wake's eddies, of the body's [1]

/// How long the hollow behind each body is open [s].
std::vector<double> closing_times(const std::vector<SurfacePoint>& points, double gravity) {
  std::vector<double> shown;  // [m2]
  for (const SurfacePoint& point : points) {
    const auto body = static_cast<std::size_t>(point.body);
    if (body >= shown.size()) shown.resize(body + 1, 0.0);
    const Vector3 way = velocity_of(point.touch);
    const double speed = length(way);
    if (speed <= 0.0) continue;
    shown[body] += point.area * std::max(dot(way, normal_of(point.touch)), 0.0) / speed;
  }
  std::vector<double> times;
  for (const double area : shown) {
    times.push_back(closing_time(std::sqrt(area / std::numbers::pi), gravity));
  }
  return times;
}

}  // namespace

/// Takes what bodies take down; returns their work [J].
double Wakes::take(double time, double frame, const std::vector<SurfacePoint>& points,
                   const ImpactWatch& impacts, const DetectSettings& settings) {
  double work = 0.0;
  const double least = settings.bubble_onset / kEddies;
  const std::vector<double> closing = closing_times(points, gravity_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& entry = impacts.entry(i);
    if (!entry) continue;
    const SurfacePoint& point = points[i];
    const double closes = closing[static_cast<std::size_t>(point.body)];
    const double open = std::min(time, entry->time + closes) - std::max(time - frame, entry->time);
    const Vector3 way = entry->way - entry->water;
    const double pushes = dot(way, normal_of(point.touch));  // [m/s]
    if (open <= 0.0 || pushes <= least) continue;
    const double power = 0.5 * kDrag * pushes * (pushes * pushes - least * least) * point.area;
    const double lift = gravity_ * 0.5 * length(way) * closes;  // [m2/s2]
    taken_.push_back({time + 0.5 * closes, open * settings.bubble_drag * power / lift,
                      static_cast<int>(i), point.touch});
    work += density_ * power * open;
  }
  return work;
}

WakeAir Wakes::observe(double time, double frame, const std::vector<SurfacePoint>& points,
                       const ImpactWatch& impacts, const DetectSettings& settings) {
  WakeAir now;
  if (gravity_ > 0.0 && settings.bubble_drag > 0.0) {
    now.work = take(time, frame, points, impacts, settings);
  }
  std::erase_if(taken_, [&](const Taken& taken) {
    if (taken.breaks_up > time) return false;
    const Touch& at = taken.touch;
    now.folds.push_back(
        {first_id_ + taken.point, at.x, at.y, at.z, static_cast<float>(taken.air / frame)});
    return true;
  });
  return now;
}

}  // namespace splash::sim
