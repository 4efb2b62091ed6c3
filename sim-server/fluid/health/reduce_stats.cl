// SPDX-License-Identifier: MIT
// Health and limits of the whole fluid, once a frame: only of finite numbers is the difference to
// themselves zero.

#include "sim-server/fluid/health/health_record.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/lanes/team.h"
#include "sim-server/fluid/params/fluid_params.h"

// The sums of one part of the fluid, lane by lane.
typedef struct {
  lanes speed2, acceleration2, excess_sum, excess_max, runaway, asleep;
  lanes lower[3], upper[3];
} Tally;

// Adds the particles of the lanes that are `here`; returns those that are no numbers.
static lane_flags accumulate(constant FluidParams* p, global const float* position,
                             global const float* velocity, global const float* acceleration,
                             global const float* density, global const int* moving, int i,
                             lane_flags here, Tally* t) {
  const int n = p->capacity;
  lanes speed2 = 0.0f, acceleration2 = 0.0f;
  lanes doubt = LOAD(density, i) - LOAD(density, i);
  for (int axis = 0; axis < 3; ++axis) {
    const lanes x = LOAD(position + axis * n, i);
    const lanes v = LOAD(velocity + axis * n, i);
    const lanes a = LOAD(acceleration + axis * n, i);
    doubt += (x - x) + (v - v) + (a - a);
    speed2 += v * v;
    acceleration2 += a * a;
  }
  const lanes none = 0.0f, one = 1.0f;
  const lane_flags fine = here & (doubt == none);
  for (int axis = 0; axis < 3; ++axis) {
    const lanes x = LOAD(position + axis * n, i);
    t->lower[axis] = fmin(t->lower[axis], select((lanes)(FAR_AWAY), x, fine));
    t->upper[axis] = fmax(t->upper[axis], select((lanes)(-FAR_AWAY), x, fine));
  }
  const lanes excess = select(none, fmax(LOAD(density, i) / p->rest_density - 1.0f, 0.0f), fine);
  t->speed2 = fmax(t->speed2, select(none, speed2, fine));
  t->acceleration2 = fmax(t->acceleration2, select(none, acceleration2, fine));
  t->excess_sum += excess;
  t->excess_max = fmax(t->excess_max, excess);
  t->runaway +=
      select(none, one, fine & (speed2 >= (lanes)(0.98f * p->speed_limit * p->speed_limit)));
  t->asleep += select(none, one, fine & (LOAD(moving, i) == 0));
  return here & (doubt != none);
}

static void join(FluidStatsPart* sum, FluidStatsPart other) {
  sum->speed2 = fmax(sum->speed2, other.speed2);
  sum->acceleration2 = fmax(sum->acceleration2, other.acceleration2);
  sum->excess_sum += other.excess_sum;
  sum->excess_max = fmax(sum->excess_max, other.excess_max);
  sum->not_finite += other.not_finite;
  sum->first_bad = min(sum->first_bad, other.first_bad);
  sum->runaway += other.runaway;
  sum->asleep += other.asleep;
  for (int axis = 0; axis < 3; ++axis) {
    sum->lower[axis] = fmin(sum->lower[axis], other.lower[axis]);
    sum->upper[axis] = fmax(sum->upper[axis], other.upper[axis]);
  }
}

// One work-group for each part.
kernel void reduce_stats(constant FluidParams* p, global const float* position,
                         global const float* velocity, global const float* acceleration,
                         global const float* density, global const int* id,
                         global const int* moving, global FluidStatsPart* out) {
  local FluidStatsPart of_team[TEAM];
  const int part = get_group_id(0), item = get_local_id(0);
  Tally t = {0.0f,
             0.0f,
             0.0f,
             0.0f,
             0.0f,
             0.0f,
             {FAR_AWAY, FAR_AWAY, FAR_AWAY},
             {-FAR_AWAY, -FAR_AWAY, -FAR_AWAY}};
  int bad = 0, first_bad = 0x7FFFFFFF;
  const Share share = share_of(p->count, part, get_num_groups(0), 1, LANES);
  for (int i = share.first; i < share.last; i += share.step) {
    const lane_flags here = LANE_NUMBERS < (lane_flags)(share.last - i);
    const lane_flags wrong =
        accumulate(p, position, velocity, acceleration, density, moving, i, here, &t);
    if (!any_lane(wrong)) continue;
    int flag[LANES];
    STORE(wrong, flag, 0);
    for (int lane = 0; lane < LANES; ++lane) {
      if (flag[lane] == 0) continue;
      ++bad;
      first_bad = min(first_bad, id[i + lane]);
    }
  }
  FluidStatsPart s = {most(t.speed2),
                      most(t.acceleration2),
                      total(t.excess_sum),
                      most(t.excess_max),
                      bad,
                      first_bad,
                      (int)total(t.runaway),
                      (int)total(t.asleep),
                      {least(t.lower[0]), least(t.lower[1]), least(t.lower[2])},
                      {most(t.upper[0]), most(t.upper[1]), most(t.upper[2])}};
  of_team[item] = s;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item > 0) return;
  for (int k = 1; k < (int)get_local_size(0); ++k) join(&s, of_team[k]);
  out[part] = s;
}
