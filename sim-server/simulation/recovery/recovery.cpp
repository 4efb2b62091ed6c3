// SPDX-License-Identifier: MIT
#include "sim-server/simulation/recovery/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kLeastShare = 1.0 / 8.0;  ///< three times halved
constexpr double kGrowth = 1.1;            ///< per sound frame: doubled after 8 of them

std::string cure(const StepFault& step_fault) {
  std::ostringstream text;
  text << std::setprecision(2);
  const std::string tries = std::to_string(step_fault.tries);
  switch (step_fault.remedy) {
    case Remedy::retry:
      text << "computed again with shorter steps, the frame was sound"
           << (step_fault.tries > 1 ? " at try " + std::to_string(step_fault.tries + 1) : "");
      break;
    case Remedy::calm:
      if (std::isfinite(step_fault.calmed)) {
        text << tries << " tries failed: the water within " << step_fault.calmed
             << " m of that place was stopped, and nothing of the frame is told";
      } else {
        text << tries << " tries failed: all water was stopped, and nothing of the frame is told";
      }
      break;
    case Remedy::reset:
      text << "stopping the water did not help: the scene begins anew";
      break;
  }
  return text.str();
}

}  // namespace

Remedy Recovery::failed() noexcept {
  share_ = std::max(share_ / 2.0, kLeastShare);
  if (failed_ < kTries) {
    ++failed_;
    return Remedy::retry;
  }
  failed_ = 0;
  ++given_up_;
  if (given_up_ < kFramesGivenUp) return Remedy::calm;
  given_up_ = 0;
  return Remedy::reset;
}

void Recovery::succeeded() noexcept {
  failed_ = 0;
  given_up_ = 0;
  share_ = std::min(share_ * kGrowth, 1.0);
}

std::string describe_fault(const StepFault& step_fault) {
  const Diagnosis& what = step_fault.what;
  std::ostringstream text;
  if (what.particle < 0) {
    text << describe(what.fault);
    if (what.body >= 0) text << ": '" << step_fault.body << "'";
    return text.str();
  }
  const Vector3& x = step_fault.place;
  text << std::fixed << std::setprecision(3) << "particle " << what.particle << ", last well at ("
       << x[0] << ", " << x[1] << ", " << x[2] << ") m";
  if (!step_fault.body.empty()) {
    text << std::setprecision(2) << " and " << step_fault.distance << " m from the centre of body '"
         << step_fault.body << "'";
  }
  text << ", " << describe(what.fault);
  if (what.particles > 1) text << " (" << what.particles << " particles in all)";
  return text.str();
}

std::string describe(const StepFault& step_fault) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "at " << step_fault.seconds << " s, in step "
       << step_fault.step << ", " << describe_fault(step_fault) << "; " << cure(step_fault)
       << ". Likely cause: " << likely_cause(step_fault.what.fault);
  return text.str();
}

namespace {

/// Water is stopped this far around a fault, and twice as far when that did not help [supports].
constexpr double kCalmed = 4.0;

/// Share of the particles that is no longer a matter of single ones [1].
constexpr double kMany = 0.01;

/// Of the particle `id`; the origin if there is none of that name.
Vector3 place_of(const Snapshot& state, int id) {
  const auto found = std::find(state.id.begin(), state.id.end(), id);
  if (found == state.id.end()) return {};
  return state.place(static_cast<std::size_t>(found - state.id.begin()));
}

}  // namespace

void locate(StepFault& step_fault, Fluid& fluid, const Bodies& bodies, const Scene& scene,
            double sound_at) {
  const Diagnosis& what = step_fault.what;
  if (what.particle < 0 && what.body < 0) return;
  step_fault.place = what.body >= 0
                         ? bodies.state(static_cast<std::size_t>(what.body), sound_at).position
                         : place_of(fluid.snapshot(), what.particle);
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
    if (length(state.place(i) - step_fault.place) > step_fault.calmed) continue;
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
