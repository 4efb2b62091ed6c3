// SPDX-License-Identifier: MIT
// The places of a mesh that meet another outline first. Candidates are its vertices and points
// along its sharp edges; taken are the one that is nearest to the other, and those that would be if
// the mesh were tilted to seven sides, as before a wall (mesh_contact_points).

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline_mesh.h"
#include "sim-server/fluid/free_bodies/contact.h"
#include "sim-server/fluid/free_bodies/outline_gap.h"
#include "sim-server/fluid/lanes/lanes.h"

static float3 mesh_place(const Pairing* m, int v) {
  return place_of(m->step) + out_of_body(m->step, vload3(v, m->meshes + m->shape.vertices));
}

// Distance of place `v` from the other [m]; FAR_AWAY: it is beyond the box around the other, grown
// by `reach`.
static float mesh_place_distance(const Pairing* m, int v, float reach, float3* at,
                                 float3* normal) {
  *at = mesh_place(m, v);
  const float3 own = fabs(into_body(m->step_other, *at - place_of(m->step_other)));
  const BodyShape other = m->shape_other;
  if (own.x > other.half_x + reach || own.y > other.half_y + reach ||
      own.z > other.half_z + reach) {
    return FAR_AWAY;
  }
  return outline_distance(other, m->meshes, m->step_other, *at, normal);
}

// The place that is nearest to the other, by less than `reach`; below 0: none.
static int nearest_mesh_place(const Pairing* m, float reach, float* least, float3* at,
                              float3* normal) {
  int nearest = -1;
  *least = reach;
  for (int v = 0; v < m->shape.vertex_count; ++v) {
    float3 place, out;
    const float gap = mesh_place_distance(m, v, reach, &place, &out);
    if (gap >= *least) continue;
    *least = gap;
    *at = place;
    *normal = out;
    nearest = v;
  }
  return nearest;
}

// Numbers of the places that meet the other within `reach`; how many they are.
static int mesh_meeting_places(const Pairing* m, float reach, int places[CONTACT_POINTS]) {
  float gap;
  float3 first, normal, at, out;
  const int nearest = nearest_mesh_place(m, reach, &gap, &first, &normal);
  if (nearest < 0) return 0;
  float3 way[CONTACT_POINTS];
  float least[CONTACT_POINTS];
  tilts_of(normal, way);
  for (int k = 0; k < CONTACT_POINTS; ++k) {
    least[k] = gap;
    places[k] = nearest;
  }
  for (int v = 0; v < m->shape.vertex_count; ++v) {
    gap = mesh_place_distance(m, v, reach, &at, &out);
    if (gap >= reach) continue;
    for (int k = 1; k < CONTACT_POINTS; ++k) {
      const float tilted = gap + dot(way[k] - normal, at - first);
      if (tilted >= least[k]) continue;
      least[k] = tilted;
      places[k] = v;
    }
  }
  int count = 0;
  for (int k = 0; k < CONTACT_POINTS; ++k) {
    bool taken = false;
    for (int i = 0; i < count; ++i) taken = taken || places[i] == places[k];
    if (!taken) places[count++] = places[k];
  }
  return count;
}

// The way along which a mesh leaves the other at its deepest place [m].
static float3 overlap_of_mesh(const Pairing* m) {
  float gap;
  float3 at, normal;
  const int deepest = nearest_mesh_place(m, 0.0f, &gap, &at, &normal);
  return deepest < 0 ? (float3)(0.0f, 0.0f, 0.0f) : -gap * normal;
}

// The way along which `one` leaves `two`, as long as they overlap there [m].
static float3 overlap_of(const Pairing* m) {
  if (is_mesh(m->shape)) return overlap_of_mesh(m);
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
