// SPDX-License-Identifier: MIT
// Free bodies against the tank's walls (contact.h): the points of an outline that a wall meets
// first.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/boundary/outline_mesh.h"
#include "sim-server/fluid/free_bodies/contact.h"
#include "sim-server/fluid/params/fluid_params.h"

#define WALL_CONTACTS 24  // of a body: 8 points on 3 walls

static float above_wall(constant FluidParams* p, int k, float piston, BodyStep b, float3 lever) {
  const float moved = k == p->piston ? piston : 0.0f;
  return p->walls[k].nx * (b.px + lever.x) + p->walls[k].ny * (b.py + lever.y) +
         p->walls[k].nz * (b.pz + lever.z) - (p->walls[k].offset + moved);
}

static float3 wall_normal(constant FluidParams* p, int k) {
  return (float3)(p->walls[k].nx, p->walls[k].ny, p->walls[k].nz);
}

// A mesh's vertices are many: they are asked only where a wall is within its reach in the step.
static bool may_meet(constant FluidParams* p, int k, BodyShape shape, BodyStep b, float dt,
                     float piston) {
  if (!is_mesh(shape)) return true;
  const float3 none = (float3)(0.0f, 0.0f, 0.0f);
  const float reach = length((float3)(shape.half_x, shape.half_y, shape.half_z));
  const float way = dt * (length(speed_at(b, none)) + p->speed_limit +
                          reach * length((float3)(b.wx, b.wy, b.wz)));
  return above_wall(p, k, piston, b, none) < reach + way;
}

static void meet_walls(Contacts* all, constant FluidParams* p, BodyShape shape,
                       global const float* meshes, int free_body, float dt, float piston,
                       float piston_speed) {
  const BodyStep b = *step_of(all, free_body);
  const int room = all->room;
  all->room = min(room, all->count + WALL_CONTACTS);
  float3 lever[CONTACT_POINTS];
  for (int k = 0; k < p->wall_count; ++k) {
    if (!may_meet(p, k, shape, b, dt, piston)) continue;
    const float3 normal = wall_normal(p, k);
    const int points = contact_points(shape, meshes, b, normal, lever);
    for (int i = 0; i < points; ++i) {
      Contact c;
      c.body = free_body;
      c.other = NO_BODY;
      c.lever = lever[i];
      c.normal = normal;
      c.key = contact_key(all->frees[free_body].body, MET_WALLS + k, false, i);
      c.friction = friction_on(all, free_body, MET_WALLS);
      c.drift = (k == p->piston ? piston_speed : 0.0f) * normal;
      add_contact(all, c, above_wall(p, k, piston, b, lever[i]), touching(shape), dt);
    }
  }
  all->room = room;
}

// What turned into a wall, or was there, is put back: no motion comes of it. `ways`: 1 along those
// by which the body is not held.
static void leave_walls(constant FluidParams* p, BodyShape shape, global const float* meshes,
                        float piston, float3 ways, BodyStep* b) {
  float3 lever[CONTACT_POINTS];
  for (int k = 0; k < p->wall_count; ++k) {
    if (!may_meet(p, k, shape, *b, 0.0f, piston)) continue;
    const float3 normal = wall_normal(p, k);
    const int points = contact_points(shape, meshes, *b, normal, lever);
    float deepest = 0.0f;
    for (int i = 0; i < points; ++i) {
      deepest = fmin(deepest, above_wall(p, k, piston, *b, lever[i]));
    }
    b->px -= deepest * ways.x * normal.x;
    b->py -= deepest * ways.y * normal.y;
    b->pz -= deepest * ways.z * normal.z;
  }
}
