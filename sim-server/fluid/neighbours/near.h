// SPDX-License-Identifier: MIT
// The points near a group: those of the nine runs around it that lie within the support of the box
// around its particles. On CPUs they are gathered first, some hundreds at a time, and then visited
// by all lanes together: half of the points in the runs are out of every lane's reach, and to cull
// them out once costs less than to visit them. On GPUs a run is visited as it is.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/params/fluid_params.h"

#if LANES > 1
#define NEAR_ROOM 512
typedef struct {
  int run;    // 0..8: the one being searched
  int place;  // in that run; -1: at its beginning
  int count;
  int index[NEAR_ROOM];
} Near;
#define NEAR(near, k) (near).index[k]
#else
typedef struct {
  int run, place, count;
} Near;
#define NEAR(near, k) ((near).place + (k))
#endif

static void begin_search(Near* near) {
  near->run = 0;
  near->place = -1;
}

#if LANES > 1
// Squared distance from the group's box, along one axis after the other [m2].
static lanes apart(const Group* g, lanes x, lanes y, lanes z) {
  const lanes dx = fmax(LARGER(g->lower.x - x, x - g->upper.x), 0.0f);
  const lanes dy = fmax(LARGER(g->lower.y - y, y - g->upper.y), 0.0f);
  const lanes dz = fmax(LARGER(g->lower.z - z, z - g->upper.z), 0.0f);
  return dx * dx + dy * dy + dz * dz;
}

#if LANES == 8 && defined(__AVX__)
// Numbers of the bits that are set in 0 to 15, from the lowest on.
constant int4 SET_BITS[16] = {(int4)(0, 0, 0, 0), (int4)(0, 0, 0, 0), (int4)(1, 0, 0, 0),
                              (int4)(0, 1, 0, 0), (int4)(2, 0, 0, 0), (int4)(0, 2, 0, 0),
                              (int4)(1, 2, 0, 0), (int4)(0, 1, 2, 0), (int4)(3, 0, 0, 0),
                              (int4)(0, 3, 0, 0), (int4)(1, 3, 0, 0), (int4)(0, 1, 3, 0),
                              (int4)(2, 3, 0, 0), (int4)(0, 2, 3, 0), (int4)(1, 2, 3, 0),
                              (int4)(0, 1, 2, 3)};
#endif

// Appends those of the LANES points from `j` on, and before `end`, that are near.
static int cull(const Group* g, float reach2, global const float* position, int stride, int j,
                int end, int* index, int count) {
  const lanes r2 = apart(g, load_x(position, j, end), LOAD(position + stride, j),
                         LOAD(position + 2 * stride, j));
#if LANES == 16 && defined(__AVX512F__)
  typedef float native __attribute__((__vector_size__(64)));
  typedef int native_int __attribute__((__vector_size__(64)));
  union {
    lanes f;
    native n;
  } distance, reach;
  union {
    lane_flags f;
    native_int n;
  } numbers;
  distance.f = r2;
  reach.f = reach2;
  numbers.f = LANE_NUMBERS + j;
  const unsigned short near =
      __builtin_ia32_cmpps512_mask(distance.n, reach.n, 1, (unsigned short)0xFFFF, 4);
  numbers.n = __builtin_ia32_compresssi512_mask(numbers.n, numbers.n, near);
  vstore16(numbers.f, 0, index + count);
  return count + popcount((uint)near);
#elif LANES == 8 && defined(__AVX__)
  typedef float native __attribute__((__vector_size__(32)));
  union {
    lane_flags f;
    native n;
  } flags;
  flags.f = r2 < (lanes)(reach2);
  const int near = __builtin_ia32_movmskps256(flags.n), low = near & 15, high = near >> 4;
  vstore4(SET_BITS[low] + j, 0, index + count);
  count += popcount(low);
  vstore4(SET_BITS[high] + (j + 4), 0, index + count);
  return count + popcount(high);
#else
  const lane_flags near = r2 < (lanes)(reach2);
  int flag[LANES];
  STORE(near, flag, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    index[count] = j + lane;
    count -= flag[lane];
  }
  return count;
#endif
}
#endif

// Finds the next points near the group; false when there are no more.
static bool search(constant FluidParams* p, const Group* g, global const int* cell_start,
                   global const float* position, int stride, Near* near) {
#if LANES > 1
  const float reach2 = p->support * p->support;
  int count = 0;
  for (; near->run < 9; ++near->run, near->place = -1) {
    const int2 run = neighbour_run(p, cell_start, g->row, g->from, g->to, near->run);
    int j = near->place < 0 ? run.x : near->place;
    for (; j < run.y && count <= NEAR_ROOM - LANES; j += LANES) {
      count = cull(g, reach2, position, stride, j, run.y, near->index, count);
    }
    near->place = j;
    if (j < run.y) break;
  }
  near->count = count;
  return count > 0;
#else
  near->count = 0;
  for (; near->run < 9 && near->count == 0; ++near->run) {
    const int2 run = neighbour_run(p, cell_start, g->row, g->from, g->to, near->run);
    near->place = run.x;
    near->count = run.y - run.x;
  }
  return near->count > 0;
#endif
}
