// SPDX-License-Identifier: MIT
// Where the surface is between the middles of two cells, by how full they are: a hat over a
// half-space whose surface is s cells above its middle is filled by 1/2 + s - s |s| / 2.

#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"

#define LEAST_WAY 0.1f  // to the surface, between two middles [1]

// How far above the middle of cells of this fill the surface is, -1 to 1 [edges].
static lanes surface_above(lanes fill) {
  const lanes none = 0.0f;
  const lanes e = within(fill - MAC_FULL, -0.5f, 0.5f);
  const lanes s = 1.0f - sqrt(fmax(1.0f - 2.0f * fabs(e), none));
  return select(s, -s, e < none);
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
