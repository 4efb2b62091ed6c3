// SPDX-License-Identifier: MIT
#include "tests/detection/truth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim-server/bodies/skin.hpp"
#include "sim-server/detect/added_mass.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::detection {
namespace {

using namespace sim;  // operators of vectors among it

/// Heights are looked at so often [s], and bisected so often between.
constexpr double kStep = 0.001;
constexpr int kBisections = 40;

/// The underside of a rocker is looked at in so many places along a part.
constexpr int kPlaces = 17;

/// Around the speed below which a body is silent either is right [1].
constexpr double kSurelySlow = 0.9;
constexpr double kSurelyFast = 1.15;

/// Of a foot: its skin is looked at in places so far apart [m]; what goes in within this of each
/// other is one roll [s]; skin that faces the water by less than this cosine passes along it; and
/// around the least momentum and area that make an impact either is right [1].
constexpr double kSkin = 0.005;
constexpr double kRoll = 0.03;
constexpr double kFacing = 0.5;
constexpr double kSurely = 3.0;

/// Places in body axes of which one is the lowest, however the body is turned [m].
std::vector<Vector3> corners_of(const Shape& shape, const Part& part) {
  if (shape.kind == ShapeKind::mesh) {
    std::vector<Vector3> all;
    const double length = shape.mesh->upper[0] - shape.mesh->lower[0];
    for (const Vector3& vertex : shape.mesh->surface.vertices) {
      const double share = (vertex[0] - shape.mesh->lower[0]) / length;
      if (share >= part.from && share <= part.to) all.push_back(vertex);
    }
    return all;
  }
  std::vector<Vector3> all;
  const Vector3 half = {0.5 * shape.size[0], 0.5 * shape.size[1], 0.5 * shape.size[2]};
  const int places = shape.rocker > 0.0 ? kPlaces : 2;
  for (int k = 0; k < places; ++k) {
    const double share = part.from + (part.to - part.from) * k / (places - 1);
    const double x = (share - 0.5) * shape.size[0];
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
  Underside(const Shape& shape, const Part& part) : shape_(shape) {
    if (shape.kind == ShapeKind::box || shape.kind == ShapeKind::mesh) {
      corners_ = corners_of(shape, part);
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

/// A place on the skin below the level, and how far it is behind where it has been: so deep may the
/// hollow be that it leaves behind itself.
class Below {
 public:
  /// Whether it has just come there.
  bool go(bool below, double step) {
    if (!below) deepest_ = way_ = 0.0;
    const bool crosses = !std::exchange(below_, below) && below;
    way_ += below ? step : 0.0;
    deepest_ = std::max(deepest_, way_);
    return crosses;
  }
  [[nodiscard]] double back() const { return deepest_ - way_; }

 private:
  bool below_ = false;
  double way_ = 0.0;      ///< along its normal [m]
  double deepest_ = 0.0;  ///< the largest of it [m]
};

/// What goes in with pauses of up to kRoll is one roll.
class Rolls {
 public:
  Rolls(std::size_t body, double face, const Limits& limits)
      : body_(body),
        area_(limits.face * face),
        momentum_(limits.momentum * added_mass(face, 1.0)) {}

  void go_on(double time) {
    if (rolls_.empty() || time - rolls_.back().entry.until > kRoll) {
      rolls_.push_back({{body_, time, time, 0.0, 0.0, false}, {}, 0.0, 0.0});
    }
    rolls_.back().entry.until = time;
  }
  /// `speed`: at which that skin presses on the water, `down`: at which it sinks [m/s].
  void add(double time, const Wetting& skin, double speed, double down) {
    go_on(time);
    Roll& roll = rolls_.back();
    const double mass = roll.patch.mass();
    roll.patch.add(skin);
    const double more = std::max(roll.patch.mass() - mass, 0.0);
    roll.momentum += speed * more;
    roll.sinking += down * more;
    // Of its beginning: that is what an impact tells.
    if (time - roll.entry.time <= kRoll) roll.entry.down = roll.sinking / roll.patch.mass();
  }
  /// Those that are surely impacts as wanted; those that surely are none are left out, unless
  /// nothing is known of their momentum.
  [[nodiscard]] std::vector<Entry> all() const {
    std::vector<Entry> all;
    for (const Roll& roll : rolls_) {
      Entry entry = roll.entry;
      const double mass = roll.patch.mass();
      if (mass > 0.0 && roll.momentum < momentum_ / kSurely) continue;
      entry.wanted = mass > 0.0 && roll.momentum >= kSurely * momentum_ &&
                     roll.patch.area() >= kSurely * area_;
      all.push_back(entry);
    }
    return all;
  }

 private:
  struct Roll {
    Entry entry;
    Patch patch;
    double momentum = 0.0;  ///< [N s]
    double sinking = 0.0;   ///< sum of its speeds down, each times its added mass [kg m/s]
  };
  std::size_t body_;
  double area_;      ///< least of an impact [m2]
  double momentum_;  ///< least of an impact [N s]
  std::vector<Roll> rolls_;
};

}  // namespace

Vector3 lowest_point(const Shape& shape, const Part& part, const sim::BodyState& state) {
  return Underside(shape, part).at(state);
}

std::vector<Entry> entries_of(std::size_t body, const Shape& shape, const Part& part,
                              const Path& path, double level, double end, const Limits& limits) {
  const Underside underside(shape, part);
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

std::vector<Entry> steps_of(std::size_t body, const Shape& shape, const Path& path, double level,
                            double end, const Limits& limits) {
  const std::vector<SkinPoint> skin = sample_skin(shape, 0, kSkin);
  const double face = faces_of(skin, 1).front();
  std::vector<Below> places(skin.size());
  Rolls through(body, face, limits);
  Rolls hollow(body, face, limits);
  const auto count = static_cast<int>(std::ceil(end / kStep));
  for (int k = 0; k <= count; ++k) {
    const double time = k * kStep;
    const BodyState state = path(time);
    double in_hollow = 0.0;
    for (std::size_t i = 0; i < skin.size(); ++i) {
      const Vector3 arm = rotate(state.rotation, skin[i].place);
      const Vector3 normal = rotate(state.rotation, skin[i].normal);
      const double pressing = dot(state.velocity + cross(state.spin, arm), normal);
      const bool crosses = places[i].go(state.position[2] + arm[2] <= level, kStep * pressing);
      const double facing = -normal[2];
      const double speed = pressing / facing;
      if (facing <= kFacing || speed < limits.impact_speed) continue;
      const double down = -(state.velocity + cross(state.spin, arm))[2];
      if (crosses && k > 0) through.add(time, {0.0, facing * skin[i].area, 1.0, arm}, speed, down);
      if (places[i].back() >= limits.clear) in_hollow += facing * skin[i].area;
    }
    if (in_hollow >= limits.face * face) hollow.go_on(time);
  }
  std::vector<Entry> steps = through.all();
  const std::vector<Entry> others = hollow.all();
  steps.insert(steps.end(), others.begin(), others.end());
  return steps;
}

}  // namespace splash::detection
