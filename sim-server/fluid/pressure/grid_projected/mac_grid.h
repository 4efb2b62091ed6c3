// SPDX-License-Identifier: MIT
// The grid that carries the water's weight, shared by host and kernels word for word. Pressures are
// in the middles of its cells, velocities on their faces (Harlow & Welch 1965). One layer of cells
// surrounds those of the tank: the lower faces of the upper ones are the tank's last. Only 4-byte
// members.
#ifndef SPLASH_MAC_GRID_H
#define SPLASH_MAC_GRID_H

#include "sim-server/device/shared_struct.h"

#define SPLASH_MAC_LEVELS 12
#define SPLASH_KEPT_FLOATS 16  // of each free body, from step to step (coupling.h)
#define SPLASH_ENTRAINED_FLOATS 27  // of each free body: the water that goes with it (entrained.cl)
#define SPLASH_TUG_FLOATS 16   // of each free body, of its spring in a step (hang.cl)
#define SPLASH_BY_FLOW 6       // the answer to a body's flow, after those to its speeds (felt.cl)

#ifdef __cplusplus
namespace splash::sim {
#endif

// One level of the multigrid; the finest is the grid itself. A cell's number is
// first + (k + 1) layer + (j + 1) row + i + 1.
typedef struct {
  int nx, ny, nz;  // cells inside
  int row, layer;  // from one cell to the next along y and z
  int cells;       // with those around
  int first;       // where it begins in the arrays of all levels
} MacLevel;
SPLASH_SHARED_STRUCT(MacLevel, 7 * 4)

typedef struct {
  float x, y, z;     // lower corner [m]
  float hx, hy, hz;  // edges of a cell [m]
  float ix, iy, iz;  // one over them [1/m]
  float share;       // volume of a particle over that of a cell [1]
  int levels;
  MacLevel level[SPLASH_MAC_LEVELS];
} MacGrid;
SPLASH_SHARED_STRUCT(MacGrid, 11 * 4 + SPLASH_MAC_LEVELS * 7 * 4)

// What the iterative solves of the pressure took. It is kept on the device, so that no iteration
// waits for the host.
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
