// SPDX-License-Identifier: MIT
// Air that is shut in, as one more unknown of the pressures' system for each pocket: its cells
// share one pressure, that of gas whose amount stays,
//   dP = - gamma (p0 + P) dV / V,
// P over the atmosphere's p0, V its volume. That follows what flows in, step by step; and at the
// rate SPLASH_POCKET_RETURN it comes back to p0 ((V0 / V)^gamma - 1), V0 being the amount of its
// air, as V is known by the particles only roughly, but without drift. With f = dt P / rho0 and
// what flows into it in a step that is
//   q f + sum_faces open (f - f') / (t h^2) = q f_before - div u,
//   q = rho0 V / (n Vc gamma (p0 + P) dt^2)                                                 [1/m2]
// of each of its n cells of the volume Vc, added up over them; t: part of the way to the water's
// middle (system.cl). Its cells are rows like those of water, with q on the diagonal, and `pool`
// makes one of them.
#ifndef SPLASH_POCKET_H
#define SPLASH_POCKET_H

#include "sim-server/device/shared_struct.h"

#define SPLASH_MOST_POCKETS 16
#define SPLASH_LEAST_POCKET 8      // cells: as wide as two
#define SPLASH_POCKET_RETURN 1.0f  // rate at which its pressure returns to that of its volume [1/s]

#ifdef __cplusplus
namespace splash::sim {
#endif

typedef struct {
  int first, cells;  // of the list of pockets' cells
  float volume;      // of its air [m3]
  float amount;      // the volume that it would have at the atmosphere's pressure [m3]
  float pressure;    // over the atmosphere's, as the step begins [Pa]
} AirPocket;
SPLASH_SHARED_STRUCT(AirPocket, 20)

typedef struct {
  int count;
  AirPocket pocket[SPLASH_MOST_POCKETS];
} AirPockets;
SPLASH_SHARED_STRUCT(AirPockets, 4 + 20 * SPLASH_MOST_POCKETS)

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
