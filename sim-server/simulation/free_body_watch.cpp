// SPDX-License-Identifier: MIT
#include "sim-server/simulation/free_body_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

}  // namespace splash::sim
