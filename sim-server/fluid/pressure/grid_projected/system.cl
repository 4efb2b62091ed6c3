// SPDX-License-Identifier: MIT
// The demand that the water's volume stays, as equations for its pressures. With f = dt p / rho0,
// of each cell that holds water, over the six around it,
//   sum_faces (f - f') / h^2 = -div u + contraction                                       [1/s]
// where nothing goes through walls, and f' is 0 at the surface: a hat over a half-space whose
// surface is s cells above its middle is filled by 1/2 + s - s |s| / 2, so the cells' fills say
// where between their middles the surface is, a part t of the way, and the face's term is f / (t
// h^2) (ghost fluid: Gibou et al. 2002). Water that has come apart within is pressed together
// again: its cells contract at the rate REGAINED of what they lack. Air that is shut in has rows of
// its own, with the same terms at its surface (pocket.h).

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"
#include "sim-server/fluid/pressure/grid_projected/sharpen.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

#define REGAINED 1.0f   // [1/s]
#define MOST_LACK 0.2f  // of a cell's fill, that counts [1]

// Velocities on the faces: `carries`, the mean, sharpened, by which particles are carried;
// `pushed`, the same as gravity and viscosity leave it. `most` begins at zero, for lay_system.
kernel void push_faces(constant FluidParams* p, constant MacGrid* g, float dt,
                       global const int* owner, global const float* fill, global const float* mean,
                       global const float* weight, global float* carries, global float* pushed,
                       global int* most) {
  if (get_global_id(0) == 0) *most = 0;
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const float nu = 0.1f * p->viscous;
  const int step[3] = {1, l.row, l.layer};
  const float edge[3] = {g->hx, g->hy, g->hz};
  const lanes none = 0.0f, light = MAC_LIGHT;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + at.first;
    const lanes here = LOAD(mean, face);
    lanes rub = 0.0f;
    for (int other = 0; nu > 0.0f && other < 3; ++other) {
      const int s = step[other];
      const lanes up = LOAD(mean, face + s) - here, down = LOAD(mean, face - s) - here;
      rub += (select(none, up, LOAD(weight, face + s) > light) +
              select(none, down, LOAD(weight, face - s) > light)) /
             (edge[other] * edge[other]);
    }
    rub = select(none, rub, LOAD(weight, face) > light);
    const lanes carry = sharpened(g, &at, owner, fill, weight, 0, mean, axis);
    STORE(carry, carries, face);
    const lanes v = carry + dt * (field_on_faces(p, g, &at, axis) + nu * rub);
    STORE(select(select(none, v, at.real), none, are_walls(l, &at, axis)), pushed, face);
  }
}

// The last lane that is marked, if any is.
static int last_of(lane_flags marked) {
  return (int)most(select((lanes)(-1.0f), CONVERT(LANE_NUMBERS), marked));
}

// The divergence of how solids go in cells that they cut: of a body that appears, which swells
// alike in all directions [1/s].
static lanes swelling_of_solids(global const BodyStep* bodies, global const int* owner, float dt,
                                int c, lane_flags cut) {
  int is_cut[LANES];
  float sum[LANES];
  STORE(cut, is_cut, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    const int whose = is_cut[lane] ? owner[c + lane] : OF_NOBODY;
    sum[lane] = whose < 0 ? 0.0f : 3.0f * swelling(bodies[whose], dt);
  }
  return LOAD(sum, 0);
}

// Row by row the system A f = b: `link`, 1 / h^2 between a cell and the one below it along an axis
// where both hold water, by the open part of the face; `open`, what its surface adds to the
// diagonal; `start`: f of the pressures that were. `wet`: 1 where a cell holds water, `air`: where
// it is shut-in air's, which q = `compliance` makes give way. `most`: the largest number of a cell
// with water. Of a cell beside a solid, what flows out of its open faces and what the solid takes
// of it is its flow relative to the solid, out of the same faces, and the divergence of the solid's
// motion in its open part, `space`. What the solve works with begins at zero.
kernel void lay_system(constant FluidParams* p, constant MacGrid* g, float dt,
                       global const BodyStep* bodies, int first_body, float piston_speed,
                       global const float* gap, global const float* space,
                       global const int* owner, global const float* fill,
                       global const float* pushed, global const float* pressure,
                       global const float* air, global const float* compliance, int room,
                       global float* link, global float* open, global float* x, global float* right,
                       global float* rest, global float* start, global float* way,
                       global float* wet, global int* most) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int c = at.first;
  const lanes none = 0.0f, one = 1.0f;
  const lane_flags water = at.inside & hold_water(fill, c) & are_open(l, gap, c);
  const lane_flags shut_in = are_shut_in(air, c), fluid = water | shut_in;
  const bool any = any_lane(fluid);
  const lane_flags cut = HAS_SOLIDS ? fluid & (LOAD(owner, c) != (lane_flags)(OF_NOBODY)) : fluid;
  const bool any_cut = HAS_SOLIDS && any && any_lane(cut);
  const int step[3] = {1, l.row, l.layer};
  const float inverse[3] = {g->ix, g->iy, g->iz};
  const lane_flags here[3] = {at.x, at.y, at.z};
  const int last[3] = {l.nx - 1, l.ny - 1, l.nz};  // upwards no wall ends it
  const lanes full = LOAD(fill, c);
  lanes b = 0.0f, surface = 0.0f, links = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int s = step[axis], face = axis * l.cells + c;
    lanes between = 0.0f;
    if (any) {
      const float each = inverse[axis] * inverse[axis];
      const lanes low = open_of(gap, face), high = open_of(gap, face + s);
      const lane_flags reaches_down = here[axis] > (lane_flags)(0);
      const lane_flags reaches_up = here[axis] < (lane_flags)(last[axis]);
      const lanes down = select(none, each * low, reaches_down);
      const lanes up = select(none, each * high, reaches_up);
      const lanes full_below = LOAD(fill, c - s), full_above = LOAD(fill, c + s);
      const lane_flags wet_below = hold_water(fill, c - s), wet_above = hold_water(fill, c + s);
      const lanes to_below = down / way_to_surface(full, full_below);
      const lanes to_above = up / way_to_surface(full, full_above);
      between = select(none, down, fluid & wet_below);
      lanes beyond = select(none, up, wet_above);
      surface += select(to_below, none, wet_below) + select(to_above, none, wet_above);
      if (HAS_POCKETS) {
        const lane_flags air_below = are_shut_in(air, c - s), air_above = are_shut_in(air, c + s);
        between = select(between, to_below, water & air_below);
        beyond = select(beyond, to_above, water & air_above);
        surface -= select(none, to_below, air_below) + select(none, to_above, air_above);
        between = select(between, select(down / way_to_surface(full_below, full), down, air_below),
                         shut_in & (wet_below | air_below));
        beyond = select(beyond, select(up / way_to_surface(full_above, full), up, air_above),
                        shut_in & (wet_above | air_above));
      }
      links += between + beyond;
      lanes in = LOAD(pushed, face), out = LOAD(pushed, face + s);
      if (any_cut) {
        in -= solids_at_faces(g, bodies + first_body, owner, dt, piston_speed, &at, cut, axis, 0,
                              0);
        out -= solids_at_faces(g, bodies + first_body, owner, dt, piston_speed, &at, cut, axis, 1,
                               0);
      }
      b -= (high * out - low * in) * inverse[axis];
    }
    STORE(between, link, axis * room + c);
  }
  if (any_cut) {
    b -= LOAD(space, c) * swelling_of_solids(bodies + first_body, owner, dt, c, cut);
  }
  if (any) {
    const lanes lack = REGAINED * within(1.0f - full, 0.0f, MOST_LACK);
    if (any_lane(water & (lack > none))) {
      b -= select(none, lack, water & are_inner(l, fill, &at));
    }
    atomic_max(most, c + last_of(fluid));
  }
  const lanes before = select(none, LOAD(pressure, c) * (dt / p->rest_density), fluid);
  if (HAS_POCKETS && any_lane(shut_in)) {
    surface = select(surface, LOAD(compliance, c), shut_in);
    b += select(none, LOAD(compliance, c) * before, shut_in);
  }
  STORE(select(none, surface, fluid), open, c);
  STORE(select(none, b, fluid & (links + surface > none)), right, c);
  STORE(none, x, c);
  STORE(none, rest, c);
  STORE(none, way, c);
  STORE(before, start, c);
  STORE(select(none, one, water), wet, c);
}
