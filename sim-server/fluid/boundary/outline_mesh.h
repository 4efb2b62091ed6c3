// SPDX-License-Identifier: MIT
// The outline of a mesh: its distance d sampled on a grid, linear along each axis between nodes,
// and beyond the grid that at its nearest place and the way to there. scene/mesh/distance_field.hpp
// says how wrong that is. The gradient is that of this very distance, of length 1 but for the edges
// and the middle of the body, so that what pushes with it is the gradient of an energy.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/params/smoothing.h"

static BodyForm form_of(BodyShape s) { return (BodyForm)s.kind; }

static bool is_mesh(BodyShape s) { return HAS_MESH && s.kind == SPLASH_MESH; }

static float mesh_distance(BodyShape s, global const float* meshes, float3 at, float3* gradient) {
  const float3 last = (float3)(s.nodes_x - 1, s.nodes_y - 1, s.nodes_z - 1);
  const float3 steps = (at - (float3)(s.lower_x, s.lower_y, s.lower_z)) / s.cell;
  const float3 kept = fmin(fmax(steps, (float3)(0.0f)), last);
  const float3 node = fmin(floor(kept), last - 1.0f);
  const float3 part = kept - node;
  const int row = s.nodes_x, layer = s.nodes_x * s.nodes_y;
  global const float* d = meshes + s.field + (int)node.x + row * (int)node.y + layer * (int)node.z;
  const float a = d[0], b = d[row], c = d[layer], e = d[layer + row];
  const float da = d[1] - a, db = d[row + 1] - b;
  const float dc = d[layer + 1] - c, de = d[layer + row + 1] - e;
  const float low = mix(a + part.x * da, b + part.x * db, part.y);
  const float high = mix(c + part.x * dc, e + part.x * de, part.y);
  const float3 rise = (float3)(mix(mix(da, db, part.y), mix(dc, de, part.y), part.z),
                               mix(b - a + part.x * (db - da), e - c + part.x * (de - dc), part.z),
                               high - low) / s.cell;
  const float3 beyond = steps - kept;
  const float far = length(beyond);
  *gradient = select(rise, beyond / fmax(far, TINY), beyond != 0.0f);
  return mix(low, high, part.z) + s.cell * far;
}

static BodyFace face_of_mesh(BodyShape s, global const float* meshes, lanes x, lanes y, lanes z) {
  float place[3][LANES], distance[LANES], normal[3][LANES];
  STORE(x, place[0], 0);
  STORE(y, place[1], 0);
  STORE(z, place[2], 0);
  for (int lane = 0; lane < LANES; ++lane) {
    float3 rise;
    distance[lane] = mesh_distance(
        s, meshes, (float3)(place[0][lane], place[1][lane], place[2][lane]), &rise);
    normal[0][lane] = rise.x;
    normal[1][lane] = rise.y;
    normal[2][lane] = rise.z;
  }
  BodyFace face;
  face.distance = LOAD(distance, 0);
  face.nx = LOAD(normal[0], 0);
  face.ny = LOAD(normal[1], 0);
  face.nz = LOAD(normal[2], 0);
  return face;
}

// As depth_inside of outline.h.
static float depth_in_mesh(BodyShape s, global const float* meshes, float3 at, float3* out) {
  float3 rise;
  const float distance = mesh_distance(s, meshes, at, &rise);
  const float size = length(rise);
  *out = size > 1.0e-6f ? rise / size : (float3)(0.0f, 0.0f, 1.0f);
  return -distance;
}

// From near there to where the depth is `kept`, along the distance's gradient (Newton's method,
// with steps that stay bounded where the gradient vanishes, far from all faces).
#define MESH_TURNS 48
#define LEAST_RISE2 0.1f
static float3 settled_in_mesh(BodyShape s, global const float* meshes, float kept, float3 at,
                              float3* out) {
  for (int turn = 0; turn < MESH_TURNS; ++turn) {
    float3 rise;
    const float over = -mesh_distance(s, meshes, at, &rise) - kept;
    if (fabs(over) < 1.0e-4f * kept) break;
    at += over / fmax(dot(rise, rise), LEAST_RISE2) * rise;
  }
  depth_in_mesh(s, meshes, at, out);
  return at;
}

// Directions tilted from `normal`, the first of them not, the others to seven sides.
#define MESH_TILT 0.1f  // [rad]
static void tilts_of(float3 normal, float3 way[CONTACT_POINTS]) {
  const float3 one = normalize(cross(normal, fabs(normal.x) < 0.7f ? (float3)(1.0f, 0.0f, 0.0f)
                                                                   : (float3)(0.0f, 1.0f, 0.0f)));
  const float3 other = cross(normal, one);
  way[0] = normal;
  for (int k = 1; k < CONTACT_POINTS; ++k) {
    const float angle = 2.0f * M_PI_F / (CONTACT_POINTS - 1) * k;
    way[k] = normal + MESH_TILT * (cos(angle) * one + sin(angle) * other);
  }
}

// Levers of the vertices that a wall with this normal, into the water, can meet first: the one that
// is farthest towards it, and those that would be if it were tilted to seven sides. However many
// vertices it has, none is beyond a wall that the first is not beyond.
static int mesh_contact_points(BodyShape s, global const float* meshes, BodyStep b, float3 normal,
                               float3* lever) {
  float3 way[CONTACT_POINTS];
  float least[CONTACT_POINTS];
  tilts_of(into_body(b, normal), way);
  for (int k = 0; k < CONTACT_POINTS; ++k) least[k] = FAR_AWAY;
  for (int v = 0; v < s.vertex_count; ++v) {
    const float3 place = vload3(v, meshes + s.vertices);
    for (int k = 0; k < CONTACT_POINTS; ++k) {
      const float height = dot(place, way[k]);
      if (height >= least[k]) continue;
      least[k] = height;
      lever[k] = place;
    }
  }
  for (int k = 0; k < CONTACT_POINTS; ++k) lever[k] = out_of_body(b, lever[k]);
  return CONTACT_POINTS;
}
