// SPDX-License-Identifier: MIT
// How far an iterative solve has come, as the device keeps it.
#pragma once

namespace splash::sim {

/// Host and kernels agree on the layout (pressure/divergence_free/solve_state.h).
struct SolveState {
  int done = 0;
  int iterations = 0;
  float error = 0.0F;
  int solves = 0;
  int total = 0;
  int most = 0;
  int given_up = 0;
  int unused = 0;
};

}  // namespace splash::sim
