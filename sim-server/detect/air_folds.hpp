// SPDX-License-Identifier: MIT
// Where water folds air in, and how much: a share of the energy that it loses at its surface
// becomes work on air (air_fold.cl),
//   dV/dt = eta rho eps / (rho g z) dV_water,   eps = (k - k0)^(3/2) / L,
// over water in whose surroundings air has the share a and lies beside water, 4 a (1 - a): 1 at a
// flat surface. L and z are bubble_eddy, eta bubble_energy, and k0 = 3/2 bubble_onset^2 is what
// isotropic eddies of that speed have.
#pragma once

#include <vector>

#include "sim-server/detect/bubble_state.h"
#include "sim-server/detect/counted_list.hpp"
#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

class AirFolds {
 public:
  AirFolds(Fluid& fluid, const cl::Program& program);

  /// Between prepare and advance of a frame's last step. `phase`: which of SPLASH_FOLDS_APART
  /// particles are looked at, from 0 on.
  void enqueue(const Step& step, const DetectSettings& settings, int phase);
  /// After a frame's last kernel.
  void enqueue_read() {
    if (looks_) folds_.enqueue_read(fluid_.device());
  }
  /// Instead of both, where nothing is fast.
  void skip() noexcept {
    looks_ = false;
    folds_.skip();
  }
  /// What was found, once the queue is finished, in the order of the particles' ids.
  [[nodiscard]] std::vector<AirFold> read() { return folds_.read(fluid_.device()); }

 private:
  Fluid& fluid_;
  CountedList<AirFold> folds_;
  bool looks_ = false;
  Buffer<float> fastest_;  ///< square of the highest speed in each cell [m2/s2]
  Kernel find_fastest_;
  Kernel fold_air_;
};

/// The eddies' width in water of that spacing: bubble_eddy, or as wide as two particles can show
/// [m].
[[nodiscard]] double eddy_width(const DetectSettings& settings, double spacing);

/// Against which air is lifted [m/s2].
[[nodiscard]] double gravity_of(const FluidParams& params);
/// Work that lifts a volume of air from where eddies take it [J/m3].
[[nodiscard]] double lift_of(const DetectSettings& settings, const FluidParams& params);

}  // namespace splash::sim
