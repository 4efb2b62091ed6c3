// SPDX-License-Identifier: MIT
// Solids by the distances of places from the nearest outline. Between places they are taken as
// linear, so a flat face is where it is.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"

#define LEAST_SEEN 1e-4f  // cells that see less open space are full of nothing [1]
#define LEAST_GAP 1e-3f   // faces that are less open are closed [1]
#define FILM 0.02f       // of water beneath bodies that stand on the floor [cells]

// The place at which the distance from solids is measured for a place of the grid: FILM below it if
// it is on the floor. So a body that stands on the floor has water beneath it, whose pressure it
// feels, and one that goes through the floor has none. `sides`: the same at the side walls, for
// free bodies alone, since others, such as gates, may have to be tight.
static float3 looked_at(constant MacGrid* g, float3 x, bool sides) {
  const MacLevel l = g->level[0];
  const float3 film = FILM * (float3)(g->hx, g->hy, g->hz), from = (float3)(g->x, g->y, g->z);
  const float3 to = from + (float3)(l.nx * g->hx, l.ny * g->hy, 0.0f);
  if (x.z < from.z + film.z) x.z = from.z - film.z;
  if (!sides) return x;
  if (x.x < from.x + film.x) x.x = from.x - film.x;
  if (x.y < from.y + film.y) x.y = from.y - film.y;
  if (x.x > to.x - film.x) x.x = to.x + film.x;
  if (x.y > to.y - film.y) x.y = to.y + film.y;
  return x;
}

// Part of a tetrahedron where a linear distance is positive, from those of its corners [1].
static float open_tetrahedron(float a, float b, float c, float d) {
  const int closed = (a <= 0.0f) + (b <= 0.0f) + (c <= 0.0f) + (d <= 0.0f);
  if (closed == 0) return 1.0f;
  if (closed == 4) return 0.0f;
  float s[4] = {a, b, c, d};  // the open ones first
  for (int k = 0, next = 0; k < 4; ++k) {
    if (s[k] <= 0.0f) continue;
    const float swap = s[next];
    s[next++] = s[k];
    s[k] = swap;
  }
  if (closed == 3) return s[0] * s[0] * s[0] / ((s[0] - s[1]) * (s[0] - s[2]) * (s[0] - s[3]));
  if (closed == 1) {
    return 1.0f - s[3] * s[3] * s[3] / ((s[3] - s[0]) * (s[3] - s[1]) * (s[3] - s[2]));
  }
  const float ab = s[0] * s[1], cd = s[2] * s[3], open = s[0] + s[1];
  return (ab * ab - (s[2] + s[3]) * ab * open + cd * (open * open - ab)) /
         ((s[0] - s[2]) * (s[0] - s[3]) * (s[1] - s[2]) * (s[1] - s[3]));
}

// Part of a box where the distance is positive, from those of its eight corners, x first [1]. The
// box is cut into six tetrahedra around its diagonal from the first corner to the last (Kuhn 1960).
static float open_box(const float* d) {
  float low = d[0], high = d[0];
  for (int k = 1; k < 8; ++k) {
    low = fmin(low, d[k]);
    high = fmax(high, d[k]);
  }
  if (low > 0.0f) return 1.0f;
  if (high <= 0.0f) return 0.0f;
  return (open_tetrahedron(d[0], d[1], d[3], d[7]) + open_tetrahedron(d[0], d[1], d[5], d[7]) +
          open_tetrahedron(d[0], d[2], d[3], d[7]) + open_tetrahedron(d[0], d[2], d[6], d[7]) +
          open_tetrahedron(d[0], d[4], d[5], d[7]) + open_tetrahedron(d[0], d[4], d[6], d[7])) /
         6.0f;
}

// The kernel arguments that describe bodies and piston.
typedef struct {
  constant BodyShape* shapes;
  global const float* meshes;
  global const BodyStep* bodies;
  int first, count;
  float piston;
} Solids;

// How far the nearest solid is, and whose it is: of the bodies that may be within the support of
// the box from `lower` to `upper`.
static lanes solid_distance(constant FluidParams* p, const Solids* s, float3 lower, float3 upper,
                            lanes x, lanes y, lanes z, lanes* owner) {
  const BodyFace face = nearest_face_near(s->shapes, s->meshes, s->bodies, s->first, s->count,
                                          lower, upper, x, y, z);
  lanes distance = face.distance;
  *owner = s->count > 0 ? face.owner : (lanes)(OF_NOBODY);
  if (has_slope(p)) {
    const lanes above = wall_distance(p, p->slope, x, y, z, s->piston);
    *owner = select(*owner, (lanes)(OF_SLOPE), above < distance);
    distance = fmin(distance, above);
  }
  if (HAS_PISTON && p->piston >= 0) {
    const lanes before = wall_distance(p, p->piston, x, y, z, s->piston);
    *owner = select(*owner, (lanes)(OF_PISTON), before < distance);
    distance = fmin(distance, before);
  }
  return distance;
}
