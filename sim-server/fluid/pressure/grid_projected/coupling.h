// SPDX-License-Identifier: MIT
// Free bodies as six more unknowns each of the pressures' system. With q a body's speeds, spins as
// speeds at its lever, what cell c's demand has of them is K_c q, and its pressure gives the body
//   dq = - M^-1 sum_c rho0 V K_c^T f_c,      K_c = sum_faces open (e, r x e / lever) / h
// over the faces of the cell, outwards. So what is solved is, for bodies that fall as if there were
// no water,
//   (L + sum_bodies K rho0 V M^-1 K^T) f = b
// symmetric and positive, like L alone, however light the body (Batty, Bertails & Bridson 2007).
// M has the inertia of the water that the body entrains (entrained.cl) in it.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_inertia.h"
#include "sim-server/fluid/boundary/six.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/multigrid.h"

// What a step keeps of each body for the next: the speeds and spins that the water left it with,
// whether there are some, and by how much of what stopped it the step began.
#define KEPT_SPEED 0
#define KEPT_SPIN 3
#define KEPT_ANY 6
#define KEPT_HELD 8
#define KEPT_TURNED 11

typedef struct {
  int count;
  constant FreeBody* frees;
  global BodyStep* bodies;  // of this step
  global const int* owner;
  global const float* grip;   // K of each cell, `cells` apart
  float heavy;                // rho0 V [kg]
  global const float* entrained;  // water that goes with each body (entrained.cl)
} Coupling;

// Cells that a body may be near: the lowest, and how many along each axis.
typedef struct {
  int4 low, many;
} CellBox;

static CellBox cells_near(constant MacGrid* g, BodyStep b) {
  const MacLevel l = g->level[0];
  const int4 last = (int4)(l.nx - 1, l.ny - 1, l.nz - 1, 0);
  const float4 from = (float4)((b.lower_x - g->x) * g->ix, (b.lower_y - g->y) * g->iy,
                               (b.lower_z - g->z) * g->iz, 0.0f);
  const float4 to = (float4)((b.upper_x - g->x) * g->ix, (b.upper_y - g->y) * g->iy,
                             (b.upper_z - g->z) * g->iz, 0.0f);
  CellBox box;
  box.low = clamp(convert_int4_sat(floor(from)), (int4)(0), last);
  box.many = clamp(convert_int4_sat(floor(to)), (int4)(0), last) - box.low + 1;
  return box;
}

static int cell_in(const MacLevel l, CellBox box, int k) {
  const int x = k % box.many.x, y = k / box.many.x % box.many.y, z = k / (box.many.x * box.many.y);
  return number_of(l, box.low + (int4)(x, y, z, 0));
}

// Sum over all items, for each of them.
static float of_all(float mine, local float* parts) {
#if TEAM > 1
  TOGETHER();
  parts[get_local_id(0)] = mine;
  TOGETHER();
  float sum = 0.0f;
  for (int item = 0; item < ITEMS; ++item) sum += parts[item];
  return sum;
#else
  return mine;
#endif
}

// K^T f of body `k`.
static void find_push(constant MacGrid* g, const Coupling* all, int k, global const float* f,
                      local float* parts, float* push) {
  const MacLevel l = g->level[0];
  const int body = all->frees[k].body;
  const CellBox box = cells_near(g, all->bodies[body]);
  for (int e = 0; e < 6; ++e) push[e] = 0.0f;
  for (int item = FIRST_ITEM; item < box.many.x * box.many.y * box.many.z; item += ITEMS) {
    const int c = cell_in(l, box, item);
    if (all->owner[c] != body) continue;
    for (int e = 0; e < 6; ++e) push[e] += all->grip[e * l.cells + c] * f[c];
  }
  for (int e = 0; e < 6; ++e) push[e] = of_all(push[e], parts);
}

// What it changes of the body's speeds: rho0 V M^-1 push, but nothing where the body is held.
static void answer_push(const Coupling* all, int k, const float* push, float* answer) {
  const FreeBody f = all->frees[k];
  float m[SIX_ENTRIES];
  for (int e = 0; e < SIX_ENTRIES; ++e) m[e] = all->entrained[k * SPLASH_ENTRAINED_FLOATS + e];
  add_inertia(f, all->bodies[f.body], m);
  for (int e = 0; e < 6; ++e) answer[e] = all->heavy * push[e];
  if (f.held) hold_six(f.held, answer, m);
  factor_six(m);
  solve_six(m, answer);
}

// field += part K answer
static void add_answer(constant MacGrid* g, const Coupling* all, int k, float part,
                       const float* answer, global float* field) {
  const MacLevel l = g->level[0];
  const int body = all->frees[k].body;
  const CellBox box = cells_near(g, all->bodies[body]);
  for (int item = FIRST_ITEM; item < box.many.x * box.many.y * box.many.z; item += ITEMS) {
    const int c = cell_in(l, box, item);
    if (all->owner[c] != body) continue;
    float sum = 0.0f;
    for (int e = 0; e < 6; ++e) sum += all->grip[e * l.cells + c] * answer[e];
    field[c] += part * sum;
  }
}

// What all bodies add to `part` L f in `field`, and to the product of f and L f.
static float add_bodies(constant MacGrid* g, const Coupling* all, float part,
                        global const float* f, local float* parts, global float* field) {
  float bends = 0.0f;
  for (int k = 0; k < all->count; ++k) {
    float push[6], answer[6];
    TOGETHER();
    find_push(g, all, k, f, parts, push);
    answer_push(all, k, push, answer);
    for (int e = 0; e < 6; ++e) bends += push[e] * answer[e];
    add_answer(g, all, k, part, answer, field);
  }
  TOGETHER();
  return bends;
}

// What the water that a body entrains (entrained.cl) loses when it goes as the body does, R - E q.
static void give_entrained(FreeBody f, BodyStep b, global const float* water, float* given) {
  const float q[6] = {b.vx, b.vy, b.vz, f.size * b.wx, f.size * b.wy, f.size * b.wz};
  float inertia[SIX_ENTRIES];
  for (int e = 0; e < SIX_ENTRIES; ++e) inertia[e] = water[e];
  for (int e = 0; e < 6; ++e) given[e] = water[SIX_ENTRIES + e] - row_of_six(inertia, e, q);
}
