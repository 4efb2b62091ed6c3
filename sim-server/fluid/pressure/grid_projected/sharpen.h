// SPDX-License-Identifier: MIT
// The hat smooths what it takes from particles to faces and from faces to particles: of a field
// with wave number k along an axis each way takes (k h)^2 / 12. Differences to the six faces around
// give back both, to the second order (approximate deconvolution, Stolz & Adams 1999):
//   f + sum min(1, W' / W) (f - f') / 6
// over those that are in the water, with the weights W of the particles around them; W' is W where
// a solid cuts f', and f' is 0 at walls. What is uniform stays so. Between two faces the sum keeps
// momentum, and its matrix is symmetric by W: pressures whose pushes are sharpened do no work on a
// velocity that is, sharpened, free of divergence.

#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"

// For the faces between cells c and c - s: whether both cells hold water.
static lane_flags are_in_water(global const float* fill, int c, int s) {
  const lanes full = MAC_FULL;
  return (LOAD(fill, c) > full) & (LOAD(fill, c - s) > full);
}

// For the same faces: whether a solid may cut either cell.
static lane_flags are_cut(global const int* owner, int c, int s) {
  const lane_flags unowned = OF_NOBODY, none = 0;
  if (!HAS_SOLIDS) return none;
  return (LOAD(owner, c) != unowned) | (LOAD(owner, c - s) != unowned);
}

// A field on the lower faces of cells along an axis, sharpened; as it is out of the water and where
// it is unknown. Where faces have different numbers in `parts`, if that is not 0, they exchange
// nothing, so that each part keeps its momentum.
static lanes sharpened(constant MacGrid* g, const Cells* at, global const int* owner,
                       global const float* fill, global const float* weight,
                       global const float* parts, global const float* field, int axis) {
  const MacLevel l = g->level[0];
  const int step[3] = {1, l.row, l.layer};
  const int face = axis * l.cells + at->first;
  const lanes none = 0.0f, one = 1.0f, known = MAC_KNOWN, here = LOAD(field, face);
  const lane_flags inner = at->real & !are_walls(l, at, axis) & (here < known) &
                           are_in_water(fill, at->first, step[axis]) &
                           !are_cut(owner, at->first, step[axis]);
  if (!any_lane(inner)) return here;
  const lanes own = fmax(LOAD(weight, face), (lanes)(MAC_LIGHT));
  lanes sum = 0.0f;
  for (int along = 0; along < 3; ++along) {
    for (int side = -1; side < 2; side += 2) {
      const int s = side * step[along];
      Cells next = *at;
      if (along == 0) next.x += side;
      if (along == 1) next.y += side;
      if (along == 2) next.z += side;
      const lane_flags wall = are_walls(l, &next, axis);
      const lanes there = select(LOAD(field, face + s), none, wall);
      const lane_flags cut = are_cut(owner, at->first + s, step[axis]);
      const lane_flags links = are_in_water(fill, at->first + s, step[axis]);
      const lanes part = fmin(LOAD(weight, face + s) / own, one);
      lane_flags counts = links & (there < known);
      if (parts != 0) counts &= cut | (LOAD(parts, face + s) == LOAD(parts, face));
      sum += select(none, select(part, one, wall | cut) * (here - there), wall | counts);
    }
  }
  return here + select(none, sum * (1.0f / 6.0f), inner);
}
