// SPDX-License-Identifier: MIT
// Health of every particle after every step, in the statistics' program. Numbers are judged by the
// bits of their exponents: no compiler may fold that away, no clamp launders it. All sums are sums
// of integers, so that atomics give them exactly, whatever their order.
// A fault is counted once for each thing that is wrong; what is not finite is nothing else.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/health/health_record.h"
#include "sim-server/fluid/health/state_sums.h"
#include "sim-server/fluid/health/stray.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/lanes/team.h"
#include "sim-server/fluid/params/fluid_params.h"

// The particles that one work-item judges at once, LANES of them.
typedef struct {
  lanes x[3], v[3], density;
  Way way;
  lane_flags here;  // lanes that hold a particle
} CheckInputs;

static lane_flags no_number(lanes a) {
  return (AS_BITS(a) & 0x7F800000u) == (lane_bits)(0x7F800000u);
}

static lane_flags not_finite(const CheckInputs* s) {
  lane_flags bad = no_number(s->density);
  for (int axis = 0; axis < 3; ++axis) bad |= no_number(s->x[axis]) | no_number(s->v[axis]);
  return bad;
}

static lane_flags outside(const CheckInputs* s, constant HealthLimits* limits) {
  lane_flags bad = 0;
  for (int axis = 0; axis < 3; ++axis) {
    bad |=
        (s->x[axis] < (lanes)(limits->lower[axis])) | (s->x[axis] > (lanes)(limits->upper[axis]));
  }
  return bad;
}

static lane_flags too_fast(const CheckInputs* s, constant HealthLimits* limits) {
  const lanes speed2 = s->v[0] * s->v[0] + s->v[1] * s->v[1] + s->v[2] * s->v[2];
  return speed2 >= (lanes)(limits->speed * limits->speed);
}

static lane_flags wrong_density(const CheckInputs* s, constant HealthLimits* limits) {
  return (s->density < (lanes)(limits->thinnest)) | (s->density > (lanes)(limits->densest));
}

// Whether LANES particles from `i` on were next to each other when the step began, as most were.
static bool were_together(global const int* source, int i, int count) {
  return i + LANES <= count && !any_lane(LOAD(source, i) != LANE_NUMBERS + source[i]);
}

// Where the particles that are now `i` and on were when the step began.
static lanes place_before(global const float* before, global const int* source, bool together,
                          int i, int count) {
  if (together) return LOAD(before, source[i]);
  float part[LANES];
  for (int lane = 0; lane < LANES; ++lane) part[lane] = before[source[min(i + lane, count - 1)]];
  return LOAD(part, 0);
}

static CheckInputs load(constant FluidParams* p, float dt, const Particles* now,
                        global const float* carried, global const float* density,
                        const Particles* was, global const int* source, int i) {
  const int n = p->capacity;
  CheckInputs s;
  const bool together = were_together(source, i, p->count);
  s.here = LANE_NUMBERS < (lane_flags)(p->count - i);
  s.density = LOAD(density, i);
  s.way.way2 = s.way.miss2 = s.way.size = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    s.x[axis] = LOAD(now->position + axis * n, i);
    s.v[axis] = LOAD(now->velocity + axis * n, i);
    const lanes before = place_before(was->position + axis * n, source, together, i, p->count);
    const lanes way = s.x[axis] - before;
    const lanes miss = way - dt * LOAD(carried + axis * n, i);
    s.way.way2 += way * way;
    s.way.miss2 += miss * miss;
    s.way.size += fabs(s.x[axis]) + fabs(before);
  }
  return s;
}

// Reports the lanes of `bad`, which are rare.
static void report_lanes(global HealthRecord* record, int check, lane_flags bad,
                         global const int* id, int i) {
  if (!any_lane(bad)) return;
  int flag[LANES];
  STORE(bad, flag, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    if (flag[lane] == 0) continue;
    atomic_inc(&record->count[check]);
    atomic_max(&record->first[check], 0x7FFFFFFF - id[i + lane]);
  }
}

// A body throws what is near it at whatever speed, and presses what has no way out.
static lane_flags but_for_bodies(lane_flags far, const Bodies* bodies,
                                 global const float* position, int n, int i) {
  if (!any_lane(far)) return far;
  int flag[LANES];
  STORE(far, flag, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    const int j = i + lane;
    if (flag[lane] != 0 && near_bodies(bodies->steps, bodies->first, bodies->count, position[j],
                                       position[n + j], position[2 * n + j])) {
      flag[lane] = 0;
    }
  }
  return LOAD(flag, 0);
}

// The lanes of `stray` that neither a wall nor a body put where they are.
static lane_flags but_for_solids(lane_flags stray, constant FluidParams* p, float dt, float piston,
                                 const Bodies* bodies, const Particles* was,
                                 global const int* source, const Particles* now,
                                 global const float* acceleration, int i) {
  if (!any_lane(stray)) return stray;
  int flag[LANES];
  STORE(stray, flag, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    if (flag[lane] == 0) continue;
    const Displacement l =
        displacement_of(p, was, source[i + lane], now, acceleration, i + lane);
    if (stopped_by_wall(p, &l, dt, piston) || put_by_body(p, bodies, &l, piston)) {
      flag[lane] = 0;
    }
  }
  return LOAD(flag, 0);
}

// A team adds its sums up before one of it reports them: all of them at once would queue for one
// record.
static void report_sums(global HealthRecord* record, const Sums* s, local uint* of_team) {
  const uint mine[4] = {bits_of(s->before) + s->known.state, bits_of(s->after) + s->known.state,
                        bits_of(s->ids_before) + s->known.ids + s->ids_known,
                        bits_of(s->ids_after) + s->known.ids};
  const int item = get_local_id(0);
  for (int k = 0; k < 4; ++k) of_team[4 * item + k] = mine[k];
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item > 0) return;
  uint sums[4] = {0, 0, 0, 0};
  for (int other = 0; other < (int)get_local_size(0); ++other) {
    for (int k = 0; k < 4; ++k) sums[k] += of_team[4 * other + k];
  }
  atomic_add(&record->before, sums[0]);
  atomic_add(&record->after, sums[1]);
  atomic_add(&record->ids_before, sums[2]);
  atomic_add(&record->ids_after, sums[3]);
}

// One work-group for each part of the particles. `checks`: a bit for each thing that is looked at.
// `before`: the arrays as they were when the step began, unsorted; `source`: where each particle
// was among those. `carried`: the velocity that took it where it is. `acceleration`: that of the
// step. `look`: at groups that rest, which `resting` knows.
kernel void check_health(constant FluidParams* p, constant HealthLimits* limits, int checks,
                         float dt, float piston, global const float* position,
                         global const float* velocity, global const float* carried,
                         global const float* acceleration, global const float* density,
                         global const int* id, global const float* position_before,
                         global const float* velocity_before, global const int* id_before,
                         global const int* source, global const int* resting, int look,
                         global Rested* rested, constant BodyShape* shapes,
                         global const float* meshes, global const BodyStep* bodies, int first_body,
                         int body_count, int slot, global HealthRecord* records) {
  local uint of_team[4 * TEAM];
  const int n = p->capacity;
  global HealthRecord* record = records + slot;
  const Particles now = {position, velocity, id};
  const Particles was = {position_before, velocity_before, id_before};
  const Bodies all = {shapes, meshes, bodies, first_body, body_count};
  Sums sums = {0, 0, 0, 0, {0, 0}, 0};
  const Share share = share_of(p->count, get_group_id(0), get_num_groups(0), LANES, LANES);
  for (int i = share.first; i < share.last; i += share.step) {
    const int rests = resting[i / LANES];
    if (rests > 1 && look == SPLASH_RESTING_UNSEEN) {
      sums.known.state += rested[i / LANES].state;
      sums.known.ids += rested[i / LANES].ids;
      continue;
    }
    const CheckInputs s = load(p, dt, &now, carried, density, &was, source, i);
    add_bits(&sums, n, i, ALL_BITS(s.here), rests, look, &now, &was, rested + i / LANES);
    lane_flags bad[SPLASH_HEALTH_CHECKS];
    bad[SPLASH_HEALTH_NOT_FINITE] = s.here & not_finite(&s);
    const lane_flags fine = s.here & (bad[SPLASH_HEALTH_NOT_FINITE] == (lane_flags)(0));
    bad[SPLASH_HEALTH_OUTSIDE] = fine & outside(&s, limits);
    bad[SPLASH_HEALTH_STRAY] = fine & strays(p, &s.way);
    bad[SPLASH_HEALTH_SPEED] = fine & too_fast(&s, limits);
    bad[SPLASH_HEALTH_DENSITY] = fine & wrong_density(&s, limits);
    lane_flags any = 0;
    for (int check = 0; check < SPLASH_HEALTH_CHECKS; ++check) any |= bad[check];
    if (!any_lane(any)) continue;
    bad[SPLASH_HEALTH_STRAY] = but_for_solids(bad[SPLASH_HEALTH_STRAY], p, dt, piston, &all, &was,
                                              source, &now, acceleration, i);
    for (int check = SPLASH_HEALTH_SPEED; check < SPLASH_HEALTH_CHECKS; ++check) {
      bad[check] = but_for_bodies(bad[check], &all, position, n, i);
    }
    for (int check = 0; check < SPLASH_HEALTH_CHECKS; ++check) {
      if (checks & (1 << check)) report_lanes(record, check, bad[check], id, i);
    }
  }
  report_sums(record, &sums, of_team);
}
