// SPDX-License-Identifier: MIT
// The points around one place, LANES of them after LANES: those of the nine runs of cells that its
// support may reach into (grid.h).
//   for (Around a = around(p, x, y, z); next_around(p, &points, &a);) { ... a.dx ... }

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"

// Points sorted by cells.
typedef struct {
  global const int* start;       // the first point of each cell
  global const float* position;  // [m]
  int stride;                    // between its x, y and z parts
} Cloud;

typedef struct {
  float x, y, z;     // the place [m]
  int row, slice;    // that it is in
  int run;           // the one to visit after this, 0..9
  int next, end;     // points of this one still to come
  int j;             // the first of these points
  lanes dx, dy, dz;  // from them to the place; what is past the run's end is far away [m]
} Around;

static Around around(constant FluidParams* p, float x, float y, float z) {
  Around a;
  a.x = x;
  a.y = y;
  a.z = z;
  a.row = cell_row(p, y, z);
  a.slice = slice_x(p, x);
  a.run = a.next = a.end = a.j = 0;
  a.dx = a.dy = a.dz = 0.0f;
  return a;
}

// False: there are no more.
static bool next_around(constant FluidParams* p, const Cloud* points, Around* a) {
  while (a->next >= a->end) {
    if (a->run == 9) return false;
    const int2 run = neighbour_run(p, points->start, a->row, a->slice, a->slice, a->run++);
    a->next = run.x;
    a->end = run.y;
  }
  a->j = a->next;
  a->next += LANES;
  a->dx = a->x - load_x(points->position, a->j, a->end);
  a->dy = a->y - LOAD(points->position + points->stride, a->j);
  a->dz = a->z - LOAD(points->position + 2 * points->stride, a->j);
  return true;
}

static lanes square_of(const Around* a) {
  return a->dx * a->dx + a->dy * a->dy + a->dz * a->dz;
}
