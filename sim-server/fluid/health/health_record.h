// SPDX-License-Identifier: MIT
// What the health of a step is judged by, and what is found of it (health.cl, reduce_stats.cl).
#ifndef SPLASH_HEALTH_RECORD_H
#define SPLASH_HEALTH_RECORD_H

#include "sim-server/device/shared_struct.h"

// What is looked for in each particle.
#define SPLASH_HEALTH_NOT_FINITE 0
#define SPLASH_HEALTH_OUTSIDE 1
#define SPLASH_HEALTH_STRAY 2
#define SPLASH_HEALTH_SPEED 3
#define SPLASH_HEALTH_DENSITY 4
#define SPLASH_HEALTH_CHECKS 5

// How groups that rest (sleep/rest.h) are looked at.
#define SPLASH_RESTING_UNSEEN 0  // they are not
#define SPLASH_RESTING_SEEN 1    // they are, and have been before
#define SPLASH_RESTING_ANEW 2    // they are, for the first time

#ifdef __cplusplus
namespace splash::sim {
#endif

typedef struct {
  float lower[3];  // box that holds the water [m]
  float upper[3];
  float speed;     // nothing is this fast or faster [m/s]
  float thinnest;  // density [kg/m3]
  float densest;
} HealthLimits;
SPLASH_SHARED_STRUCT(HealthLimits, 36)

typedef struct {
  int count[SPLASH_HEALTH_CHECKS];  // particles
  int first[SPLASH_HEALTH_CHECKS];  // 2^31 - 1 less the smallest id among them, 0: none
  unsigned int before, after;       // sums of the state's bits at the step's ends
  unsigned int ids_before, ids_after;
} HealthRecord;
SPLASH_SHARED_STRUCT(HealthRecord, 56)

// Health and limits of one part of the fluid (reduce_stats.cl); the host sums them up.
typedef struct {
  float speed2;         // largest [m2/s2]
  float acceleration2;  // largest [m2/s4]
  float excess_sum;     // of max(rho / rho0 - 1, 0)
  float excess_max;
  int not_finite;  // particles with a coordinate, speed or density that is no number
  int first_bad;   // the smallest id of such a particle, 2^31 - 1: none
  int runaway;     // particles at the speed limit
  int asleep;      // particles that did not take part in the last step
  float lower[3];  // box around all particles [m]
  float upper[3];
} FluidStatsPart;
SPLASH_SHARED_STRUCT(FluidStatsPart, 56)

// The bits of a group that rests, when it was last looked at.
typedef struct {
  unsigned int state, ids;
} Rested;
SPLASH_SHARED_STRUCT(Rested, 8)

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
