// SPDX-License-Identifier: MIT
// What solids leave open of faces and cells, and how fast they go there. Solids are bodies, a slope
// and the wave maker's piston; the tank's own walls are where the grid ends.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define HAS_SOLIDS (HAS_BODIES || HAS_SLOPE || HAS_PISTON)

// Whose a cell is: of the body with this number, or of one of these.
#define OF_NOBODY -1
#define OF_SLOPE -2
#define OF_PISTON -3

// What solids leave open of faces, where there are any.
static lanes open_of(global const float* gap, int face) {
  return HAS_SOLIDS ? LOAD(gap, face) : (lanes)(1.0f);
}

// Which cells from `c` on have a face that is open.
static lane_flags are_open(const MacLevel l, global const float* gap, int c) {
  const int step[3] = {1, l.row, l.layer};
  lanes open = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + c;
    open += open_of(gap, face) + open_of(gap, face + step[axis]);
  }
  return open > (lanes)(0.0f);
}

// Middle of the lower face of a cell along an axis.
static float3 face_middle(constant MacGrid* g, int4 at, int axis) {
  const float middle = 0.5f;
  return (float3)(g->x + (at.x + (axis == 0 ? 0.0f : middle)) * g->hx,
                  g->y + (at.y + (axis == 1 ? 0.0f : middle)) * g->hy,
                  g->z + (at.z + (axis == 2 ? 0.0f : middle)) * g->hz);
}

// How fast a body that appears swells, by its size before a step of `dt`: so that it drives away as
// much water in the step as it displaces more after it [1/s]. A seed is too small for the grid to
// see: that it grows more than tenfold in a step is of no account.
static float swelling(BodyStep b, float dt) {
  const float after = 1.0f + fmin(b.grows * dt / size_of(b), 10.0f);
  return (after * after * after - 1.0f) / (3.0f * dt);
}

// Velocity of a solid there in a step of `dt`, along the axis.
static float solid_at_face(constant MacGrid* g, global const BodyStep* bodies, int owner, float dt,
                           float piston_speed, int4 at, int axis) {
  if (owner == OF_PISTON) return axis == 0 ? piston_speed : 0.0f;
  if (owner < 0) return 0.0f;
  const BodyStep b = bodies[owner];
  const float3 arm = face_middle(g, at, axis) - (float3)(b.px, b.py, b.pz);
  const float3 v = (float3)(b.vx, b.vy, b.vz) + cross((float3)(b.wx, b.wy, b.wz), arm) +
                   swelling(b, dt) * arm;
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Speed of solids along an axis at the lower (`upper`: 0) or upper (1) faces of the cells that are
// `marked` [m/s]. The solid is the one that owns the cell or, where none does, the one that owns
// the cell `s` before it; `s` may be 0.
static lanes solids_at_faces(constant MacGrid* g, global const BodyStep* bodies,
                             global const int* owner, float dt, float piston_speed, const Cells* at,
                             lane_flags marked, int axis, int upper, int s) {
  int x[LANES], y[LANES], is_marked[LANES];
  float speed[LANES];
  STORE(at->x, x, 0);
  STORE(at->y, y, 0);
  STORE(marked, is_marked, 0);
  const int4 side = upper * (int4)(axis == 0, axis == 1, axis == 2, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    speed[lane] = 0.0f;
    if (!is_marked[lane]) continue;
    const int c = at->first + lane;
    const int whose = owner[c] != OF_NOBODY ? owner[c] : owner[c - s];
    const int4 face = (int4)(x[lane], y[lane], at->z, 0) + side;
    speed[lane] = solid_at_face(g, bodies, whose, dt, piston_speed, face, axis);
  }
  return LOAD(speed, 0);
}
