// SPDX-License-Identifier: MIT
// No particle stays inside a free body or passes through it (keep_out.h): one that is too deep is
// put back, and its motion into the body ends, as in a collision without rebound. It then moves
// along with the body's face, so it yields by all of the body's change in that direction
// (body_reach.h with g_i = out, b_i = 1 and a_i the change of its speed), and the collision of all
// that were too deep with the body conserves momentum and angular momentum.
// Written over what body_reach.cl found, which has been answered.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/boundary/keep_out.h"
#include "sim-server/fluid/free_bodies/body_reach.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

typedef struct {
  float before[3][LANES], place[3][LANES], speed[3][LANES];
} Crowd;

static bool leave_free_body(constant FluidParams* p, BodyShape shape, global const float* meshes,
                            BodyStep b, int here, Crowd* crowd, Reach* r) {
  float out_of[3][LANES], stop[LANES];
  bool any = false;
  for (int lane = 0; lane < LANES; ++lane) {
    const float3 from =
        (float3)(crowd->before[0][lane], crowd->before[1][lane], crowd->before[2][lane]);
    float3 at = (float3)(crowd->place[0][lane], crowd->place[1][lane], crowd->place[2][lane]);
    float3 moving = (float3)(crowd->speed[0][lane], crowd->speed[1][lane], crowd->speed[2][lane]);
    float3 out = (float3)(0.0f, 0.0f, 0.0f);
    float stopped = 0.0f;
    const bool caught =
        lane < here && leave_body(p, shape, meshes, b, from, &at, &moving, &out, &stopped);
    any |= caught;
    stop[lane] = caught ? stopped : 0.0f;
    const float3 normal = stop[lane] > 0.0f ? out : (float3)(0.0f, 0.0f, 0.0f);
    out_of[0][lane] = normal.x;
    out_of[1][lane] = normal.y;
    out_of[2][lane] = normal.z;
    crowd->place[0][lane] = at.x;
    crowd->place[1][lane] = at.y;
    crowd->place[2][lane] = at.z;
    crowd->speed[0][lane] = moving.x;
    crowd->speed[1][lane] = moving.y;
    crowd->speed[2][lane] = moving.z;
  }
  r->gx = LOAD(out_of[0], 0);
  r->gy = LOAD(out_of[1], 0);
  r->gz = LOAD(out_of[2], 0);
  const lanes stopped = LOAD(stop, 0);
  r->ax = stopped * r->gx;
  r->ay = stopped * r->gy;
  r->az = stopped * r->gz;
  r->rub = 0.0f;
  r->yield = 1.0f;
  return any;
}

// `position_before`: as it was when the step began, unsorted; `source`: where each was among those.
static void load_crowd(constant FluidParams* p, global const float* position,
                       global const float* velocity, global const float* position_before,
                       global const int* source, int i, Crowd* crowd) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int lane = 0; lane < LANES; ++lane) {
      const int before = source[min(i + lane, p->count - 1)];
      crowd->before[axis][lane] = position_before[axis * p->capacity + before];
    }
    STORE(LOAD(position + axis * p->capacity, i), crowd->place[axis], 0);
    STORE(LOAD(velocity + axis * p->capacity, i), crowd->speed[axis], 0);
  }
}

static void store_crowd(constant FluidParams* p, float piston, float piston_speed,
                        const Crowd* crowd, int i, global float* position,
                        global float* velocity) {
  const int n = p->capacity;
  lanes x = LOAD(crowd->place[0], 0), y = LOAD(crowd->place[1], 0), z = LOAD(crowd->place[2], 0);
  lanes u = LOAD(crowd->speed[0], 0), v = LOAD(crowd->speed[1], 0), w = LOAD(crowd->speed[2], 0);
  keep_in_tank(p, piston, piston_speed, &x, &y, &z, &u, &v, &w);
  STORE(x, position, i);
  STORE(y, position + n, i);
  STORE(z, position + 2 * n, i);
  STORE(u, velocity, i);
  STORE(v, velocity + n, i);
  STORE(w, velocity + 2 * n, i);
}

// One work-item for each group of particles, after they have moved.
kernel void keep_out_of_free(constant FluidParams* p, float dt, float piston, float piston_speed,
                             int free_count, constant FreeBody* frees, constant BodyShape* shapes,
                             global const float* meshes, global const BodyStep* bodies,
                             int first_body, global const float* position_before,
                             global const int* source, global float* position,
                             global float* velocity, global float* reach, global int* reached) {
  const int groups = group_count(p);
  const int group = get_global_id(0);
  if (group >= groups) return;
  const int n = p->capacity, i = group * LANES;
  const int here = min(p->count - i, LANES);
  const lane_flags mine = LANE_NUMBERS < (lane_flags)(here);
  const lanes far = FAR_AWAY;
  float3 lower, upper;
  const lanes x = LOAD(position, i), y = LOAD(position + n, i), z = LOAD(position + 2 * n, i);
  lower = (float3)(least(select(far, x, mine)), least(select(far, y, mine)),
                   least(select(far, z, mine)));
  upper = (float3)(most(select(-far, x, mine)), most(select(-far, y, mine)),
                   most(select(-far, z, mine)));
  lower -= dt * p->speed_limit;  // no particle came from farther away
  upper += dt * p->speed_limit;
  Crowd crowd;
  bool moved = false;
  for (int k = 0; k < free_count; ++k) {
    reached[k * groups + group] = 0;
    const int body = frees[k].body;
    if (!bodies_near_box(bodies, first_body + body, 1, lower, upper)) continue;
    if (!moved) load_crowd(p, position, velocity, position_before, source, i, &crowd);
    Reach r;
    if (!leave_free_body(p, shapes[body], meshes, bodies[first_body + body], here, &crowd, &r)) {
      continue;
    }
    moved = true;
    reached[k * groups + group] = 1;
    store_reach(p, reach, k, i, &r);
  }
  if (moved) store_crowd(p, piston, piston_speed, &crowd, i, position, velocity);
}
