// SPDX-License-Identifier: MIT
#include "sim-server/scene/step_policy.hpp"

#include <algorithm>

namespace splash::sim {

double StepPolicy::stable_factor(PressureKind solver) noexcept {
  // Measured by the trials and maps of tests/stress: the state equation's water is calm to 1.15
  // and no longer at 1.2 around a sunken ball. On a grid still and slow water takes 2
  // (fluid/time_step.hpp).
  return solver == PressureKind::weakly_compressible ? 1.05 : kLargestFactor;
}

double StepPolicy::sound_factor(const FluidSettings& fluid) noexcept {
  if (fluid.solver != PressureKind::weakly_compressible) return 1.0;
  return std::min(stable_factor(fluid.solver) / fluid.time_step_factor, 1.0);
}

StepPolicy::StepPolicy(const FluidSettings& fluid) noexcept
    : factor_((fluid.sound_speed > 0.0 ? 1.0 : sound_factor(fluid)) * fluid.time_step_factor),
      largest_stretch_(std::clamp(stable_factor(fluid.solver) / fluid.time_step_factor, 1.0,
                                  stable_factor(fluid.solver))),
      scene_may_ask_(fluid.solver == PressureKind::weakly_compressible &&
                     fluid.sound_speed <= 0.0 && fluid.time_step_factor < kLargestFactor) {}

void StepPolicy::set_stretch(double stretch) noexcept {
  stretch_ = std::clamp(stretch, 1.0, largest_stretch_);
}

}  // namespace splash::sim
