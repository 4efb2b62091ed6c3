// SPDX-License-Identifier: MIT
// One step of a frame, and how long it may be: the sound, the fastest thing, the strongest push and
// the viscosity each set a limit.
#pragma once

#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {

/// One step of a frame.
struct Step {
  double dt = 0.0;            ///< [s]
  double piston = 0.0;        ///< offset of the wave maker [m]
  double piston_speed = 0.0;  ///< [m/s]
  int first_body = 0;         ///< where this step's bodies begin among those of the frame
  bool opens_frame = false;   ///< first of a frame: what wakes and what sleeps is looked at anew
};

/// Largest step that is used [s]. Of the weakly compressible solver:
///   acoustic  dt <= C H / (c0 + v)        C of the smoothing kernel, below where still water
///                                          grows rough (smoothing.cpp)
///   force     dt <= 0.25 sqrt(h / a)      Monaghan 1992
///   viscous   dt <= 0.125 h^2 / nu        Morris et al. 1997; 0.13 at most, whatever the factor
/// Of the grid-projected solver:
///   advective dt <= dx / v; 1.05 times that at most, whatever the factor: where a dam break meets
///             a wall, at 1.25 all is well, and at 1.5 particles end in one place in the tank's
///             edges
///   viscous   as above, of the water's own alone
///   longest   10 ms, so that nothing sudden is slept through
/// with h the smoothing length, dx the spacing, `speed` the fastest particle or body point [m/s],
/// `acceleration` the largest [m/s2] and `factor` that of StepPolicy (1: as above).
[[nodiscard]] double largest_time_step(const FluidParams& params, double speed, double acceleration,
                                       double factor);
/// No scene and no load make a step longer than this: the default step of water at rest times
/// StepPolicy::kLargestFactor [s].
[[nodiscard]] double longest_possible_step(const FluidParams& params);

/// A frame's worth of equal steps.
struct FrameSteps {
  int count = 1;
  double dt = 0.0;  ///< [s]
};

/// As many steps of at most `largest` as come nearest to `frame` seconds: the frame stretches
/// rather than the step, so no step is shorter than it must.
[[nodiscard]] FrameSteps steps_of_frame(double frame, double largest);

}  // namespace splash::sim
