// SPDX-License-Identifier: MIT
// Conjugate gradients with multigrid before each direction, by one work-group: no iteration waits
// for the host, none is enqueued that is not needed, and sums have a fixed order.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/pressure/grid_projected/coupling.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/multigrid.h"
#include "sim-server/fluid/pressure/grid_projected/pocket.h"

#define SOLVED 1e-4f  // what may be left of the demand [1]

// The rows of a pocket of air (pocket.h) are one unknown: gives each of its cells the mean of all.
// With one work-item alone: the barriers that many need keep PoCL's compiler for minutes.
static void pool(global const AirPockets* all, global const int* list, global float* field) {
#if TEAM == 1
  for (int k = 0; HAS_POCKETS && k < all->count; ++k) {
    const AirPocket pocket = all->pocket[k];
    float sum = 0.0f;
    for (int i = 0; i < pocket.cells; ++i) sum += field[list[pocket.first + i]];
    for (int i = 0; i < pocket.cells; ++i) field[list[pocket.first + i]] = sum / pocket.cells;
  }
#endif
}

static float product(const MacLevel l, int end, global const float* a, global const float* b,
                     local float* parts) {
  lanes sum = 0.0f;
  EACH_VECTOR(c, l, end) { sum += LOAD(a, c) * LOAD(b, c); }
  return of_all(total(sum), parts);
}

// `anew`: 0 if only the right side has changed since the last solve.
// `found`: where f begins and where it is left. `way`, `along`: the direction and A of it. What is
// left of the demand is the finest level's b. `most`: as lay_system left it. `bodies`: those of
// this step, of which `frees` are free.
kernel void solve_pressure(constant FluidParams* p, constant MacGrid* g, int anew, int iterations,
                           int room, int free_count, constant FreeBody* frees,
                           global BodyStep* bodies, int first_body, global const int* owner,
                           global const float* grip, global const float* entrained,
                           global const int* most, global float* link,
                           global float* open, global float* damped, global float* x,
                           global float* b, global float* r, global float* found, global float* way,
                           global float* along, global const AirPockets* pockets,
                           global const int* list, global SolveState* state) {
  local float parts[JUDGES];
  const Levels s = {{link, link + room, link + 2 * room}, open, damped, x, b, r};
  const MacLevel l = g->level[0];
  const Coupling all = {free_count, frees, bodies + first_body, owner, grip,
                        p->rest_density * g->hx * g->hy * g->hz, entrained};
  const int last = *most;
  const int end = end_of(g, 0, last);
  coarsen(g, &s, anew ? g->levels : 0);
  pool(pockets, list, b);
  const float whole = product(l, end, b, b, parts);
  EACH_VECTOR(c, l, end) {
    STORE(LOAD(b, c) - times(&s, l, found, c), b, c);
  }
  if (HAS_BODIES) add_bodies(g, &all, -1.0f, found, parts, b);
  TOGETHER();
  pool(pockets, list, b);
  const float goal = SOLVED * SOLVED * whole;
  float rest = product(l, end, b, b, parts);
  float before = 1.0f;
  int done = 0;
  for (; done < iterations && rest > goal; ++done) {
    round_trip(g, &s, last);
    pool(pockets, list, x);
    const float now = product(l, end, x, b, parts);
    const float keep = done > 0 ? now / before : 0.0f;
    before = now;
    EACH_VECTOR(c, l, end) {
      const lanes old = done > 0 ? LOAD(way, c) : (lanes)(0.0f);
      STORE(LOAD(x, c) + keep * old, way, c);
    }
    TOGETHER();
    lanes bends = 0.0f;
    EACH_VECTOR(c, l, end) {
      const lanes a = times(&s, l, way, c);
      STORE(a, along, c);
      bends += a * LOAD(way, c);
    }
    float bend = of_all(total(bends), parts);
    if (HAS_BODIES) bend += add_bodies(g, &all, 1.0f, way, parts, along);
    pool(pockets, list, along);
    if (!(bend > 0.0f)) break;
    const float far = now / bend;
    lanes left = 0.0f;
    EACH_VECTOR(c, l, end) {
      STORE(LOAD(found, c) + far * LOAD(way, c), found, c);
      const lanes after = LOAD(b, c) - far * LOAD(along, c);
      STORE(after, b, c);
      left += after * after;
    }
    rest = of_all(total(left), parts);
  }
  if (FIRST_ITEM > 0) return;
  SolveState now = *state;
  ++now.solves;
  now.iterations = done;
  now.total += done;
  now.most = max(now.most, done);
  now.given_up += rest > goal;
  now.error = whole > 0.0f ? sqrt(rest / whole) : 0.0f;
  *state = now;
}
