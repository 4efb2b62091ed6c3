// SPDX-License-Identifier: MIT
// Water that free bodies entrain. Where a body closes more of a face's area than of the volume
// around it (open_areas.cl), the pressures take what is left of that volume for the body's. Such
// water, of mass m = rho0 V excess at each face along n, goes with the body: its inertia is the
// body's, and its momentum as the step begins and gravity adds to it are
//   E = sum m J J^T,   R = sum m (u + dt g.n) J,   J = (n, r x n / lever)
// with the moments that pressures can have. Without pressures a body that would have the speeds q
// has (M + E)^-1 (M q + R). In still water it weighs what the pressures carry of it: what a body
// displaces is its volume. On the floor, where pressures are those of half a cell higher, m is
// negative, which lends the body the buoyancy that it lacks, but no inertia.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_inertia.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/boundary/six.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/coupling.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"

// Adds a face's part of E and R.
static void add_face(float mass, float speed, const float* way, float* water) {
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c <= r; ++c) water[SIX_AT(r, c)] += fmax(mass, 0.0f) * way[r] * way[c];
    water[SIX_ENTRIES + r] += mass * way[r] * speed;
  }
}

// The water that a body entrains: E as a lower triangle, spins as speeds at the lever [kg], then R
// [N s]. `carries`: u of each face.
static void find_entrained(constant FluidParams* p, constant MacGrid* g, float dt, FreeBody f,
                           BodyShape shape, BodyStep b, global const int* owner,
                           global const float* excess, global const float* carries,
                           float* water) {
  const MacLevel l = g->level[0];
  const float heavy = p->rest_density * g->hx * g->hy * g->hz;
  const float fall[3] = {dt * p->gravity_x, dt * p->gravity_y, dt * p->gravity_z};
  const int step[3] = {1, l.row, l.layer};
  CellBox box = cells_near(g, b);
  box.many += 1;  // with the upper faces of the last cells
  for (int e = 0; e < SPLASH_ENTRAINED_FLOATS; ++e) water[e] = 0.0f;
  for (int item = FIRST_ITEM; item < box.many.x * box.many.y * box.many.z; item += ITEMS) {
    const int c = cell_in(l, box, item);
    const int4 at = (int4)(c % l.layer % l.row, c % l.layer / l.row, c / l.layer, 1) - 1;
    for (int axis = 0; axis < 3; ++axis) {
      const int face = axis * l.cells + c;
      const bool floor = axis == 2 && at.z == 0;
      const int whose = owner[c] >= 0 || floor ? owner[c] : owner[c - step[axis]];
      if (whose != f.body || excess[face] == 0.0f) continue;
      const float3 n = (float3)(axis == 0, axis == 1, axis == 2);
      const float3 arm = face_middle(g, at, axis) - (float3)(b.px, b.py, b.pz);
      const float3 turn = moment_of_pressures(shape, b, cross(arm, n)) / f.size;
      const float way[6] = {n.x, n.y, n.z, turn.x, turn.y, turn.z};
      add_face(heavy * excess[face], carries[face] + fall[axis], way, water);
    }
  }
}

// After let_fall and tie_bodies: finds the water that is `entrained`, SPLASH_ENTRAINED_FLOATS of
// each free body, and gives the bodies the speeds that they would have with it. One work-group.
kernel void entrain_water(constant FluidParams* p, constant MacGrid* g, float dt, int free_count,
                          constant FreeBody* frees, constant BodyShape* shapes,
                          global BodyStep* bodies, int first_body, global const int* owner,
                          global const float* excess, global const float* carries,
                          global float* entrained) {
  local float parts[JUDGES];
  for (int k = 0; k < free_count; ++k) {
    const FreeBody f = frees[k];
    const BodyStep b = bodies[first_body + f.body];
    global float* water = entrained + k * SPLASH_ENTRAINED_FLOATS;
    float mine[SPLASH_ENTRAINED_FLOATS];
    find_entrained(p, g, dt, f, shapes[f.body], b, owner, excess, carries, mine);
    for (int e = 0; e < SPLASH_ENTRAINED_FLOATS; ++e) mine[e] = of_all(mine[e], parts);
    if (FIRST_ITEM > 0) continue;
    for (int e = 0; e < SPLASH_ENTRAINED_FLOATS; ++e) water[e] = mine[e];
    float change[6];
    give_entrained(f, b, water, change);
    add_inertia(f, b, mine);
    if (f.held) hold_six(f.held, change, mine);
    factor_six(mine);
    solve_six(mine, change);
    bodies[first_body + f.body] = faster_by(b, vload3(0, change), vload3(1, change) / f.size);
  }
}
