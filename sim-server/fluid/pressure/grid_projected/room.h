// SPDX-License-Identifier: MIT
// What bodies leave open of faces and cells, and how fast they go there.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define LEAST_ROOM 0.05f  // cells with less open volume hold no water [1]

// What bodies leave open of a face or a cell, where there are any.
static float open_of(global const float* part, int c) { return HAS_BODIES ? part[c] : 1.0f; }

// Whether a cell has room for water or air: if not, nothing moves towards it.
static bool has_room(global const float* space, int c) {
  return open_of(space, c) > LEAST_ROOM;
}

// Velocity of a body at the lower face of a cell along an axis, or the one above it, along that.
static float body_at_face(constant MacGrid* g, BodyStep b, int4 at, int axis) {
  const float middle = 0.5f;
  const float3 face = (float3)(g->x + (at.x + (axis == 0 ? 0.0f : middle)) * g->hx,
                               g->y + (at.y + (axis == 1 ? 0.0f : middle)) * g->hy,
                               g->z + (at.z + (axis == 2 ? 0.0f : middle)) * g->hz);
  const float3 v = (float3)(b.vx, b.vy, b.vz) +
                   cross((float3)(b.wx, b.wy, b.wz), face - (float3)(b.px, b.py, b.pz));
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
