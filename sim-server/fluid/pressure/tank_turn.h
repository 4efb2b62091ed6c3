// SPDX-License-Identifier: MIT
// What turning with the tank does to the water in a step (tank_turn.cl).
#ifndef SPLASH_TANK_TURN_H
#define SPLASH_TANK_TURN_H

#include "sim-server/device/shared_struct.h"

#ifdef __cplusplus
namespace splash::sim {
#endif

typedef struct {
  float turned[9];   // rotation of velocities, row by row [1]
  float pushed[9];   // of places from the pivot, to speeds [1/s]
  float px, py, pz;  // the pivot [m]
} TankTurn;
SPLASH_SHARED_STRUCT(TankTurn, 21 * 4)

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
