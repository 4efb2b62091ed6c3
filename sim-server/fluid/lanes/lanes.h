// SPDX-License-Identifier: MIT
// A vector of particles: LANES of them are handled at once by one work-item. On CPUs this is what
// makes SPH fast (explicit vectors; the compiler finds none by itself); on GPUs LANES is 1 and the
// same source is plain scalar code.

#include "sim-server/fluid/lanes/far_away.h"

#define FAR_AWAY SPLASH_FAR_AWAY

// The smaller and the larger of two: one instruction each, where fmin and fmax take four to pass
// over what is no number. If one is none, b.
#define SMALLER(a, b) ((a) < (b) ? (a) : (b))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))

#if LANES == 16
typedef float16 lanes;
typedef int16 lane_flags;  // of each lane: 0, or all bits set
#define LOAD(array, index) vload16(0, (array) + (index))
#define STORE(value, array, index) vstore16(value, 0, (array) + (index))
#define LANE_NUMBERS ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
static float first_lane(lanes a) { return a.s0; }
static float total(lanes a) {
  const float8 b = a.lo + a.hi;
  const float4 c = b.lo + b.hi;
  const float2 d = c.lo + c.hi;
  return d.x + d.y;
}
static float least(lanes a) {
  const float8 b = SMALLER(a.lo, a.hi);
  const float4 c = SMALLER(b.lo, b.hi);
  const float2 d = SMALLER(c.lo, c.hi);
  return SMALLER(d.x, d.y);
}
#elif LANES == 8
typedef float8 lanes;
typedef int8 lane_flags;
#define LOAD(array, index) vload8(0, (array) + (index))
#define STORE(value, array, index) vstore8(value, 0, (array) + (index))
#define LANE_NUMBERS ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
static float first_lane(lanes a) { return a.s0; }
static float total(lanes a) {
  const float4 c = a.lo + a.hi;
  const float2 d = c.lo + c.hi;
  return d.x + d.y;
}
static float least(lanes a) {
  const float4 c = SMALLER(a.lo, a.hi);
  const float2 d = SMALLER(c.lo, c.hi);
  return SMALLER(d.x, d.y);
}
#elif LANES == 1
typedef float lanes;
typedef int lane_flags;
#define LOAD(array, index) (array)[index]
#define STORE(value, array, index) (array)[index] = (value)
#define LANE_NUMBERS 0
static float first_lane(lanes a) { return a; }
static float total(lanes a) { return a; }
static float least(lanes a) { return a; }
#else
#error "LANES must be 1, 8 or 16"
#endif

static float most(lanes a) { return -least(-a); }

static bool any_lane(lane_flags flags) {
  return least(select((lanes)(0.0f), (lanes)(-1.0f), flags)) < 0.0f;
}

// LOAD of x coordinates of a run that ends before `end`: lanes past it are sent far away, for the
// arrays go on there with particles of other runs, which may be neighbours in their own right.
static lanes load_x(global const float* array, int index, int end) {
#if LANES > 1
  return select((lanes)(FAR_AWAY), LOAD(array, index), LANE_NUMBERS < (lane_flags)(end - index));
#else
  return LOAD(array, index);
#endif
}

// Squares of the lengths of the vectors from `index` on, whose x, y and z parts are `stride` apart.
static lanes squares_at(global const float* array, int stride, int index) {
  const lanes x = LOAD(array, index), y = LOAD(array + stride, index);
  const lanes z = LOAD(array + 2 * stride, index);
  return x * x + y * y + z * z;
}

// 1 / sqrt(a). AVX-512 has an estimate good to 2^-14; one Newton step brings it to float accuracy
// at a third of the cost of a square root and a division.
static lanes inverse_root(lanes a) {
#if LANES == 16 && defined(__AVX512F__)
  typedef float native __attribute__((__vector_size__(64)));
  union { lanes f; native n; } in, out;
  in.f = a;
  out.n = __builtin_ia32_rsqrt14ps512_mask(in.n, in.n, (unsigned short)0xFFFF);
  return out.f * (1.5f - 0.5f * a * out.f * out.f);
#else
  return native_rsqrt(a);
#endif
}

// 1 / a for a > 0, likewise.
static lanes inverse(lanes a) {
#if LANES == 16 && defined(__AVX512F__)
  typedef float native __attribute__((__vector_size__(64)));
  union { lanes f; native n; } in, out;
  in.f = a;
  out.n = __builtin_ia32_rcp14ps512_mask(in.n, in.n, (unsigned short)0xFFFF);
  return out.f * (2.0f - a * out.f);
#else
  return native_recip(a);
#endif
}
