// SPDX-License-Identifier: MIT
// The outlines of bodies, in closed form but for meshes (outline_mesh.h). Whatever depends on a
// body's form is here: how far its surface is and in which direction (many places at once, or one
// that is inside), how far it reaches, with which points it meets a wall, and with which corners
// and edges another body. Places and normals in the body's own axes; `meshes`: the numbers of all
// meshes.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline_mesh.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

#define RIM_PLACES 12

// What is left of up to three faces at right angles to each other: `q` are the distances from them
// [m], `part` becomes how much of each one's normal is in the normal there.
static lanes from_corner(const lanes q[3], lanes part[3]) {
  const lanes none = 0.0f, one = 1.0f;
  lanes out2 = 0.0f;
  for (int k = 0; k < 3; ++k) out2 += fmax(q[k], none) * fmax(q[k], none);
  const lanes inverse_out = inverse_root(fmax(out2, 1.0e-20f));
  const lanes deepest = fmax(q[0], fmax(q[1], q[2]));
  lanes taken = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const lanes nearest = select(none, one - taken, q[k] >= deepest);
    taken += nearest;
    part[k] = select(nearest, fmax(q[k], none) * inverse_out, out2 > none);
  }
  return select(deepest, out2 * inverse_out, out2 > none);
}

static BodyFace face_of_round(BodyShape s, lanes x, lanes y, lanes z) {
  const lanes above = s.kind == SPLASH_SPHERE ? z : (lanes)(0.0f);
  const lanes r2 = x * x + y * y + above * above;
  const lanes inverse_r = inverse_root(fmax(r2, 1.0e-20f));
  lanes q[3] = {r2 * inverse_r - s.half_x, fabs(z) - s.half_z, -FAR_AWAY};
  if (s.kind == SPLASH_SPHERE) q[1] = -FAR_AWAY;
  lanes part[3];
  BodyFace face;
  face.distance = from_corner(q, part);
  face.nx = part[0] * x * inverse_r;
  face.ny = part[0] * y * inverse_r;
  face.nz = part[0] * above * inverse_r + part[1] * copysign((lanes)(1.0f), z);
  return face;
}

// The underside of a box may curve up at both ends (sole_rise); there its distance is the height,
// of which the slope is known.
static BodyFace face_of_box(BodyShape s, lanes x, lanes y, lanes z) {
  const lanes one = 1.0f;
  const float bend = s.flat < 1.0f ? 1.0f / (1.0f - s.flat) : 0.0f;
  const lanes curved = fmax(fmin(fabs(x) / s.half_x, 1.0f) - s.flat, 0.0f) * bend;
  const lanes steep = select((lanes)(0.0f), 2.0f * s.rocker * curved * bend / s.half_x,
                             fabs(x) < s.half_x);
  const lanes under = s.rocker * curved * curved - s.half_z - z;
  const lanes over = z - s.half_z;
  const lanes q[3] = {fabs(x) - s.half_x, fabs(y) - s.half_y, fmax(under, over)};
  lanes part[3];
  BodyFace face;
  face.distance = from_corner(q, part);
  face.nx = (part[0] + select(part[2] * steep, (lanes)(0.0f), over > under)) * copysign(one, x);
  face.ny = part[1] * copysign(one, y);
  face.nz = part[2] * select(-one, one, over > under);
  return face;
}

static BodyFace face_of(BodyShape s, global const float* meshes, lanes x, lanes y, lanes z) {
  if (is_mesh(s)) return face_of_mesh(s, meshes, x, y, z);
  switch (form_of(s)) {
    case SPLASH_BOX:
    case SPLASH_MESH:  // built without
      break;
    case SPLASH_SPHERE:
    case SPLASH_CYLINDER:
      return face_of_round(s, x, y, z);
  }
  return face_of_box(s, x, y, z);
}

// Height of a curved sole above the underside of its flat middle (see rocker_rise).
static float sole_rise(BodyShape s, float x) {
  const float curved = fmax(fmin(fabs(x) / s.half_x, 1.0f) - s.flat, 0.0f) / (1.0f - s.flat);
  return s.rocker * curved * curved;
}

static float depth_in_sphere(BodyShape s, float3 at, float3* out) {
  const float r = length(at);
  *out = r > 0.0f ? at / r : (float3)(0.0f, 0.0f, 1.0f);
  return s.half_x - r;
}

// Below the upper end, or above the lower one, which is higher by `rise`.
static float depth_of_ends(BodyShape s, float z, float rise, float3* out) {
  const float top = s.half_z - z;
  const float under = z + s.half_z - rise;
  *out = (float3)(0.0f, 0.0f, top < under ? 1.0f : -1.0f);
  return fmin(top, under);
}

static float depth_in_cylinder(BodyShape s, float3 at, float3* out) {
  float depth = depth_of_ends(s, at.z, 0.0f, out);
  const float r = length(at.xy);
  if (s.half_x - r < depth) {
    depth = s.half_x - r;
    *out = r > 0.0f ? (float3)(at.xy / r, 0.0f) : (float3)(1.0f, 0.0f, 0.0f);
  }
  return depth;
}

static float depth_in_box(BodyShape s, float3 at, float3* out) {
  float depth = depth_of_ends(s, at.z, sole_rise(s, at.x), out);
  if (s.half_x - fabs(at.x) < depth) {
    depth = s.half_x - fabs(at.x);
    *out = (float3)(at.x < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f);
  }
  if (s.half_y - fabs(at.y) < depth) {
    depth = s.half_y - fabs(at.y);
    *out = (float3)(0.0f, at.y < 0.0f ? -1.0f : 1.0f, 0.0f);
  }
  return depth;
}

// Depth below the nearest face, zero or less outside [m]; `out`: that face's outward normal.
static float depth_inside(BodyShape s, global const float* meshes, float3 at, float3* out) {
  if (is_mesh(s)) return depth_in_mesh(s, meshes, at, out);
  switch (form_of(s)) {
    case SPLASH_SPHERE:
      return depth_in_sphere(s, at, out);
    case SPLASH_CYLINDER:
      return depth_in_cylinder(s, at, out);
    case SPLASH_BOX:
    case SPLASH_MESH:  // built without
      break;
  }
  return depth_in_box(s, at, out);
}

// How far the outline reaches from its centre along each axis of the world [m].
static float3 reach_along_axes(BodyShape s, BodyStep b) {
  const float3 z = out_of_body(b, (float3)(0.0f, 0.0f, 1.0f));
  switch (form_of(s)) {
    case SPLASH_SPHERE:
      return (float3)(s.half_x);
    case SPLASH_CYLINDER:
      return s.half_z * fabs(z) + s.half_x * sqrt(fmax(1.0f - z * z, 0.0f));
    case SPLASH_BOX:
    case SPLASH_MESH:  // the box around it
      break;
  }
  const float3 x = out_of_body(b, (float3)(1.0f, 0.0f, 0.0f));
  const float3 y = out_of_body(b, (float3)(0.0f, 1.0f, 0.0f));
  return s.half_x * fabs(x) + s.half_y * fabs(y) + s.half_z * fabs(z);
}

// The part of a moment about the body's centre that pressures on its surface can exert: none on a
// sphere, and none about a cylinder's axis.
static float3 moment_of_pressures(BodyShape s, BodyStep b, float3 moment) {
  switch (form_of(s)) {
    case SPLASH_SPHERE:
      return (float3)(0.0f);
    case SPLASH_CYLINDER: {
      const float3 z = out_of_body(b, (float3)(0.0f, 0.0f, 1.0f));
      return moment - dot(moment, z) * z;
    }
    case SPLASH_BOX:
    case SPLASH_MESH:
      break;
  }
  return moment;
}

// How far it reaches from its centre in any direction, at most, if along the axes so far [m].
static float farthest_reach(BodyShape s, float3 along_axes) {
  return s.kind == SPLASH_SPHERE ? s.half_x : length(along_axes);
}

static int box_contact_points(BodyShape s, BodyStep b, float3* lever) {
  for (int k = 0; k < 8; ++k) {
    lever[k] = out_of_body(b, (float3)(k & 1 ? s.half_x : -s.half_x, k & 2 ? s.half_y : -s.half_y,
                                       k & 4 ? s.half_z : -s.half_z));
  }
  return 8;
}

// On either rim the point nearest to the wall and three at right angles.
static int cylinder_contact_points(BodyShape s, BodyStep b, float3 normal, float3* lever) {
  const float3 own = into_body(b, normal);
  const float across = length(own.xy);
  const float2 down = across > 1.0e-4f ? -own.xy / across : (float2)(1.0f, 0.0f);
  for (int k = 0; k < 8; ++k) {
    const float2 side = k & 1 ? (float2)(-down.y, down.x) : down;
    const float2 at = (k & 2 ? -s.half_x : s.half_x) * side;
    lever[k] = out_of_body(b, (float3)(at, k & 4 ? s.half_z : -s.half_z));
  }
  return 8;
}

// Levers, in the world, of the points that a wall with this normal can meet; their number.
static int contact_points(BodyShape s, global const float* meshes, BodyStep b, float3 normal,
                          float3* lever) {
  if (is_mesh(s)) return mesh_contact_points(s, meshes, b, normal, lever);
  switch (form_of(s)) {
    case SPLASH_SPHERE:
      lever[0] = -s.half_x * normal;
      return 1;
    case SPLASH_CYLINDER:
      return cylinder_contact_points(s, b, normal, lever);
    case SPLASH_BOX:
    case SPLASH_MESH:  // built without
      break;
  }
  return box_contact_points(s, b, lever);
}

// What of a body can touch another first: corners and edges of a box, rims of a cylinder, and what
// is round about a place or a line, less its radius: a sphere's centre, the axis of a cylinder's
// round side. Corners and edges are rounded a little: a sharp corner that touches a face at its
// edge, as in a stack, would be as near to the face beside it. Places of meshes are in
// free_bodies/mesh_gap.h.

static float rounding_of(BodyShape s) {
  switch (form_of(s)) {
    case SPLASH_SPHERE:
      return s.half_x;
    case SPLASH_BOX:
    case SPLASH_CYLINDER:
    case SPLASH_MESH:
      break;
  }
  return SPLASH_ROUNDED * fmin(s.half_z, fmin(s.half_x, s.half_y));
}

// Half sizes of what is inside the rounding.
static float3 core_of(BodyShape s) {
  return (float3)(s.half_x, s.half_y, s.half_z) - rounding_of(s);
}

// Corners of a box, places on the rims of a cylinder, in the body's own axes.
static int corner_count(BodyShape s) {
  switch (form_of(s)) {
    case SPLASH_BOX:
      return 8;
    case SPLASH_CYLINDER:
      return 2 * RIM_PLACES;
    case SPLASH_SPHERE:
    case SPLASH_MESH:
      break;
  }
  return 0;
}

static float3 rim_place(BodyShape s, bool upper, float angle) {
  const float3 core = core_of(s);
  return (float3)(core.x * cos(angle), core.x * sin(angle), upper ? core.z : -core.z);
}

static float3 corner_of(BodyShape s, int k) {
  switch (form_of(s)) {
    case SPLASH_CYLINDER:
      return rim_place(s, k >= RIM_PLACES, (k % RIM_PLACES) * (6.2831853f / RIM_PLACES));
    case SPLASH_BOX:
    case SPLASH_SPHERE:
    case SPLASH_MESH:
      break;
  }
  return core_of(s) * (float3)(k & 1 ? 1.0f : -1.0f, k & 2 ? 1.0f : -1.0f, k & 4 ? 1.0f : -1.0f);
}

// Edges of a box, arcs of a cylinder's rims, and what is round about: an axis.
static int edge_count(BodyShape s) {
  switch (form_of(s)) {
    case SPLASH_BOX:
      return 12;
    case SPLASH_CYLINDER:
      return 2 * RIM_PLACES + 1;
    case SPLASH_SPHERE:
    case SPLASH_MESH:
      break;
  }
  return 1;
}

static float3 on_edge_of_box(BodyShape s, int k, float part) {
  const float along = 2.0f * part - 1.0f;
  const float a = k & 1 ? 1.0f : -1.0f, b = k & 2 ? 1.0f : -1.0f;
  if (k < 4) return core_of(s) * (float3)(along, a, b);
  if (k < 8) return core_of(s) * (float3)(a, along, b);
  return core_of(s) * (float3)(a, b, along);
}

// Place at `part` (0 to 1) of edge `k`, and how far the surface is from there.
static float3 on_edge(BodyShape s, int k, float part, float* radius) {
  float reach = 0.0f;  // of the axis
  switch (form_of(s)) {
    case SPLASH_BOX:
      *radius = rounding_of(s);
      return on_edge_of_box(s, k, part);
    case SPLASH_CYLINDER:
      *radius = rounding_of(s);
      if (k < 2 * RIM_PLACES) {
        return rim_place(s, k >= RIM_PLACES, (k % RIM_PLACES + part) * (6.2831853f / RIM_PLACES));
      }
      reach = core_of(s).z;
      break;
    case SPLASH_SPHERE:
    case SPLASH_MESH:
      break;
  }
  *radius = s.half_x;
  return (float3)(0.0f, 0.0f, (2.0f * part - 1.0f) * reach);
}

// How far the middle of an edge is from its farthest place, at most [m]; 0: it is one place.
static float half_of_edge(BodyShape s, int k) {
  switch (form_of(s)) {
    case SPLASH_BOX:
      return k < 4 ? s.half_x : k < 8 ? s.half_y : s.half_z;
    case SPLASH_CYLINDER:
      return k < 2 * RIM_PLACES ? s.half_x * (3.1415927f / RIM_PLACES) : s.half_z;
    case SPLASH_SPHERE:
    case SPLASH_MESH:
      break;
  }
  return 0.0f;
}
