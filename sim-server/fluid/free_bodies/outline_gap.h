// SPDX-License-Identifier: MIT
// How far two outlines are apart, or in each other: not of meshes. They are convex, so the distance
// from one is a convex function of place: along an edge of the other it has one least value, found
// by golden section, and what can touch first are corners, edges and axes:
//   of a sphere its centre and of a cylinder's round side its axis, both less the radius;
//   of a box corners and edges; of a cylinder its rims.
// These are rounded a little: a sharp corner that touches a face at its edge, as in a stack, would
// be as near to the face beside it.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/free_bodies/contact.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

#define RIM_PLACES 12
#define SECTIONS 16           // 0.618^16 = 4.5e-4 of an edge
#define GOLDEN 0.61803399f
#define NOT_AN_END 1.0e-3f    // nearer than an edge's ends by less is one of them [half edges]

// Distance of a place in the world from an outline [m], and its normal there.
static float outline_distance(BodyShape s, BodyStep b, float3 at, float3* normal) {
  const float3 own = into_body(b, at - place_of(b));
  const BodyFace face = face_of(s, 0, (lanes)(own.x), (lanes)(own.y), (lanes)(own.z));
  *normal = out_of_body(b, (float3)(first_lane(face.nx), first_lane(face.ny),
                                    first_lane(face.nz)));
  return first_lane(face.distance);
}

// Meshes are not met (body_contact.h): they have no corners and edges here.

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

// Two bodies, one of whose corners and edges are looked at.
typedef struct {
  BodyShape shape, shape_other;
  BodyStep step, step_other;
  int one, two;  // their numbers among the free bodies, or NO_BODY
  int body, body_other;  // and among all
} Pairing;

static float edge_distance(const Pairing* m, int k, float part, float3* at, float3* normal) {
  float radius;
  const float3 own = on_edge(m->shape, k, part, &radius);
  *at = place_of(m->step) + out_of_body(m->step, own);
  const float gap = outline_distance(m->shape_other, m->step_other, *at, normal) - radius;
  *at -= radius * *normal;
  return gap;
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

// The part of an edge at which the other is nearest.
static float nearest_part(const Pairing* m, int k) {
  float low = 0.0f, high = 1.0f, left = 1.0f - GOLDEN, right = GOLDEN;
  float3 at, normal;
  float left_gap = edge_distance(m, k, left, &at, &normal);
  float right_gap = edge_distance(m, k, right, &at, &normal);
  for (int section = 0; section < SECTIONS; ++section) {
    if (left_gap < right_gap) {
      high = right;
      right = left;
      right_gap = left_gap;
      left = high - GOLDEN * (high - low);
      left_gap = edge_distance(m, k, left, &at, &normal);
    } else {
      low = left;
      left = right;
      left_gap = right_gap;
      right = low + GOLDEN * (high - low);
      right_gap = edge_distance(m, k, right, &at, &normal);
    }
  }
  return 0.5f * (low + high);
}

// The least distance along an edge; false: it is at an end, where corners are, or beyond `reach`.
static bool least_on_edge(const Pairing* m, int k, float reach, float* gap, float3* at,
                          float3* normal) {
  const float half_edge = half_of_edge(m->shape, k);
  if (edge_distance(m, k, 0.5f, at, normal) - half_edge > reach) return false;
  const float ends = fmin(edge_distance(m, k, 0.0f, at, normal),
                          edge_distance(m, k, 1.0f, at, normal));
  *gap = edge_distance(m, k, nearest_part(m, k), at, normal);
  return half_edge == 0.0f || *gap < ends - NOT_AN_END * half_edge;
}

static float corner_distance(const Pairing* m, int k, float3* at, float3* normal) {
  const float radius = rounding_of(m->shape);
  *at = place_of(m->step) + out_of_body(m->step, corner_of(m->shape, k));
  const float gap = outline_distance(m->shape_other, m->step_other, *at, normal) - radius;
  *at -= radius * *normal;
  return gap;
}

// The way along which `one` leaves `two`, as long as they overlap there [m].
static float3 overlap_of(const Pairing* m) {
  float deepest = 0.0f, gap;
  float3 way = (float3)(0.0f, 0.0f, 0.0f), at, normal;
  for (int k = 0; k < corner_count(m->shape); ++k) {
    gap = corner_distance(m, k, &at, &normal);
    if (gap < deepest) {
      deepest = gap;
      way = -gap * normal;
    }
  }
  for (int k = 0; k < edge_count(m->shape); ++k) {
    if (least_on_edge(m, k, 0.0f, &gap, &at, &normal) && gap < deepest) {
      deepest = gap;
      way = -gap * normal;
    }
  }
  return way;
}
