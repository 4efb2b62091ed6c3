// SPDX-License-Identifier: MIT
#include "sim-server/scene/solver_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/support_state.hpp"

namespace splash::sim {
namespace {

/// The part of buoyancy's impulse that a slap may have [1].
constexpr double kSlapShare = 0.1;
/// A cubic between two keyframes is at most so much faster than its mean, begun and ended at rest
/// [1].
constexpr double kCubicPeak = 1.5;

std::string number(double value) {
  std::array<char, 32> text = {};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

/// Height of the water's surface over or under a place; where there is no water, that of the
/// highest block [m].
double level_at(const Scene& scene, const Vector3& place) {
  double there = scene.tank.lower[2];
  double highest = there;
  bool is_over = false;
  for (const WaterBlock& block : scene.water) {
    highest = std::max(highest, block.upper[2]);
    if (place[0] < block.lower[0] || place[0] > block.upper[0] || place[1] < block.lower[1] ||
        place[1] > block.upper[1]) {
      continue;
    }
    is_over = true;
    there = std::max(there, block.upper[2]);
  }
  return is_over ? there : highest;
}

/// How far a body's surface reaches from its origin along `direction`, a unit vector [m].
double reach(const Shape& shape, const Quaternion& rotation, const Vector3& direction) {
  return dot(direction, rotate(rotation, outermost(shape, rotate(inverse(rotation), direction))));
}

double width(const Shape& shape, const Quaternion& rotation, const Vector3& direction) {
  return reach(shape, rotation, direction) + reach(shape, rotation, -1.0 * direction);
}

/// How deep a body's lowest point is under water [m].
double depth(const Scene& scene, const Shape& shape, const Keyframe& pose) {
  return level_at(scene, pose.position) - pose.position[2] +
         reach(shape, pose.rotation, {0.0, 0.0, -1.0});
}

double scripted_entry(const Scene& scene, const BodySettings& body) {
  const std::vector<Keyframe>& frames = body.motion.keyframes;
  const double peak = body.motion.smooth ? kCubicPeak : 1.0;
  double fastest = 0.0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const double before = depth(scene, body.shape, frames[k - 1]);
    const double after = depth(scene, body.shape, frames[k]);
    if (before > 0.0 || after <= 0.0) continue;
    fastest = std::max(fastest, peak * (after - before) / (frames[k].time - frames[k - 1].time));
  }
  return fastest;
}

/// The body's density over the water's [1].
double relative_density(const Scene& scene, const BodySettings& body) {
  const double own =
      body.motion.density > 0.0 ? body.motion.density : body.motion.mass / volume_of(body.shape);
  return own / scene.fluid.density;
}

/// From the body's energy: what displaces water of volume V whose middle is z deep can get rho g V
/// z from it. A body that is partly in the water counts as one of vertical sides.
double free_entry(const Scene& scene, const BodySettings& body) {
  const double g = -scene.fluid.gravity[2];
  const double deep = depth(scene, body.shape, body.rest);
  const double high = width(body.shape, body.rest.rotation, {0.0, 0.0, 1.0});
  const double speed = length(body.motion.velocity);
  double energy = 0.5 * speed * speed - g * deep;  // when its lowest point meets the surface [J/kg]
  if (deep > 0.0) {
    const double middle = deep < high ? deep * deep / (2.0 * high) : deep - 0.5 * high;
    energy += g * middle / relative_density(scene, body);
  }
  return std::sqrt(2.0 * std::max(energy, 0.0));
}

double smaller_width(const BodySettings& body) {
  const Quaternion& rotation = body.rest.rotation;
  return std::min(width(body.shape, rotation, {1.0, 0.0, 0.0}),
                  width(body.shape, rotation, {0.0, 1.0, 0.0}));
}

/// Why the body needs the state equation; empty: it does not.
std::string reason_of(const Scene& scene, const BodySettings& body) {
  const std::string name = "'" + body.name + "' ";
  switch (body.motion.kind) {
    case MotionKind::osc:
    case MotionKind::touch:
    case MotionKind::pressure:
      return name + "is moved by a tracker and may strike the water at any speed";
    case MotionKind::csv:
    case MotionKind::trc:
      return name + "moves as recorded and may strike the water at any speed";
    case MotionKind::fixed:
      return {};
    case MotionKind::script:
    case MotionKind::free:
      break;
  }
  const double most = slap_speed(0.5 * smaller_width(body), length(scene.fluid.gravity));
  const double entry = entry_speed(scene, body);
  if (body.motion.kind == MotionKind::script && entry > 0.0) {
    return name + "enters the water at " + number(entry) + " m/s";
  }
  if (entry > most) {
    return name + "may strike the water at " + number(entry) + " m/s, and slaps from " +
           number(most) + " m/s on";
  }
  return {};
}

/// Why the scene needs the state equation whatever strikes its water; empty: it does not.
std::string unsuited(const Scene& scene) {
  const FluidSettings& fluid = scene.fluid;
  if (fluid.sound_speed > 0.0) return "the scene says how fast sound is";
  if (fluid.artificial != FluidSettings{}.artificial) {
    return "the scene says how large artificial viscosity is";
  }
  if (length(fluid.pull) > 0.0) {
    return "water that a central field holds swings on too long with grid_projected";
  }
  return {};
}

/// What may strike the water or what the water may strike; empty: nothing.
std::string strike(const Scene& scene) {
  if (scene.gate.present) return "the gate lets water go that strikes what it meets";
  if (scene.flow.kind == FlowKind::uniform) return "the flow strikes what it meets";
  for (const BodySettings& body : scene.bodies) {
    std::string reason = reason_of(scene, body);
    if (!reason.empty()) return reason;
  }
  return is_all_supported(scene) ? ""
                                 : "nothing holds some of the water, and it strikes what it meets";
}

}  // namespace

std::string name_of(PressureKind solver) {
  switch (solver) {
    case PressureKind::weakly_compressible:
      return "weakly_compressible";
    case PressureKind::grid_projected:
      break;
  }
  return "grid_projected";
}

double slap_speed(double radius, double gravity) {
  return std::sqrt(kSlapShare * 3.0 * std::numbers::pi / 8.0 * gravity * radius);
}

double entry_speed(const Scene& scene, const BodySettings& body) {
  switch (body.motion.kind) {
    case MotionKind::script:
      return scripted_entry(scene, body);
    case MotionKind::free:
      return free_entry(scene, body);
    case MotionKind::osc:
    case MotionKind::touch:
    case MotionKind::pressure:
    case MotionKind::csv:
    case MotionKind::trc:
    case MotionKind::fixed:
      break;
  }
  return 0.0;
}

SolverChoice suitable_solver(const Scene& scene) {
  if (scene.fluid.air_pockets) {
    return {PressureKind::grid_projected, "the scene has air_pockets"};
  }
  std::string reason = unsuited(scene);
  if (reason.empty()) reason = strike(scene);
  if (reason.empty()) return {PressureKind::grid_projected, "nothing strikes the water"};
  return {PressureKind::weakly_compressible, reason};
}

std::string solver_notice(const Scene& scene) {
  const SolverChoice choice = suitable_solver(scene);
  const std::string name = name_of(scene.fluid.solver);
  if (choice.solver == scene.fluid.solver) return name + ": " + choice.reason;
  if (scene.fluid.solver != PressureKind::grid_projected) return name + ", as the scene says";
  const std::string slaps = unsuited(scene).empty() ? ": slaps may be too soft" : "";
  return name + ", as the scene says, but " + choice.reason + slaps + ", and " +
         name_of(choice.solver) + " is what solver: auto would take";
}

}  // namespace splash::sim
