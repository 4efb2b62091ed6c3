// SPDX-License-Identifier: MIT
// How far an iterative solve has come. It is kept on the device: the host enqueues as many
// iterations as are allowed at most, and those after convergence return at once, so that no
// iteration waits for the host.
#ifndef SPLASH_SOLVE_STATE_H
#define SPLASH_SOLVE_STATE_H

#include "sim-server/device/shared_struct.h"

#ifdef __cplusplus
namespace splash::sim {
#endif

typedef struct {
  int done;
  int iterations;  // of the solve at hand
  float error;     // mean density error that the last judgement found [1]
  int solves;      // these four since counting began
  int total;       // iterations of all solves
  int most;        // of one solve
  int given_up;    // solves that were not done after all iterations allowed
  int unused;
} SolveState;
SPLASH_SHARED_STRUCT(SolveState, 32)

#ifdef __cplusplus
}  // namespace splash::sim
#else
// Whether iteration `k` is to be left out.
static bool is_done(global const SolveState* state, int k) { return k > 0 && state->done != 0; }
#endif

#endif
