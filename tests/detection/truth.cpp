// SPDX-License-Identifier: MIT
#include "tests/detection/truth.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::detection {
namespace {

using namespace sim;  // operators of vectors among it

/// Heights are looked at so often [s], and bisected so often between.
constexpr double kStep = 0.001;
constexpr int kBisections = 40;

/// The underside of a rocker is looked at in so many places.
constexpr int kPlaces = 17;

/// Around the speed below which a body is silent either is right [1].
constexpr double kSurelySlow = 0.9;
constexpr double kSurelyFast = 1.15;

/// Places in body axes of which one is the lowest, however the body is turned [m].
std::vector<Vector3> corners_of(const Shape& shape) {
  if (shape.kind == ShapeKind::mesh) return shape.mesh->surface.vertices;
  std::vector<Vector3> all;
  const Vector3 half = {0.5 * shape.size[0], 0.5 * shape.size[1], 0.5 * shape.size[2]};
  const int places = shape.rocker > 0.0 ? kPlaces : 2;
  for (int k = 0; k < places; ++k) {
    const double x = (static_cast<double>(k) / (places - 1) - 0.5) * shape.size[0];
    for (const double y : {-half[1], half[1]}) {
      all.push_back({x, y, -half[2] + sim::rocker_rise(shape, x)});
      all.push_back({x, y, half[2]});
    }
  }
  return all;
}

Vector3 lowest_of(const std::vector<Vector3>& corners, const sim::BodyState& state) {
  Vector3 lowest = {0.0, 0.0, std::numeric_limits<double>::infinity()};
  for (const Vector3& corner : corners) {
    const Vector3 place = sim::rotate(state.rotation, corner);
    if (place[2] < lowest[2]) lowest = place;
  }
  return state.position + lowest;
}

/// A body that is asked again and again.
class Underside {
 public:
  explicit Underside(const Shape& shape) : shape_(shape) {
    if (shape.kind == ShapeKind::box || shape.kind == ShapeKind::mesh) {
      corners_ = corners_of(shape);
    }
  }
  [[nodiscard]] Vector3 at(const sim::BodyState& state) const {
    const double radius = 0.5 * shape_.size[0];
    if (shape_.kind == ShapeKind::sphere) {
      return state.position - Vector3{0.0, 0.0, radius};
    }
    if (shape_.kind == ShapeKind::cylinder) return rim(state, radius);
    return lowest_of(corners_, state);
  }

 private:
  /// The lowest place of the lower of its two rims.
  [[nodiscard]] Vector3 rim(const sim::BodyState& state, double radius) const {
    const Vector3 axis = sim::rotate(state.rotation, {0.0, 0.0, 1.0});
    const double end = std::copysign(0.5 * shape_.size[2], -axis[2]);
    Vector3 across = {axis[2] * axis[0], axis[2] * axis[1], axis[2] * axis[2] - 1.0};
    const double size = sim::length(across);
    across = size > 1.0e-9 ? (radius / size) * across : Vector3{radius, 0.0, 0.0};
    return state.position + end * axis + across;
  }

  const Shape& shape_;
  std::vector<Vector3> corners_;
};

}  // namespace

Vector3 lowest_point(const Shape& shape, const sim::BodyState& state) {
  return Underside(shape).at(state);
}

std::vector<Entry> entries_of(std::size_t body, const Shape& shape, const Path& path, double level,
                              double end, const Limits& limits) {
  const Underside underside(shape);
  const auto height = [&](double time) { return underside.at(path(time))[2] - level; };
  std::vector<Entry> entries;
  double before = height(0.0);
  double clear = before;
  const auto steps = static_cast<int>(std::ceil(end / kStep));
  for (int k = 1; k <= steps; ++k) {
    const double now = height(k * kStep);
    clear = std::max(clear, now);
    if (before > 0.0 && now <= 0.0) {
      double above = (k - 1) * kStep;
      double below = k * kStep;
      for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (above + below);
        (height(middle) > 0.0 ? above : below) = middle;
      }
      // Of the point that is the lowest then, not of whichever is the lowest before and after.
      const sim::BodyState state = path(below);
      const Vector3 arm = underside.at(state) - state.position;
      const Vector3 velocity = state.velocity + sim::cross(state.spin, arm);
      Entry entry = {body, below, below, -velocity[2], clear, false};
      if (entry.down >= kSurelySlow * limits.impact_speed) {
        entry.wanted =
            entry.down >= kSurelyFast * limits.impact_speed && entry.clear >= limits.clear;
        entries.push_back(entry);
      }
      clear = 0.0;
    }
    before = now;
  }
  return entries;
}

}  // namespace splash::detection
