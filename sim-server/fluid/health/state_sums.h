// SPDX-License-Identifier: MIT
// Sums of the whole state's bits. A group that rests (rest.h) and whose particles are the same ones
// is looked at in the last step of a frame only. Until then it counts with the bits that it had
// when it was last looked at: what is done to it meanwhile is seen there, for the bits are others.

#include "sim-server/fluid/health/health_record.h"
#include "sim-server/fluid/lanes/bits.h"

// The particles at one end of a step.
typedef struct {
  global const float* position;
  global const float* velocity;
  global const int* id;
} Particles;

// Sums of bits at the step's ends; `known`: of what is not looked at, which is the same at both,
// and `ids_known`: of what was looked at before.
typedef struct {
  lane_bits before, after, ids_before, ids_after;
  Rested known;
  uint ids_known;
} Sums;

// Adds the group of particle `i`, of whose lanes `mine` hold one.
static void add_bits(Sums* sums, int n, int i, lane_bits mine, int rests, int look,
                     const Particles* now, const Particles* was, global Rested* rested) {
  const lane_bits state = mine & state_bits(now->position, now->velocity, n, i);
  const lane_bits ids = mine & id_bits(now->id, i);
  sums->before += mine & state_bits(was->position, was->velocity, n, i);
  sums->after += state;
  sums->ids_after += ids;
  if (rests > 1 && look == SPLASH_RESTING_SEEN) {
    sums->ids_known += rested->ids;
  } else {
    sums->ids_before += mine & id_bits(was->id, i);
  }
  if (rests == 0) return;
  rested->state = bits_of(state);
  rested->ids = bits_of(ids);
}
