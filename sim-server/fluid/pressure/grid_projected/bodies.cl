// SPDX-License-Identifier: MIT
// Where bodies are in the grid: how much of each face and cell they leave open, by the distances of
// places half a cell apart from the nearest outline, which between them are taken as linear (Batty,
// Bertails & Bridson 2007; areas in closed form). A cell that a body cuts is as full as its water
// fills what the hat sees of open water around it.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define COUNTED_ROOM 0.15f // a cell's fill is of no less [1]

// Where a body's face is beside a triangle: part of it where the distance is positive [1].
static float open_triangle(float a, float b, float c) {
  const int closed = (a <= 0.0f) + (b <= 0.0f) + (c <= 0.0f);
  if (closed == 0) return 1.0f;
  if (closed == 3) return 0.0f;
  // The corner that is alone on its side comes first.
  const bool alone_open = closed == 2;
  if ((b > 0.0f) == alone_open) {
    const float swap = a;
    a = b;
    b = swap;
  } else if ((c > 0.0f) == alone_open) {
    const float swap = a;
    a = c;
    c = swap;
  }
  const float corner = a * a / ((a - b) * (a - c));
  return alone_open ? corner : 1.0f - corner;
}

// Of a square, corners in turn: of its four triangles around the middle.
static float open_square(float a, float b, float c, float d) {
  if (fmin(fmin(a, b), fmin(c, d)) > 0.0f) return 1.0f;
  if (fmax(fmax(a, b), fmax(c, d)) <= 0.0f) return 0.0f;
  const float m = 0.25f * (a + b + c + d);
  return 0.25f * (open_triangle(a, b, m) + open_triangle(b, c, m) + open_triangle(c, d, m) +
                  open_triangle(d, a, m));
}

// Distances from the nearest body of the 27 corners, middles of edges and faces, and the middle of
// a cell, x first.
static void measure_cell(constant MacGrid* g, constant BodyShape* shapes,
                         global const float* meshes, global const BodyStep* bodies,
                         int first_body, int body_count, int4 at, float* distance) {
  for (int first = 0; first < 27; first += LANES) {
    float place[3][LANES];
    for (int lane = 0; lane < LANES; ++lane) {
      const int k = min(first + lane, 26);
      place[0][lane] = g->x + (at.x + 0.5f * (k % 3)) * g->hx;
      place[1][lane] = g->y + (at.y + 0.5f * (k / 3 % 3)) * g->hy;
      place[2][lane] = g->z + (at.z + 0.5f * (k / 9)) * g->hz;
    }
    const BodyFace face = nearest_face(shapes, meshes, bodies, first_body, body_count,
                                       LOAD(place[0], 0), LOAD(place[1], 0), LOAD(place[2], 0));
    float part[LANES];
    STORE(face.distance, part, 0);
    for (int lane = 0; lane < LANES && first + lane < 27; ++lane) {
      distance[first + lane] = part[lane];
    }
  }
}

// Of one of the cell's nine squares that begins with point `k` of these, `a` and `b` apart.
static float open_face(const float* d, int k, int a, int b) {
  float sum = 0.0f;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const int q = k + (quarter & 1 ? a : 0) + (quarter & 2 ? b : 0);
    sum += open_square(d[q], d[q + a], d[q + a + b], d[q + b]);
  }
  return 0.25f * sum;
}

// `gap`: open part of each cell's lower faces, `room`: of its volume, by the rule of Simpson along
// z; `owner`: of a cell that is cut, the body, else -1.
kernel void cut_cells(constant FluidParams* p, constant MacGrid* g, constant BodyShape* shapes,
                      global const float* meshes, global const BodyStep* bodies, int first_body,
                      int body_count, global float* gap, global float* room, global int* owner) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  gap[c] = gap[l.cells + c] = gap[2 * l.cells + c] = room[c] = 1.0f;
  owner[c] = -1;
  const float3 lower = (float3)(g->x + at.x * g->hx, g->y + at.y * g->hy, g->z + at.z * g->hz);
  const float3 upper = lower + (float3)(g->hx, g->hy, g->hz);
  if (!bodies_near_box(bodies, first_body, body_count, lower, upper)) return;
  float d[27];
  measure_cell(g, shapes, meshes, bodies, first_body, body_count, at, d);
  float nearest = d[0];
  for (int k = 1; k < 27; ++k) nearest = fmin(nearest, d[k]);
  if (nearest > 0.0f) return;
  const float below = open_face(d, 0, 1, 3);
  gap[c] = open_face(d, 0, 3, 9);
  gap[l.cells + c] = open_face(d, 0, 1, 9);
  gap[2 * l.cells + c] = below;
  room[c] = (below + 4.0f * open_face(d, 9, 1, 3) + open_face(d, 18, 1, 3)) / 6.0f;
  const float3 middle = 0.5f * (lower + upper);
  owner[c] = (int)first_lane(nearest_face(shapes, meshes, bodies, first_body, body_count,
                                          middle.x, middle.y, middle.z)
                                 .owner);
}

// What the hat of a cell's middle sees of open water: 3/4 of its weight is in the cell itself along
// each axis, an eighth on either side.
static float room_seen(const MacLevel l, global const float* room, int4 at) {
  float sum = 0.0f;
  for (int k = 0; k < 27; ++k) {
    const int x = k % 3 - 1, y = k / 3 % 3 - 1, z = k / 9 - 1;
    const int4 there = (int4)(clamp(at.x + x, 0, l.nx - 1), clamp(at.y + y, 0, l.ny - 1),
                              clamp(at.z + z, 0, l.nz - 1), 1);
    const float part = (x ? 0.125f : 0.75f) * (y ? 0.125f : 0.75f) * (z ? 0.125f : 0.75f);
    sum += part * room[number_of(l, there)];
  }
  return sum;
}

kernel void fill_beside_bodies(constant FluidParams* p, constant MacGrid* g,
                               global const BodyStep* bodies, int first_body, int body_count,
                               global const float* room, global float* fill) {
  const int4 at = cell_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.w == 0 || at.x == l.nx || at.y == l.ny || at.z == l.nz) return;
  const float3 lower =
      (float3)(g->x + (at.x - 1) * g->hx, g->y + (at.y - 1) * g->hy, g->z + (at.z - 1) * g->hz);
  const float3 upper = lower + 3.0f * (float3)(g->hx, g->hy, g->hz);
  if (!bodies_near_box(bodies, first_body, body_count, lower, upper)) return;
  fill[number_of(l, at)] /= fmax(room_seen(l, room, at), COUNTED_ROOM);
}
