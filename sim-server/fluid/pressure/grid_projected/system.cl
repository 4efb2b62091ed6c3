// SPDX-License-Identifier: MIT
// The demand that the water's volume stays, as equations for its pressures. With f = dt p / rho0,
// of each cell that holds water, over the six around it,
//   sum_faces (f - f') / h^2 = -div u + contraction                                       [1/s]
// where nothing goes through walls, and f' is 0 at the surface: a hat over a half-space whose
// surface is s cells above its middle is filled by 1/2 + s - s |s| / 2, so the cells' fills say
// where between their middles the surface is, a part t of the way, and the face's term is f / (t
// h^2) (ghost fluid: Gibou et al. 2002). Water that has come apart within is pressed together
// again: its cells contract at the rate REGAINED of what they lack.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

#define REGAINED 1.0f     // [1/s]
#define MOST_LACK 0.2f    // of a cell's fill, that counts [1]

// Velocities on the faces as gravity and viscosity leave them.
kernel void push_faces(constant FluidParams* p, constant MacGrid* g, float dt,
                       global const float* mean, global const float* weight,
                       global float* pushed) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  const float nu = 0.1f * p->viscous;
  const int step[3] = {1, l.row, l.layer};
  const float edge[3] = {g->hx, g->hy, g->hz};
  for (int axis = 0; axis < 3; ++axis) {
    global const float* u = mean + axis * l.cells + c;
    global const float* w = weight + axis * l.cells + c;
    float rub = 0.0f;
    if (nu > 0.0f && *w > MAC_LIGHT) {
      for (int other = 0; other < 3; ++other) {
        const int s = step[other];
        const float up = w[s] > MAC_LIGHT ? u[s] - *u : 0.0f;
        const float down = w[-s] > MAC_LIGHT ? u[-s] - *u : 0.0f;
        rub += (up + down) / (edge[other] * edge[other]);
      }
    }
    pushed[axis * l.cells + c] =
        is_wall(l, at, axis) ? 0.0f : *u + dt * (field_on_face(p, g, at, axis) + nu * rub);
  }
}

// Whether all cells around one, but for those behind walls, hold water.
static bool is_inner(const MacLevel l, global const float* fill, int4 at) {
  for (int z = max(at.z - 1, 0); z <= at.z + 1; ++z) {
    for (int y = max(at.y - 1, 0); y <= min(at.y + 1, l.ny - 1); ++y) {
      for (int x = max(at.x - 1, 0); x <= min(at.x + 1, l.nx - 1); ++x) {
        if (!(fill[number_of(l, (int4)(x, y, z, 0))] > MAC_FULL)) return false;
      }
    }
  }
  return true;
}

static bool holds_water(global const float* fill, int c) { return fill[c] > MAC_FULL; }

// Row by row the system A f = b: `link`, 1 / h^2 between a cell and the one below it along an axis
// where both hold water, by the open part of the face; `open`, what its surface adds to the
// diagonal; `start`: f of the pressures that were. `wet`: 1 where a cell holds water. `most`: the
// largest number of a cell with water. Of a cell beside a solid, what flows out of its open faces
// and what the solid takes of it is its flow relative to the solid, out of the same faces. What the
// solve works with begins at zero.
kernel void lay_system(constant FluidParams* p, constant MacGrid* g, float dt,
                       global const BodyStep* bodies, int first_body, float piston_speed,
                       global const float* gap, global const int* owner,
                       global const float* fill, global const float* pushed,
                       global const float* pressure, int room, global float* link,
                       global float* open, global float* x, global float* right,
                       global float* rest, global float* start, global float* way,
                       global float* wet, global int* most) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  const bool inside = at.x < l.nx && at.y < l.ny && at.z < l.nz;
  const bool fluid = inside && holds_water(fill, c) && is_open(l, gap, c);
  const bool cut = HAS_SOLIDS && fluid && owner[c] != OF_NOBODY;
  const int step[3] = {1, l.row, l.layer};
  const float inverse[3] = {g->ix, g->iy, g->iz};
  const int here[3] = {at.x, at.y, at.z}, count[3] = {l.nx, l.ny, l.nz};
  float b = 0.0f, surface = 0.0f, links = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int below = c - step[axis], above = c + step[axis], face = axis * l.cells + c;
    const float each = inverse[axis] * inverse[axis];
    float between = 0.0f;
    if (fluid) {
      const float low = open_of(gap, face), high = open_of(gap, face + step[axis]);
      const bool closed_above = axis < 2 && here[axis] == count[axis] - 1;
      if (here[axis] > 0) {
        if (holds_water(fill, below)) {
          between = each * low;
        } else {
          surface += each * low / way_to_surface(fill[c], fill[below]);
        }
      }
      if (!closed_above) {
        if (holds_water(fill, above)) {
          links += each * high;
        } else {
          surface += each * high / way_to_surface(fill[c], fill[above]);
        }
      }
      float in = pushed[face], out = pushed[face + step[axis]];
      if (cut) {
        global const BodyStep* now = bodies + first_body;
        const int4 next = at + (int4)(axis == 0, axis == 1, axis == 2, 0);
        in -= solid_at_face(g, now, owner[c], piston_speed, at, axis);
        out -= solid_at_face(g, now, owner[c], piston_speed, next, axis);
      }
      b -= (high * out - low * in) * inverse[axis];
      links += between;
    }
    link[axis * room + c] = between;
  }
  if (fluid && is_inner(l, fill, at)) {
    b -= REGAINED * clamp(1.0f - fill[c], 0.0f, MOST_LACK);
  }
  open[c] = surface;
  right[c] = links + surface > 0.0f ? b : 0.0f;
  x[c] = rest[c] = way[c] = 0.0f;
  start[c] = fluid ? pressure[c] * dt / p->rest_density : 0.0f;
  wet[c] = fluid ? 1.0f : 0.0f;
  if (fluid) atomic_max(most, c);
}
