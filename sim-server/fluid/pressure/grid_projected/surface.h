// SPDX-License-Identifier: MIT
// Where the surface is between the middles of two cells, by how full they are: a hat over a
// half-space whose surface is s cells above its middle is filled by 1/2 + s - s |s| / 2.

#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"

#define LEAST_WAY 0.1f  // to the surface, between two middles [1]

// How far above the middle of a cell of this fill the surface is, -1 to 1 [edges].
static float surface_above(float fill) {
  const float e = clamp(fill - MAC_FULL, -0.5f, 0.5f);
  const float s = 1.0f - sqrt(fmax(1.0f - 2.0f * fabs(e), 0.0f));
  return e < 0.0f ? -s : s;
}

// Part of the way from the middle of a cell with water to that of one without where the surface is.
static float way_to_surface(float water, float air) {
  const float under = surface_above(water), over = -surface_above(air);
  return clamp(under / fmax(under + over, 1e-3f), LEAST_WAY, 1.0f);
}
