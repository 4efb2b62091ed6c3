// SPDX-License-Identifier: MIT
// Free bodies against each other, and against those that go their way (contact.h): wherever two
// outlines would be in each other after the step (outline_gap.h, mesh_gap.h).

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/boundary/outline_mesh.h"
#include "sim-server/fluid/free_bodies/contact.h"
#include "sim-server/fluid/free_bodies/mesh_gap.h"
#include "sim-server/fluid/free_bodies/outline_gap.h"
#include "sim-server/fluid/params/fluid_params.h"

#define FIRST_EDGE 64  // number of the first edge among a body's features
#define PUT_APART 4    // times that overlaps are ended, pair after pair
#define LEFT_IN 0.1f   // overlap that is left, so that what lies stays in touch [touching]
#define BOX_SLACK 1.01f  // of boxes, for the rounding of places [1]

static float touch_of(const Pairing* m) {
  return fmin(touching(m->shape), touching(m->shape_other));
}

// Whether the boxes around two outlines, along the axes of the world, meet within the step: what
// does not is passed over before any corner is looked at.
static bool boxes_meet(const Pairing* m, float dt) {
  const float3 apart = fabs(place_of(m->step) - place_of(m->step_other));
  const float3 sizes = reach_along_axes(m->shape, m->step) +
                       reach_along_axes(m->shape_other, m->step_other);
  const float3 reach =
      BOX_SLACK * sizes + touch_of(m) + dt * (m->step.speed + m->step_other.speed);
  return apart.x < reach.x && apart.y < reach.y && apart.z < reach.z;
}

static Pairing turned_round(const Pairing* m) {
  const Pairing turned = {m->shape_other, m->shape, m->step_other,
                          m->step,        m->two,   m->one, m->body_other, m->body, m->meshes};
  return turned;
}

// A place of body `one`, its `feature`, that is `gap` away from `two`, whose normal there is
// `normal`.
static void add_meeting(Contacts* all, const Pairing* m, int feature, float3 at, float3 normal,
                        float gap, float dt) {
  const bool turned = m->one == NO_BODY;
  const BodyStep mine = turned ? m->step_other : m->step;
  const BodyStep theirs = turned ? m->step : m->step_other;
  Contact c;
  c.body = turned ? m->two : m->one;
  c.other = turned ? NO_BODY : m->two;
  c.lever = at - place_of(mine);
  c.other_lever = at - place_of(theirs);
  c.normal = turned ? -normal : normal;
  c.key = contact_key(m->body, m->body_other, turned, feature);
  c.friction = friction_on(all, c.body, turned ? m->body : m->body_other);
  c.drift = speed_at(theirs, c.other_lever);
  add_contact(all, c, gap, touch_of(m), dt);
}

static void add_meetings(Contacts* all, const Pairing* m, float dt) {
  const float reach = touch_of(m) + dt * (m->step.speed + m->step_other.speed);
  float3 at, normal;
  float gap;
  if (is_mesh(m->shape)) {
    int places[CONTACT_POINTS];
    const int count = mesh_meeting_places(m, reach, places);
    for (int k = 0; k < count; ++k) {
      gap = mesh_place_distance(m, places[k], reach, &at, &normal);
      add_meeting(all, m, k, at, normal, gap, dt);
    }
    return;
  }
  for (int k = 0; k < corner_count(m->shape); ++k) {
    gap = corner_distance(m, k, &at, &normal);
    add_meeting(all, m, k, at, normal, gap, dt);
  }
  for (int k = 0; k < edge_count(m->shape); ++k) {
    if (!least_on_edge(m, k, reach, &gap, &at, &normal)) continue;
    add_meeting(all, m, FIRST_EDGE + k, at, normal, gap, dt);
  }
}

// Number among the free bodies of body `body`.
static int free_number(constant FreeBody* frees, int free_count, int body) {
  for (int k = 0; k < free_count; ++k) {
    if (frees[k].body == body) return k;
  }
  return NO_BODY;
}

// The pair of free body `k` and body `j`; false: none, or it is met from the other side.
static bool pair_up(constant FreeBody* frees, int free_count, constant BodyShape* shapes,
                    global const float* meshes, BodyStep step, BodyStep step_other, int k, int j,
                    float dt, Pairing* m) {
  const int two = free_number(frees, free_count, j);
  if (j == frees[k].body || (two != NO_BODY && two < k)) return false;
  m->shape = shapes[frees[k].body];
  m->shape_other = shapes[j];
  m->step = step;
  m->step_other = step_other;
  m->one = k;
  m->two = two;
  m->body = frees[k].body;
  m->body_other = j;
  m->meshes = meshes;
  return boxes_meet(m, dt);
}

static void meet_bodies(Contacts* all, constant BodyShape* shapes, global const float* meshes,
                        int free_count, int body_count, float dt) {
  for (int k = 0; k < free_count; ++k) {
    for (int j = 0; j < body_count; ++j) {
      Pairing m;
      if (!pair_up(all->frees, free_count, shapes, meshes, *step_of(all, k), all->bodies[j], k, j,
                   dt, &m)) {
        continue;
      }
      add_meetings(all, &m, dt);
      const Pairing turned = turned_round(&m);
      add_meetings(all, &turned, dt);
    }
  }
}

static void shift(BodyStep* b, float3 way) {
  b->px += way.x;
  b->py += way.y;
  b->pz += way.z;
}

// Where body `j` is after the step: a free one has moved on already.
static BodyStep step_after(const Contacts* all, int body_count, int free_body, int j, float dt) {
  if (free_body != NO_BODY) return all->bodies[body_count + j];
  BodyStep b = all->bodies[j];
  shift(&b, dt * (float3)(b.vx, b.vy, b.vz));
  turn_body(dt * (float3)(b.wx, b.wy, b.wz), &b);
  return b;
}

// Ends what is left of an overlap: no motion comes of it. Each free body gives way in inverse
// proportion to its mass.
static void put_apart(const Contacts* all, const Pairing* m, int body_count, int j) {
  const Pairing turned = turned_round(m);
  const float3 way = overlap_of(m), back = overlap_of(&turned);
  float3 apart = dot(way, way) > dot(back, back) ? way : -back;
  const float overlap = length(apart), left = LEFT_IN * touch_of(m);
  if (!(overlap > left)) return;
  apart *= 1.0f - left / overlap;
  const FreeBody f = all->frees[m->one];
  const float theirs = m->two == NO_BODY ? 0.0f : f.mass / (f.mass + all->frees[m->two].mass);
  BodyStep mine = m->step, other = m->step_other;
  shift(&mine, (1.0f - theirs) * free_ways(f) * apart);
  all->bodies[body_count + f.body] = mine;
  if (m->two == NO_BODY) return;
  shift(&other, -theirs * free_ways(all->frees[m->two]) * apart);
  all->bodies[body_count + j] = other;
}

static void leave_bodies(const Contacts* all, constant BodyShape* shapes,
                         global const float* meshes, int free_count, int body_count, float dt) {
  for (int k = 0; k < free_count; ++k) {
    for (int j = 0; j < body_count; ++j) {
      const int two = free_number(all->frees, free_count, j);
      Pairing m;
      const BodyStep mine = step_after(all, body_count, k, all->frees[k].body, dt);
      const BodyStep other = step_after(all, body_count, two, j, dt);
      if (pair_up(all->frees, free_count, shapes, meshes, mine, other, k, j, dt, &m)) {
        put_apart(all, &m, body_count, j);
      }
    }
  }
}
