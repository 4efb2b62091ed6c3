// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/digging.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "program/text.hpp"
#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

/// Solid where normal . x < offset.
struct Side {
  Vector3 normal = {};
  double offset = 0.0;  ///< [m]
  std::string name;
};

std::vector<Side> sides_of(const Scene& scene, bool sole) {
  const Tank& tank = scene.tank;
  std::vector<Side> sides;
  sides.push_back({{0.0, 0.0, 1.0}, sole ? 0.0 : tank.lower[2], "below the floor"});
  if (scene.slope.present && !sole) {
    const double scale = 1.0 / std::hypot(scene.slope.gradient, 1.0);
    sides.push_back({{-scale * scene.slope.gradient, 0.0, scale},
                     scale * (tank.lower[2] - scene.slope.gradient * scene.slope.foot),
                     "below the slope"});
  }
  constexpr std::array<const char*, 2> kAxes = {"x", "y"};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const double place = sign > 0.0 ? tank.lower[axis] : tank.upper[axis];
      Side side;
      side.normal[axis] = sign;
      side.offset = sign * place;
      side.name = std::string("through the wall at ") + kAxes[axis] + " = " +
                  program::format("%g", place) + " m";
      sides.push_back(side);
    }
  }
  return sides;
}

bool is_between_walls(const Tank& tank, const Vector3& x) {
  return x[0] > tank.lower[0] && x[0] < tank.upper[0] && x[1] > tank.lower[1] &&
         x[1] < tank.upper[1];
}

/// The greatest length of a sole's box, in steps of 5 mm, with which it digs hardly deeper than one
/// of half its length, and how deep that is [m].
struct Fit {
  double length = 0.0;
  double depth = 0.0;
};

Fit fitting_length(Scene scene, std::size_t body, const std::filesystem::path& tracker) {
  constexpr double kStep = 0.005;
  constexpr double kHardly = 0.002;
  double& length = scene.bodies[body].shape.size[0];
  const double half = 0.5 * length;
  const int steps = static_cast<int>(std::ceil(length / kStep)) - 1;
  length = half;
  const double least = deepest_digging(scene, body, tracker).depth;
  for (int k = steps; k * kStep > half; --k) {
    length = k * kStep;
    const double depth = deepest_digging(scene, body, tracker).depth;
    if (depth <= least + kHardly) return {length, depth};
  }
  return {half, least};
}

std::string notice(const Scene& scene, std::size_t b, const std::filesystem::path& tracker) {
  const BodySettings& body = scene.bodies[b];
  const Digging digging = deepest_digging(scene, b, tracker);
  const double allowed = particle_spacing(scene);
  if (digging.depth <= allowed) return {};
  std::string text = "'" + body.name + "' goes " + program::format("%.0f", 1e3 * digging.depth) +
                     " mm " + digging.solid + " at " + program::format("%.2f", digging.seconds) +
                     " s";
  const bool is_sole = body.motion.sole && digging.solid == "below the floor";
  if (!is_sole) return text + ", and throws the water about there (a smaller size or another way)";
  text += std::string(", with its ") + (digging.point[0] > 0.0 ? "toe" : "heel") +
          ", and throws the water about: a box " + program::format("%g", body.shape.size[0]) +
          " m long does not fit these markers";
  const Fit fit = fitting_length(scene, b, tracker);
  if (fit.depth > allowed) return text;
  return text + "; one of " + program::format("%g", fit.length) + " m goes " +
         program::format("%.0f", 1e3 * fit.depth) + " mm below it at most (shape.size)";
}

}  // namespace

Digging deepest_digging(const Scene& scene, std::size_t body,
                        const std::filesystem::path& tracker) {
  const BodySettings& settings = scene.bodies[body];
  const std::unique_ptr<Motion> motion = make_motion(settings, tracker);
  const std::vector<Side> sides = sides_of(scene, settings.motion.sole);
  Digging deepest;
  for (const double seconds : motion->moments()) {
    const BodyState state = motion->at(seconds);
    if (!is_between_walls(scene.tank, state.position)) continue;
    for (const Side& side : sides) {
      const Vector3 point =
          outermost(settings.shape, rotate(inverse(state.rotation), -1.0 * side.normal));
      const Vector3 place = state.position + rotate(state.rotation, point);
      const double depth = side.offset - dot(side.normal, place);
      if (depth <= deepest.depth || place[2] > scene.tank.upper[2]) continue;
      deepest = {depth, seconds, side.name, point};
    }
  }
  return deepest;
}

namespace {

/// Whether where such a body goes is known before time begins.
bool is_known_ahead(MotionKind kind) {
  switch (kind) {
    case MotionKind::script:
    case MotionKind::csv:
    case MotionKind::trc:
      return true;
    case MotionKind::fixed:
    case MotionKind::osc:
    case MotionKind::touch:
    case MotionKind::pressure:
    case MotionKind::free:
      break;
  }
  return false;
}

}  // namespace

std::vector<std::string> digging_notices(const Scene& scene, const std::filesystem::path& tracker) {
  std::vector<std::string> notices;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!is_known_ahead(scene.bodies[b].motion.kind)) continue;
    const std::string text = notice(scene, b, tracker);
    if (!text.empty()) notices.push_back(text);
  }
  return notices;
}

}  // namespace splash::sim
