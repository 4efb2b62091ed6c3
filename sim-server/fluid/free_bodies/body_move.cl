// SPDX-License-Identifier: MIT
// Free bodies move on by one step, after all that the water and the walls do to them:
//   x += dt V
//   R turns by dt w at the middle of the step; angular momentum L = R I R^T w is what it was
// (explicit midpoint: a body that nothing touches keeps its angular momentum to rounding).
// The result is where the body is in the next step.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_inertia.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/free_bodies/body_contact.h"
#include "sim-server/fluid/free_bodies/contact.h"
#include "sim-server/fluid/free_bodies/tank_contact.h"
#include "sim-server/fluid/params/fluid_params.h"

static void set_spin(float3 spin, BodyStep* b) {
  b->wx = spin.x;
  b->wy = spin.y;
  b->wz = spin.z;
}

static void move_on(FreeBody f, float dt, BodyStep* b) {
  const float3 spin = (float3)(b->wx, b->wy, b->wz);
  const float3 momentum = inertia_times(f, *b, spin);
  BodyStep middle = *b;
  turn_body(0.5f * dt * spin, &middle);
  turn_body(dt * inertia_solve(f, middle, momentum), b);
  set_spin(inertia_solve(f, *b, momentum), b);
  b->px += dt * b->vx;
  b->py += dt * b->vy;
  b->pz += dt * b->vz;
}

// The box around a body, grown by the support, and the speed of its fastest point at most.
static void note_reach(BodyShape s, float support, BodyStep* b) {
  const float3 extent = reach_along_axes(s, *b), grown = extent + support;
  b->lower_x = b->px - grown.x;
  b->lower_y = b->py - grown.y;
  b->lower_z = b->pz - grown.z;
  b->upper_x = b->px + grown.x;
  b->upper_y = b->py + grown.y;
  b->upper_z = b->pz + grown.z;
  const float far = farthest_reach(s, extent);
  b->speed =
      length((float3)(b->vx, b->vy, b->vz)) + far * length((float3)(b->wx, b->wy, b->wz));
}

// What touches what, and the speeds after that. Walls last: they do not give way.
static void collide(Contacts* all, constant FluidParams* p, constant BodyShape* shapes,
                    global const float* meshes, int free_count, int body_count, float dt,
                    float piston, float piston_speed) {
  const int room = all->room;
  all->room = room - free_count * WALL_CONTACTS;
  meet_bodies(all, shapes, meshes, free_count, body_count, dt);
  all->room = room;
  for (int k = 0; k < free_count; ++k) {
    meet_walls(all, p, shapes[all->frees[k].body], meshes, k, dt, piston, piston_speed);
  }
  solve_contacts(all);
}

// One work-item does it all: bodies are few. `force`: of the water on each in this step, and its
// torque about the centre [N], [N m], from what it `felt`, which begins anew. `contacts`: room for
// SPLASH_CONTACTS of each free body; `kept`: for one more than these, none at first. `friction`:
// contact.h.
kernel void move_bodies(constant FluidParams* p, float dt, float piston, float piston_speed,
                        int free_count, constant FreeBody* frees, constant BodyShape* shapes,
                        global const float* meshes, int first_body, int body_count,
                        global BodyStep* bodies, global Contact* contacts, global KeptPush* kept,
                        global const float* friction, global float* felt, global float* force) {
  if (get_global_id(0) > 0) return;
  Contacts all = {frees, bodies + first_body, contacts, kept, 0, SPLASH_CONTACTS * free_count,
                  rebound_speed(p, dt), friction, body_count};
  collide(&all, p, shapes, meshes, free_count, body_count, dt, piston, piston_speed);
  for (int k = 0; k < free_count; ++k) {
    BodyStep b = *step_of(&all, k);
    move_on(frees[k], dt, &b);
    note_reach(shapes[frees[k].body], p->support, &b);
    all.bodies[body_count + frees[k].body] = b;
  }
  for (int turn = 0; turn < PUT_APART; ++turn) {
    leave_bodies(&all, shapes, meshes, free_count, body_count, dt);
  }
  for (int k = 0; k < free_count; ++k) {
    const int body = frees[k].body;
    BodyStep b = all.bodies[body_count + body];
    leave_walls(p, shapes[body], meshes, piston, free_ways(frees[k]), &b);
    note_reach(shapes[body], p->support, &b);
    all.bodies[body_count + body] = b;
    for (int e = 6 * k; e < 6 * k + 6; ++e) {
      force[e] = felt[e] / dt;
      felt[e] = 0.0f;
    }
  }
}
