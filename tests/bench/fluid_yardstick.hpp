// SPDX-License-Identifier: MIT
// What the two kernels that cost most would take if they were written by hand for this processor:
// the same sums over the same particles in C++ with explicit vectors, on as many threads as the
// OpenCL device has. The figure to quote is the ratio, taken in one run.
#pragma once

#include <vector>

#include "sim-server/fluid/params/fluid_params.h"

namespace splash::bench {

/// Particles in cell order, as the device has them: x, y and z parts `stride` apart, with room to
/// read 16 past the end.
struct Particles {
  sim::FluidParams params = {};
  int stride = 0;
  std::vector<float> position;  ///< [m]
  std::vector<float> velocity;  ///< [m/s]
  std::vector<float> pressure;  ///< p / rho^2
  std::vector<int> cell_start;
};

/// Density by summation [kg/m3], without walls and bodies; `threads` of them at work.
void density_by_hand(const Particles& particles, int threads, std::vector<float>& density);

/// Acceleration by pressure and viscosity [m/s2], without walls, bodies and gravity; laid out like
/// the velocity.
void acceleration_by_hand(const Particles& particles, int threads,
                          std::vector<float>& acceleration);

// The sums for one instruction set each.

/// First particles of the groups that share a list of neighbours.
struct Starts {
  const int* first = nullptr;
  int count = 0;
};

using Sums = void (*)(const Particles& particles, const Starts& starts, int threads, float* sums);

struct YardstickLoops {
  Sums density = nullptr;
  Sums acceleration = nullptr;
  int group = 0;  ///< particles that share a list of neighbours
};

}  // namespace splash::bench
