// SPDX-License-Identifier: MIT
// What the iterative solves of the pressure took. It is kept on the device, so that no iteration
// waits for the host.
#ifndef SPLASH_SOLVE_STATE_H
#define SPLASH_SOLVE_STATE_H

#include "sim-server/device/shared_struct.h"

#ifdef __cplusplus
namespace splash::sim {
#endif

typedef struct {
  int iterations;  // of the last solve
  float error;     // what it left of the demand [1]
  int solves;      // these four since counting began
  int total;       // iterations of all solves
  int most;        // of one solve
  int given_up;    // solves that were not done after all iterations allowed
} SolveState;
SPLASH_SHARED_STRUCT(SolveState, 24)

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
