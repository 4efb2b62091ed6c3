// SPDX-License-Identifier: MIT
// The rows of a scene file that say what the water is and how its motion is solved.
#include "sim-server/scene/scene_table.hpp"
#include "sim-server/scene/step_policy.hpp"

namespace splash::sim {

namespace {

using F = FluidEntry;

/// What the water is made of, and how its motion is solved.
Fields<F> method_fields() {
  return {
      {{.key = "spacing",
        .unit = "m",
        .meaning = "Particle spacing at rest. Give this or `particles`, not both.",
        .min = 0.001,
        .max = 0.2},
       &F::spacing},
      {{.key = "particles",
        .unit = "1",
        .meaning = "Wanted number of particles; the spacing follows from the water's volume.",
        .min = 100,
        .max = 4'000'000},
       &F::particles},
      {{.key = "density",
        .unit = "kg/m3",
        .meaning = "Density at rest.",
        .min = 100,
        .max = 5000,
        .source = "fresh water at 21 C"},
       &F::density},
      {{.key = "solver",
        .unit = "",
        .meaning = "Where pressure comes from: weakly_compressible, a state equation; "
                   "grid_projected, the demand that nothing compresses, made of a grid, so that "
                   "waves and vortices last "
                   "(sim-server/fluid/pressure/grid_projected/README). auto: grid_projected, but "
                   "weakly_compressible where a body may strike the water, or water falls or flows "
                   "off (sim-server/fluid/README, \"Which solver\"); the program says which and "
                   "why.",
        .choices = {"weakly_compressible", "grid_projected", "auto"},
        .source = "Monaghan 2005; Raveendran, Wojtan & Turk 2011"},
       &F::solver_name},
      {{.key = "kernels",
        .unit = "",
        .meaning = "vector: as suits the device; reference: one particle at a time, as GPUs do it, "
                   "slow on a CPU, for comparison.",
        .choices = {"vector", "reference"}},
       &F::kernels_name},
      {{.key = "settle",
        .unit = "",
        .meaning = "What comes to rest before time begins. auto: water that stands level in the "
                   "tank, on bodies or behind the gate; what nothing holds, as a drop in the air, "
                   "begins where and as this file says. always: all water, which then has flowed "
                   "off or fallen when time begins. never: none, so that a pool simmers at first.",
        .choices = {"auto", "always", "never"}},
       &F::settle_name},
  };
}

/// What moves it and what holds it back.
Fields<F> force_fields() {
  return {
      {{.key = "sound_speed",
        .unit = "m/s",
        .meaning =
            "Speed of sound of the weakly compressible model, and scale of the artificial "
            "viscosity; left out: from the depth, the pull, and the speeds of the piston and of "
            "bodies whose motion or fall is known beforehand. For one that a tracker moves faster "
            "than 0.3 times sound, "
            "which is 13 m/s or more, give it. Four times the speed of the longest wave is the "
            "least.",
        .min = 1,
        .max = 1500,
        .source = "Monaghan 1994: ten times the largest speed keeps density within 1 %"},
       &F::sound_speed},
      {{.key = "viscosity",
        .unit = "m2/s",
        .meaning = "Kinematic viscosity; the default is that of water at 20 degrees.",
        .min = 0,
        .max = 1,
        .source = "Kestin, Sokolov & Wakeham 1978"},
       &F::viscosity},
      {{.key = "artificial",
        .unit = "1",
        .meaning = "Monaghan's artificial viscosity alpha: about alpha c0 h / 20 between particles "
                   "that approach each other, h the spacing.",
        .min = 0,
        .max = 2,
        .source = "Monaghan 1992"},
       &F::artificial},
      {{.key = "time_step_factor",
        .unit = "1",
        .meaning = "Multiplies the default time step; smaller is slower and steadier. With "
                   "weakly_compressible what is beyond 1.05 makes sound slower, and water more "
                   "compressible by the square (sim-server/fluid/README has a table); not where "
                   "`sound_speed` is given. With grid_projected what is fast goes no farther in a "
                   "step than by default.",
        .min = StepPolicy::kLeastFactor,
        .max = StepPolicy::kLargestFactor},
       &F::time_step_factor},
      {{.key = "gravity",
        .unit = "m/s2",
        .meaning = "Acceleration of gravity, x y z.",
        .min = -100,
        .max = 100,
        .source = "standard gravity"},
       &F::gravity},
      {{.key = "pull",
        .unit = "1/s",
        .meaning =
            "Central field: draws to `pull_centre` as a spring does, with this rate along "
            "x y z; the acceleration is -pull^2 times the way from the centre. Too strong is "
            "what gives water a speed for which sound has to be faster than 1500 m/s.",
        .min = 0,
        .max = 100,
        .source = "Monaghan & Rafiee 2013"},
       &F::pull},
      {{.key = "pull_centre", .unit = "m", .meaning = "Where `pull` draws to, x y z."},
       &F::pull_centre},
  };
}

Fields<F> joined(Fields<F> first, const Fields<F>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

const Fields<FluidEntry>& fluid_fields() {
  static const Fields<F> kFields = joined(method_fields(), force_fields());
  return kFields;
}

}  // namespace splash::sim
