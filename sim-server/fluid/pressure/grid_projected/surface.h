// SPDX-License-Identifier: MIT
// Where the surface is between the middles of two cells, by how full they are: a hat over a
// half-space whose surface is s cells above its middle is filled by 1/2 + s - s |s| / 2.

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
