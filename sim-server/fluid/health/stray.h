// SPDX-License-Identifier: MIT
// Whether a particle is where its motion took it. A step moves it by dt v', v' its speed at the
// step's end (pressure/integrate.cl) or what else the solver says carried it, to within the
// rounding of its coordinates; what sleeps stays.
// Two more may be elsewhere, and are where that puts them: what a wall stopped touches the wall, no
// farther off than dt times the speed that ended there, |v| + dt |a|; what a body pushed out of
// itself is at the depth that it is put back to (boundary/keep_out.h).

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/keep_out.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/health/state_sums.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

#define STRAY_ROUNDING 4.8e-7f  // four units in a float's last place [1]

typedef struct {
  lanes way2;   // squared, since the step began [m2]
  lanes miss2;  // squared, between that and dt v' [m2]
  lanes size;   // sum of all coordinates, which rounding is in proportion to [m]
} Way;

static lane_flags strays(constant FluidParams* p, const Way* w) {
  const lanes rounding = STRAY_ROUNDING * (w->size + p->spacing);
  return (w->way2 > (lanes)(0.0f)) & (w->miss2 > rounding * rounding);
}

// What one particle did in a step.
typedef struct {
  float3 from, to;           // [m]
  float3 speed_from, speed;  // [m/s]
  float3 push;               // acceleration [m/s2]
  float rounding;            // of its coordinates [m]
} Displacement;

static float3 vector_of(global const float* array, int n, int i) {
  return (float3)(array[i], array[n + i], array[2 * n + i]);
}

static Displacement displacement_of(constant FluidParams* p, const Particles* was, int before,
                                    const Particles* now, global const float* acceleration,
                                    int i) {
  const int n = p->capacity;
  Displacement l;
  l.from = vector_of(was->position, n, before);
  l.to = vector_of(now->position, n, i);
  l.speed_from = vector_of(was->velocity, n, before);
  l.speed = vector_of(now->velocity, n, i);
  l.push = vector_of(acceleration, n, i);
  const float3 size = fabs(l.from) + fabs(l.to);
  l.rounding = STRAY_ROUNDING * (size.x + size.y + size.z + p->spacing);
  return l;
}

static bool touches_wall(constant FluidParams* p, const Displacement* l, float piston) {
  for (int k = 0; k < p->wall_count; ++k) {
    const float3 normal = (float3)(p->walls[k].nx, p->walls[k].ny, p->walls[k].nz);
    const float offset = p->walls[k].offset + (k == p->piston ? piston : 0.0f);
    const float off = dot(normal, l->to) - offset - KEPT_OFF_WALLS * p->spacing;
    if (fabs(off) <= l->rounding + STRAY_ROUNDING * fabs(offset)) return true;
  }
  return false;
}

static bool stopped_by_wall(constant FluidParams* p, const Displacement* l, float dt,
                            float piston) {
  const float miss = length(l->to - l->from - dt * l->speed);
  const float stopped = dt * (length(l->speed_from) + dt * length(l->push));
  return miss <= stopped + l->rounding && touches_wall(p, l, piston);
}

// A body that appears in the water, cuts through it or pinches it puts what was there to its skin,
// however far that is, or against a wall behind that.
static bool put_by_body(constant FluidParams* p, const Bodies* bodies, const Displacement* l,
                        float piston) {
  for (int k = 0; k < bodies->count; ++k) {
    const BodyStep b = bodies->steps[bodies->first + k];
    const float3 arm = l->to - (float3)(b.px, b.py, b.pz);
    float3 out;
    const float size = size_of(b);
    const float depth = size * depth_inside(bodies->shapes[k], bodies->meshes,
                                            rotate_by(arm, -b.qx, -b.qy, -b.qz, b.qw) / size, &out);
    if (fabs(depth - KEPT_DEPTH * p->spacing) <= 1.0e-3f * p->spacing + l->rounding) return true;
  }
  return near_bodies(bodies->steps, bodies->first, bodies->count, l->to.x, l->to.y, l->to.z) &&
         touches_wall(p, l, piston);
}
