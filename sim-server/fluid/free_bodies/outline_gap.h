// SPDX-License-Identifier: MIT
// How far two outlines are apart, or in each other. But for meshes they are convex, so the distance
// from one is a convex function of place: along an edge of the other it has one least value, found
// by golden section, and what can touch first are corners and edges (boundary/outline.h). From a
// mesh it may have several: the search begins around the least of some places along the edge.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/boundary/outline_mesh.h"
#include "sim-server/fluid/free_bodies/contact.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

#define SECTIONS 16           // 0.618^16 = 4.5e-4 of an edge
#define GOLDEN 0.61803399f
#define NOT_AN_END 1.0e-3f    // nearer than an edge's ends by less is one of them [half edges]
#define EDGE_LOOKS 8          // stretches of an edge before a mesh; the nearest one is searched

// Distance of a place in the world from an outline [m], and its normal there.
static float outline_distance(BodyShape s, global const float* meshes, BodyStep b, float3 at,
                              float3* normal) {
  const float3 own = into_body(b, at - place_of(b));
  if (is_mesh(s)) {
    float3 out;
    const float depth = depth_in_mesh(s, meshes, own, &out);
    *normal = out_of_body(b, out);
    return -depth;
  }
  const BodyFace face = face_of(s, 0, (lanes)(own.x), (lanes)(own.y), (lanes)(own.z));
  *normal = out_of_body(b, (float3)(first_lane(face.nx), first_lane(face.ny),
                                    first_lane(face.nz)));
  return first_lane(face.distance);
}

// Two bodies, one of whose corners and edges are looked at.
typedef struct {
  BodyShape shape, shape_other;
  BodyStep step, step_other;
  int one, two;  // their numbers among the free bodies, or NO_BODY
  int body, body_other;  // and among all
  global const float* meshes;
} Pairing;

static float edge_distance(const Pairing* m, int k, float part, float3* at, float3* normal) {
  float radius;
  const float3 own = on_edge(m->shape, k, part, &radius);
  *at = place_of(m->step) + out_of_body(m->step, own);
  const float gap =
      outline_distance(m->shape_other, m->meshes, m->step_other, *at, normal) - radius;
  *at -= radius * *normal;
  return gap;
}

// Where, along an edge, to search for the part at which the other is nearest.
static void bracket_nearest(const Pairing* m, int k, float* low, float* high) {
  *low = 0.0f;
  *high = 1.0f;
  if (!is_mesh(m->shape_other)) return;
  float least = FAR_AWAY;
  int nearest = 0;
  for (int look = 0; look <= EDGE_LOOKS; ++look) {
    float3 at, normal;
    const float gap = edge_distance(m, k, (float)look / EDGE_LOOKS, &at, &normal);
    if (gap >= least) continue;
    least = gap;
    nearest = look;
  }
  *low = (float)max(nearest - 1, 0) / EDGE_LOOKS;
  *high = (float)min(nearest + 1, EDGE_LOOKS) / EDGE_LOOKS;
}

// The part of an edge at which the other is nearest.
static float nearest_part(const Pairing* m, int k) {
  float low, high;
  bracket_nearest(m, k, &low, &high);
  float left = high - GOLDEN * (high - low), right = low + GOLDEN * (high - low);
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
  const float gap =
      outline_distance(m->shape_other, m->meshes, m->step_other, *at, normal) - radius;
  *at -= radius * *normal;
  return gap;
}
