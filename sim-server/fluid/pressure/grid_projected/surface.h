// SPDX-License-Identifier: MIT
// Where the surface is between the middles of two cells, by how full they are: a hat over a
// half-space whose surface is s cells above its middle is filled by 1/2 + s - s |s| / 2.

#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"

#define LEAST_WAY 0.1f    // to the surface, between two middles [1]
#define NEARLY_FULL 0.9f  // cells so full are full, as far as uneven particles let them say [1]
#define SURELY_NOT 0.8f   // cells less full have the surface in them [1]

// How far above the middle of cells of this fill the surface is, -1 to 1 [edges].
static lanes surface_above(lanes fill) {
  const lanes none = 0.0f;
  const lanes e = within(fill - MAC_FULL, -0.5f, 0.5f);
  const lanes s = 1.0f - sqrt(fmax(1.0f - 2.0f * fabs(e), none));
  return select(s, -s, e < none);
}

// The fill of cells whose middle is so far under the surface [edges].
static lanes fill_under(lanes surface) {
  const lanes s = within(surface, -1.0f, 1.0f);
  return MAC_FULL + s - 0.5f * s * fabs(s);
}

// How full the next cells are by how full those before them are, `near`, and those before these,
// `far`: where the surface comes nearer to the middles it goes on to do so, by up to an edge. Those
// that are nearly full say nothing of a surface.
static lanes fill_beyond(lanes near, lanes far) {
  const lanes none = 0.0f, one = 1.0f;
  const lanes s = surface_above(near);
  const lanes next = fill_under(s - fmin(2.0f * fmax(surface_above(far) - s, none), one));
  const lanes sure = within((NEARLY_FULL - near) / (NEARLY_FULL - SURELY_NOT), 0.0f, 1.0f);
  return near + sure * (next - near);
}

// Part of the way from the middles of cells with water to those of ones without where the surface
// is.
static lanes way_to_surface(lanes water, lanes air) {
  const lanes under = surface_above(water), over = -surface_above(air);
  return within(under / fmax(under + over, (lanes)(1e-3f)), LEAST_WAY, 1.0f);
}

// The same of one pair of cells.
static float way_to_surface_of(float water, float air) {
  return most(way_to_surface((lanes)(water), (lanes)(air)));
}

// Which cells from `c` on are shut-in air's.
static lane_flags are_shut_in(global const float* air, int c) {
  const lane_flags nowhere = 0;
  return HAS_POCKETS ? LOAD(air, c) > (lanes)(0.0f) : nowhere;
}

// How fast f grows across the lower faces of cells, `s` from those below [edges]. f of open air is
// 0, whatever the solve left there.
static lanes growth(global const float* fill, global const float* wet, global const float* air,
                    global const float* found, int c, int s) {
  const lanes none = 0.0f;
  const lane_flags here = LOAD(wet, c) > none, there = LOAD(wet, c - s) > none;
  const lanes f = select(none, LOAD(found, c), here | are_shut_in(air, c));
  const lanes below = select(none, LOAD(found, c - s), there | are_shut_in(air, c - s));
  const lanes full = LOAD(fill, c), full_below = LOAD(fill, c - s);
  const lanes rise = (f - below) / way_to_surface(full, full_below);
  const lanes fall = (f - below) / way_to_surface(full_below, full);
  return select(select(fall, rise, here), f - below, here & there);
}

// Which cells from `c` on hold water.
static lane_flags hold_water(global const float* fill, int c) {
  return LOAD(fill, c) > (lanes)(MAC_FULL);
}

// The least value of `field` in each cell and the cells around it, without those outside the tank;
// 1 at most.
static lanes least_around(const MacLevel l, global const float* field, const Cells* at) {
  const lane_flags none = 0;
  lanes lowest = 1.0f;
  for (int z = max(-1, -at->z); z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const lane_flags i = at->x + x, j = at->y + y;
        const lane_flags behind =
            (i < none) | (i >= (lane_flags)(l.nx)) | (j < none) | (j >= (lane_flags)(l.ny));
        const lanes there = LOAD(field, at->first + z * l.layer + y * l.row + x);
        lowest = fmin(lowest, select(there, (lanes)(1.0f), behind));
      }
    }
  }
  return lowest;
}

// Whether each cell and all cells around it, except those outside the tank, hold water.
static lane_flags are_inner(const MacLevel l, global const float* fill, const Cells* at) {
  return least_around(l, fill, at) > (lanes)(MAC_FULL);
}
