// SPDX-License-Identifier: MIT
// Water that goes with free bodies. Where a body closes more of a face's area than of the volume
// around it (open_areas.cl), the pressures take what is left of that volume for the body's. It is
// the body's load, of mass m = rho0 V excess at each such face along n: its inertia, and its
// momentum as the step begins and gravity adds to it, are
//   E = sum m J J^T,   R = sum m (u + dt g.n) J,   J = (n, r x n / lever)
// with the moments that pressures can have. Without pressures a body that would have the speeds q
// has (M + E)^-1 (M q + R). In still water the load weighs what the pressures carry of it: what a
// body displaces is its volume.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_inertia.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/boundary/six.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/coupling.h"
#include "sim-server/fluid/pressure/grid_projected/load.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"

// Adds a face's part of E and R to a load.
static void add_face(float mass, float speed, const float* way, float* load) {
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c <= r; ++c) load[SIX_AT(r, c)] += mass * way[r] * way[c];
    load[SIX_ENTRIES + r] += mass * way[r] * speed;
  }
}

// The load of a body: E as a lower triangle, spins as speeds at the lever [kg], then R [N s].
// `carries`: u of each face.
static void find_load(constant FluidParams* p, constant MacGrid* g, float dt, FreeBody f,
                      BodyShape shape, BodyStep b, global const int* owner,
                      global const float* excess, global const float* carries, float* load) {
  const MacLevel l = g->level[0];
  const float heavy = p->rest_density * g->hx * g->hy * g->hz;
  const float fall[3] = {dt * p->gravity_x, dt * p->gravity_y, dt * p->gravity_z};
  const int step[3] = {1, l.row, l.layer};
  CellBox box = cells_near(g, b);
  box.many += 1;  // with the upper faces of the last cells
  for (int e = 0; e < SPLASH_LOAD_FLOATS; ++e) load[e] = 0.0f;
  for (int item = FIRST_ITEM; item < box.many.x * box.many.y * box.many.z; item += ITEMS) {
    const int c = cell_in(l, box, item);
    const int4 at = (int4)(c % l.layer % l.row, c % l.layer / l.row, c / l.layer, 1) - 1;
    for (int axis = 0; axis < 3; ++axis) {
      const int face = axis * l.cells + c;
      const int whose = owner[c] >= 0 ? owner[c] : owner[c - step[axis]];
      if (whose != f.body || excess[face] == 0.0f) continue;
      const float3 n = (float3)(axis == 0, axis == 1, axis == 2);
      const float3 arm = face_middle(g, at, axis) - (float3)(b.px, b.py, b.pz);
      const float3 turn = moment_of_pressures(shape, b, cross(arm, n)) / f.size;
      const float way[6] = {n.x, n.y, n.z, turn.x, turn.y, turn.z};
      add_face(heavy * excess[face], carries[face] + fall[axis], way, load);
    }
  }
}

// After let_fall and tie_bodies: finds the `loads`, SPLASH_LOAD_FLOATS of each free body, and gives
// the bodies the speeds that they would have with them. One work-group.
kernel void load_bodies(constant FluidParams* p, constant MacGrid* g, float dt, int free_count,
                        constant FreeBody* frees, constant BodyShape* shapes,
                        global BodyStep* bodies, int first_body, global const int* owner,
                        global const float* excess, global const float* carries,
                        global float* loads) {
  local float parts[JUDGES];
  for (int k = 0; k < free_count; ++k) {
    const FreeBody f = frees[k];
    const BodyStep b = bodies[first_body + f.body];
    global float* load = loads + k * SPLASH_LOAD_FLOATS;
    float mine[SPLASH_LOAD_FLOATS];
    find_load(p, g, dt, f, shapes[f.body], b, owner, excess, carries, mine);
    for (int e = 0; e < SPLASH_LOAD_FLOATS; ++e) mine[e] = of_all(mine[e], parts);
    if (FIRST_ITEM > 0) continue;
    for (int e = 0; e < SPLASH_LOAD_FLOATS; ++e) load[e] = mine[e];
    float change[6];
    give_load(f, b, load, change);
    add_inertia(f, b, mine);
    if (f.held) hold_six(f.held, change, mine);
    factor_six(mine);
    solve_six(mine, change);
    bodies[first_body + f.body] = faster_by(b, vload3(0, change), vload3(1, change) / f.size);
  }
}
