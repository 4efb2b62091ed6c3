// SPDX-License-Identifier: MIT
#include "sim-server/simulation/recovery/rescue.hpp"

#include <algorithm>
#include <limits>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// Water is stopped this far around a fault, and twice as far when that did not help [supports].
constexpr double kCalmed = 4.0;

/// Share of the particles that is no longer a matter of single ones [1].
constexpr double kMany = 0.01;

Vector3 place_at(const Snapshot& state, std::size_t i, const FluidParams& params) {
  const auto stride = static_cast<std::size_t>(params.capacity);
  return {static_cast<double>(state.position[i]), static_cast<double>(state.position[stride + i]),
          static_cast<double>(state.position[2 * stride + i])};
}

/// Of the particle `id`; the origin if there is none of that name.
Vector3 place_of(const Snapshot& state, int id, const FluidParams& params) {
  const auto found = std::find(state.id.begin(), state.id.end(), id);
  if (found == state.id.end()) return {};
  return place_at(state, static_cast<std::size_t>(found - state.id.begin()), params);
}

}  // namespace

void locate(StepFault& step_fault, Fluid& fluid, const Bodies& bodies, const Scene& scene,
            double sound_at) {
  const Diagnosis& what = step_fault.what;
  if (what.particle < 0 && what.body < 0) return;
  step_fault.place = what.body >= 0
                         ? bodies.state(static_cast<std::size_t>(what.body), sound_at).position
                         : place_of(fluid.snapshot(), what.particle, fluid.params());
  const int body = what.body >= 0 ? what.body : bodies.nearest(step_fault.place, sound_at);
  if (body < 0) return;
  const auto b = static_cast<std::size_t>(body);
  step_fault.body = scene.bodies[b].name;
  step_fault.distance = length(step_fault.place - bodies.state(b, step_fault.seconds).position);
}

void calm(StepFault& step_fault, Fluid& fluid, Bodies& bodies, int times, double sound_at) {
  const FluidParams& p = fluid.params();
  const bool many = step_fault.what.particles == 0 || step_fault.what.particles > kMany * p.count;
  step_fault.calmed = many ? std::numeric_limits<double>::infinity()
                           : kCalmed * times * static_cast<double>(p.support);
  Snapshot state = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(p.capacity);
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    if (length(place_at(state, i, p) - step_fault.place) > step_fault.calmed) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) state.velocity[axis * stride + i] = 0.0F;
  }
  fluid.restore(state);
  for (std::size_t b = 0; b < bodies.count(); ++b) {
    const bool near =
        length(bodies.state(b, sound_at).position - step_fault.place) <= step_fault.calmed;
    if (bodies.is_free(b) && near) bodies.zero_velocities(b);
  }
}

}  // namespace splash::sim
