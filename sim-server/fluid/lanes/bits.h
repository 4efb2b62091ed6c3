// SPDX-License-Identifier: MIT
// Numbers as the bits they are made of, and sums of those: sums of integers are exact, whatever
// their order, so a state that differs in one bit has another sum, on every run.

#include "sim-server/fluid/lanes/lanes.h"

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
