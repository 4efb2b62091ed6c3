// SPDX-License-Identifier: MIT
#include "sim-server/simulation/free_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// Nothing in water is as fast, and a frame cannot follow it [speeds of sound].
constexpr double kTooFast = 10.0;

bool is_finite(const BodyStep& b) {
  const std::array<float, 13> numbers = {b.px, b.py, b.pz, b.qx, b.qy, b.qz, b.qw,
                                         b.vx, b.vy, b.vz, b.wx, b.wy, b.wz};
  return std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
}

bool is_possible(const BodyStep& b, const FluidParams& params) {
  const HealthLimits box = health_limits(params);
  const bool inside = b.px >= box.lower[0] && b.px <= box.upper[0] && b.py >= box.lower[1] &&
                      b.py <= box.upper[1] && b.pz >= box.lower[2];
  const double fastest = kTooFast * static_cast<double>(params.sound_speed);
  return is_finite(b) && inside && static_cast<double>(b.speed) <= fastest;
}

Anchor anchor_of(const BodyState& s) {
  return {as_float(s.position[0]), as_float(s.position[1]), as_float(s.position[2]),
          as_float(s.rotation[0]), as_float(s.rotation[1]), as_float(s.rotation[2]),
          as_float(s.rotation[3]), as_float(s.velocity[0]), as_float(s.velocity[1]),
          as_float(s.velocity[2]), as_float(s.spin[0]),     as_float(s.spin[1]),
          as_float(s.spin[2])};
}

}  // namespace

std::optional<Diagnosis> look_at_free_bodies(Fluid& fluid, int step) {
  const FreeBodies* free = fluid.free_bodies();
  if (free == nullptr) return std::nullopt;
  const std::vector<FreeBodyEnd> ends = free->ends();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (is_possible(ends[k].step, fluid.params())) continue;
    Diagnosis found{Fault::body, step, 0, -1};
    found.body = free->bodies()[k].body;
    return found;
  }
  return std::nullopt;
}

void bring_free_bodies(Fluid& fluid, Bodies& bodies, double seconds) {
  const FreeBodies* free = fluid.free_bodies();
  if (free == nullptr) return;
  const std::vector<FreeBodyEnd> ends = free->ends();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    bodies.put(static_cast<std::size_t>(free->bodies()[k].body), state_of(ends[k].step),
               {ends[k].force, ends[k].torque}, seconds);
  }
}

HungBodies::HungBodies(const std::vector<BodySettings>& bodies,
                       const std::vector<PosedMotion*>& live) {
  const std::vector<FreeBody> free = free_bodies(bodies);
  free_count_ = free.size();
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto body = static_cast<std::size_t>(free[k].body);
    if (!is_tied(bodies[body])) continue;
    tethers_.push_back({k, free[k], dynamic_cast<const Tether*>(live[body]), bodies[body].centre});
  }
}

std::vector<Anchor> HungBodies::anchors(double seconds, int steps, double dt) const {
  std::vector<Anchor> all(free_count_ * static_cast<std::size_t>(steps));
  for (std::size_t k = 0; k < static_cast<std::size_t>(steps); ++k) {
    for (const Hung& hung : tethers_) {
      all[k * free_count_ + hung.free] =
          anchor_of(hung.tether->at(seconds + static_cast<double>(k) * dt));
    }
  }
  return all;
}

bool HungBodies::move(double seconds, double frame) const {
  return std::any_of(tethers_.begin(), tethers_.end(),
                     [&](const Hung& hung) { return hung.tether->moves(seconds, frame); });
}

std::vector<BodyPush> HungBodies::pushes(const std::vector<FreeBodyEnd>& ends, double seconds,
                                         double frame) const {
  std::vector<BodyPush> all;
  for (const Hung& hung : tethers_) {
    const BodyState device = hung.tether->at(seconds);
    const FreeBodyEnd& end = ends[hung.free];
    const auto damper = static_cast<double>(hung.body.damper);
    const auto turning = static_cast<double>(hung.body.turning_damper);
    const Vector3 arm = rotate(device.rotation, hung.centre);
    const double square = dot(arm, arm);
    all.push_back({.body = hung.body.body,
                   .velocity = device.velocity - cross(device.spin, arm),
                   .spin = device.spin,
                   .force = (-1.0 / frame) * end.tug,
                   .torque = (-1.0 / frame) * (end.twist + cross(arm, end.tug)),
                   .by_speed = {-damper, -damper, -damper},
                   .by_spin = {-turning - damper * (square - arm[0] * arm[0]),
                               -turning - damper * (square - arm[1] * arm[1]),
                               -turning - damper * (square - arm[2] * arm[2])}});
  }
  return all;
}

}  // namespace splash::sim
