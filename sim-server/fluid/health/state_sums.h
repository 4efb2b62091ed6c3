// SPDX-License-Identifier: MIT
// Sums of the whole state's bits. A group that rests (rest.h) and whose particles are the same ones
// is looked at in the last step of a frame only. Until then it counts with the bits that it had
// when it was last looked at: what is done to it meanwhile is seen there, for the bits are others.

#include "sim-server/fluid/health/health_record.h"
#include "sim-server/fluid/lanes/lanes.h"

// Numbers as the bits they are made of: sums of those are exact, whatever their order, so a state
// that differs in one bit has another sum, on every run.
#if LANES == 16
typedef uint16 lane_bits;
#define AS_BITS(x) as_uint16(x)
#define ALL_BITS(flags) as_uint16(flags)
#define LOAD_BITS(array, index) as_uint16(vload16(0, (array) + (index)))
#elif LANES == 8
typedef uint8 lane_bits;
#define AS_BITS(x) as_uint8(x)
#define ALL_BITS(flags) as_uint8(flags)
#define LOAD_BITS(array, index) as_uint8(vload8(0, (array) + (index)))
#else
typedef uint lane_bits;
#define AS_BITS(x) as_uint(x)
#define ALL_BITS(flags) ((flags) ? 0xFFFFFFFFu : 0u)
#define LOAD_BITS(array, index) as_uint((array)[index])
#endif

static uint bits_of(lane_bits a) {
  uint part[LANES], sum = 0;
  STORE(a, part, 0);
  for (int lane = 0; lane < LANES; ++lane) sum += part[lane];
  return sum;
}

// Sum of the bits of LANES particles' places and speeds, and of numbers made of their ids.
static lane_bits state_bits(global const float* position, global const float* velocity, int n,
                            int i) {
  lane_bits sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    sum += LOAD_BITS(position + axis * n, i) + 3u * LOAD_BITS(velocity + axis * n, i);
  }
  return sum;
}

static lane_bits id_bits(global const int* id, int i) {
  const lane_bits a = LOAD_BITS(id, i) + 1u;
  return a * a * 2654435761u;  // a lost particle and a doubled one do not make up for each other
}

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
