// SPDX-License-Identifier: MIT
// Cells and faces of the grid, and the hat by which they and the particles see each other: a
// particle counts to the places around it in proportion to how near they are, 1 - |d| / h along
// each axis. The lower face of a cell along an axis has the cell's number. Walls are mirrors: what
// is nearer to one than the middle of the last cell counts to that cell in full.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define MAC_FLUID 1                   // flags of a cell: it holds water
#define MAC_FACE(axis) (2 << (axis))  // the solve found the velocity of its lower face

#define MAC_LIGHT 1e-6f  // faces with less weight than this hold nothing [particles]
#define MAC_FULL 0.5f    // cells that are fuller than this hold water [1]

// What is no number becomes the least: no index leaves the arrays.
static float within(float a, float least, float most) {
  return fmin(fmax(a, least), most);
}

// Where a coordinate is between places that are `h` apart, the first at `from`.
typedef struct {
  int lower, upper;  // the places beside it, from 0
  float share;       // of the upper one
} Between;

// On the faces along an axis, of which the last is number `n`.
static Between between_faces(float x, float from, float h, int n) {
  const float at = (x - from) / h;
  const float lower = within(floor(at), 0.0f, n - 1);
  const Between b = {(int)lower, (int)lower + 1, within(at - lower, 0.0f, 1.0f)};
  return b;
}

// On the middles of `n` cells between walls.
static Between between_middles(float x, float from, float h, int n) {
  const float at = within((x - from) / h - 0.5f, 0.0f, n - 1);
  const float lower = within(floor(at), 0.0f, max(n - 2, 0));
  const Between b = {(int)lower, min((int)lower + 1, n - 1), at - lower};
  return b;
}

// A particle among the places of the three faces, and of the middles.
typedef struct {
  Between face[3], middle[3];
  bool on_grid;  // not above it
} Placed;

static Placed place_on_grid(constant MacGrid* g, float x, float y, float z) {
  const MacLevel l = g->level[0];
  Placed at;
  at.face[0] = between_faces(x, g->x, g->hx, l.nx);
  at.face[1] = between_faces(y, g->y, g->hy, l.ny);
  at.face[2] = between_faces(z, g->z, g->hz, l.nz);
  at.middle[0] = between_middles(x, g->x, g->hx, l.nx);
  at.middle[1] = between_middles(y, g->y, g->hy, l.ny);
  at.middle[2] = between_middles(z, g->z, g->hz, l.nz);
  at.on_grid = z < g->z + g->hz * ((float)l.nz - 0.5f);
  return at;
}

// The eight places around a particle for the faces along `axis`, or for the middles (3).
typedef struct {
  int cell[8];
  float weight[8];
} Around;

static Around around(constant MacGrid* g, const Placed* at, int axis) {
  const MacLevel l = g->level[0];
  const Between bx = axis == 0 ? at->face[0] : at->middle[0];
  const Between by = axis == 1 ? at->face[1] : at->middle[1];
  const Between bz = axis == 2 ? at->face[2] : at->middle[2];
  Around a;
  for (int k = 0; k < 8; ++k) {
    const bool ux = k & 1, uy = k & 2, uz = k & 4;
    a.cell[k] = ((uz ? bz.upper : bz.lower) + 1) * l.layer +
                ((uy ? by.upper : by.lower) + 1) * l.row + (ux ? bx.upper : bx.lower) + 1;
    a.weight[k] = (ux ? bx.share : 1.0f - bx.share) * (uy ? by.share : 1.0f - by.share) *
                  (uz ? bz.share : 1.0f - bz.share);
  }
  return a;
}

// Cell number `item` of those inside and, along each axis, the one above them; the last: whether
// there is one.
static int4 cell_of(constant MacGrid* g, int item) {
  const MacLevel l = g->level[0];
  const int across = l.nx + 1, along = l.ny + 1;
  const int layer = item / (across * along);
  return (int4)(item % across, item / across % along, layer, layer <= l.nz);
}

static int number_of(const MacLevel l, int4 at) {
  return (at.z + 1) * l.layer + (at.y + 1) * l.row + at.x + 1;
}

// Acceleration from afar along an axis, at a face.
static float field_on_face(constant FluidParams* p, constant MacGrid* g, int4 at, int axis) {
  if (axis == 0) return p->gravity_x - p->pull_x * (g->x + at.x * g->hx - p->centre_x);
  if (axis == 1) return p->gravity_y - p->pull_y * (g->y + at.y * g->hy - p->centre_y);
  return p->gravity_z - p->pull_z * (g->z + at.z * g->hz - p->centre_z);
}

// Whether the lower face of a cell along an axis is a wall. Upwards there is none.
static bool is_wall(const MacLevel l, int4 at, int axis) {
  if (axis == 0) return at.x == 0 || at.x == l.nx;
  if (axis == 1) return at.y == 0 || at.y == l.ny;
  return at.z == 0;
}
