// SPDX-License-Identifier: MIT
#include "sim-server/detect/body_air.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "sim-server/fluid/air/air_cells.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

/// The air around a body is looked at so far from it [R].
constexpr double kAround = 2.0;

/// The square of a way that is none [m2].
constexpr double kNoWay = 1.0e-12;

struct Box {
  Vector3 lower = {0.0, 0.0, 0.0};
  Vector3 upper = {0.0, 0.0, 0.0};

  [[nodiscard]] bool holds(const Vector3& place, double margin) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (place[axis] < lower[axis] - margin || place[axis] > upper[axis] + margin) return false;
    }
    return true;
  }
};

/// That around the body, and as much of it as lies in the tank or so far outside.
Box around(const BodyExtent& extent, const Tank& tank, double outside) {
  Box box;
  const double wide = kAround * extent.radius;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::max(extent.lower[axis] - wide, tank.lower[axis] - outside);
    box.upper[axis] = std::min(extent.upper[axis] + wide, tank.upper[axis] + outside);
  }
  return box;
}

/// Integral of max(1 - |x|, 0) up to there [1].
double hat_sum(double x) {
  const double up_to = std::clamp(x, -1.0, 1.0);
  return up_to < 0.0 ? 0.5 * (1.0 + up_to) * (1.0 + up_to)
                     : 1.0 - 0.5 * (1.0 - up_to) * (1.0 - up_to);
}

}  // namespace

BodyAir::BodyAir(const Scene& scene, const std::vector<SkinPoint>& skin, double volume)
    : scene_(scene),
      skin_(scene.bodies.size()),
      spacing_(particle_spacing(scene)),
      support_(scene_support(scene)),
      volume_(volume) {
  for (const SkinPoint& point : skin) skin_[static_cast<std::size_t>(point.owner)].push_back(point);
}

/// A body at rest shows what it would if it sank.
BodyExtent BodyAir::extent_of(std::size_t body, const BodyState& state) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  BodyExtent extent;
  extent.state = state;
  extent.lower = {kFar, kFar, kFar};
  extent.upper = {-kFar, -kFar, -kFar};
  const double speed = length(state.velocity);
  if (speed > 0.0) extent.along = (1.0 / speed) * state.velocity;
  double shown = 0.0;
  for (const SkinPoint& point : skin_[body]) {
    const Vector3 place = state.position + rotate(state.rotation, point.place);
    grow_box(place, extent.lower, extent.upper);
    const double part =
        point.area * std::max(dot(rotate(state.rotation, point.normal), extent.along), 0.0);
    shown += part;
    extent.front = extent.front + part * place;
  }
  extent.front = (1.0 / shown) * extent.front;
  extent.radius = std::sqrt(shown / std::numbers::pi);
  extent.thickness = volume_of(scene_.bodies[body].shape) / shown;
  return extent;
}

void BodyAir::move_to(double time, const Bodies& bodies) {
  bodies_ = &bodies;
  tank_ = tank_at(scene_, time);
  extents_.clear();
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    extents_.push_back(extent_of(b, bodies.state(b, time)));
  }
  water_.clear();
}

std::function<double(double)> BodyAir::free_behind(std::size_t body) const {
  const BodyExtent& extent = extents_[body];
  const Quaternion& turn = extent.state.rotation;
  std::map<double, double> area;  // of what faces back, by its distance from the front
  for (const SkinPoint& point : skin_[body]) {
    const double part = point.area * -dot(rotate(turn, point.normal), extent.along);
    const Vector3 place = extent.state.position + rotate(turn, point.place);
    if (part > 0.0) area[dot(extent.front - place, extent.along)] += part;
  }
  double all = 0.0;
  for (auto& [distance, sum] : area) sum = all += sum;
  return [area, all](double distance) {
    const auto next = area.upper_bound(distance);
    return next == area.begin() ? 0.0 : std::prev(next)->second / all;
  };
}

double BodyAir::floor_below(std::size_t body) const {
  return floor_height(scene_, extents_[body].state.position[0]);
}

/// Particles are weighted by how near they are, so that hardly any stands on an edge.
double BodyAir::level_around(std::size_t body) const {
  const BodyExtent& extent = extents_[body];
  std::array<double, 2> middle = {};
  std::array<double, 2> reach = {};
  double area = 1.0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    middle[axis] = 0.5 * (extent.lower[axis] + extent.upper[axis]);
    reach[axis] = 0.5 * (extent.upper[axis] - extent.lower[axis]) + kAround * extent.radius;
    area *= reach[axis] * (hat_sum((tank_.upper[axis] - middle[axis]) / reach[axis]) -
                           hat_sum((tank_.lower[axis] - middle[axis]) / reach[axis]));
  }
  double weights = 0.0;
  for (const Vector3& place : water_) {
    weights += std::max(1.0 - std::abs(place[0] - middle[0]) / reach[0], 0.0) *
               std::max(1.0 - std::abs(place[1] - middle[1]) / reach[1], 0.0);
  }
  return area > 0.0 ? floor_below(body) + weights * volume_ / area : floor_below(body);
}

double BodyAir::depth_in(std::size_t body, const Vector3& place) const {
  const BodyState& state = extents_[body].state;
  const Vector3 local = rotate(inverse(state.rotation), place - state.position);
  return -distance_to(scene_.bodies[body].shape, local);
}

bool BodyAir::is_solid(const Vector3& place) const {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (place[axis] <= tank_.lower[axis] || place[axis] >= tank_.upper[axis]) return true;
  }
  if (place[2] <= floor_height(scene_, place[0])) return true;
  for (std::size_t b = 0; b < extents_.size(); ++b) {
    if (depth_in(b, place) > 0.0) return true;
  }
  return false;
}

/// The air within 2 R of the body and of where it came from, below `level`.
AirCells BodyAir::fill(std::size_t body, const Vector3& from, double level) const {
  BodyExtent extent = extents_[body];
  grow_box(from, extent.lower, extent.upper);
  Box box = around(extent, tank_, spacing_);
  box.upper[2] = level;
  box.lower[2] = std::min(box.lower[2], level - spacing_);
  AirCells air(box.lower, box.upper, spacing_, support_);
  std::vector<Vector3> water;
  std::copy_if(water_.begin(), water_.end(), std::back_inserter(water),
               [&](const Vector3& place) { return box.holds(place, support_); });
  const std::vector<Vector3> all = with_images(std::move(water), tank_, support_);
  for (const Vector3& place : all) air.add(place, volume_);
  for (const BodyPoint& point : bodies_->points()) {
    const BodyState& state = extents_[static_cast<std::size_t>(point.owner)].state;
    const Vector3 place = state.position + rotate(state.rotation, point.place);
    if (box.holds(place, support_)) air.add(place, point.volume);
  }
  air.fill([&](const Vector3& place) { return is_solid(place); });
  return air;
}

bool BodyAir::is_open_to(std::size_t body, const Vector3& from, double level, double below) const {
  const double near = extents_[body].radius;
  const Vector3 way = extents_[body].front - from;
  return fill(body, from, level).any_open([&](const Vector3& place) {
    if (place[2] > level - below) return false;
    const double along =
        std::clamp(dot(place - from, way) / std::max(dot(way, way), kNoWay), 0.0, 1.0);
    return length(place - from - along * way) <= near || -depth_in(body, place) <= near;
  });
}

}  // namespace splash::sim
