// SPDX-License-Identifier: MIT
// Health of every particle after every step, in the survey's program, which is built without
// relaxed mathematics. Numbers are judged by the bits of their exponents: no compiler may fold that
// away, no clamp launders it. All sums are sums of integers, so that atomics give them exactly,
// whatever their order.
// A fault is counted once for each thing that is wrong; what is not finite is nothing else.

typedef struct {
  float lower[3];  // box that holds the water [m]
  float upper[3];
  float speed;     // nothing is this fast or faster [m/s]
  float way;       // nothing gets farther in one step, but out of a body's way [m]
  float thinnest;  // density [kg/m3]
  float densest;
} HealthLimits;

// In the order of sim-server/fluid/health.hpp.
#define HEALTH_NOT_FINITE 0
#define HEALTH_OUTSIDE 1
#define HEALTH_JUMP 2
#define HEALTH_SPEED 3
#define HEALTH_DENSITY 4
#define HEALTH_CHECKS 5

typedef struct {
  int count[HEALTH_CHECKS];  // particles
  int first[HEALTH_CHECKS];  // 2^31 - 1 less the smallest id among them, 0: none
  uint before, after;        // sums of the state's bits at the step's ends
  uint ids_before, ids_after;
} HealthRecord;

#if LANES == 16
typedef uint16 lane_bits;
#define AS_BITS(x) as_uint16(x)
#define ALL_BITS(flags) as_uint16(flags)
#define LOAD_BITS(array, index) as_uint16(vload16(0, (array) + (index)))
#elif LANES == 8
typedef uint8 lane_bits;
#define AS_BITS(x) as_uint8(x)
#define ALL_BITS(flags) as_uint8(flags)
#define LOAD_BITS(array, index) as_uint8(vload8(0, (array) + (index)))
#else
typedef uint lane_bits;
#define AS_BITS(x) as_uint(x)
#define ALL_BITS(flags) ((flags) ? 0xFFFFFFFFu : 0u)
#define LOAD_BITS(array, index) as_uint((array)[index])
#endif

// The particles that one work-item judges at once, LANES of them.
typedef struct {
  lanes x[3], v[3], density;
  lanes way2;        // squared way since the step began [m2]
  lane_flags here;   // lanes that hold a particle
} Patients;

static lane_flags no_number(lanes a) {
  return (AS_BITS(a) & 0x7F800000u) == (lane_bits)(0x7F800000u);
}

static lane_flags not_finite(const Patients* s) {
  lane_flags bad = no_number(s->density);
  for (int axis = 0; axis < 3; ++axis) bad |= no_number(s->x[axis]) | no_number(s->v[axis]);
  return bad;
}

static lane_flags outside(const Patients* s, constant HealthLimits* limits) {
  lane_flags bad = 0;
  for (int axis = 0; axis < 3; ++axis) {
    bad |= (s->x[axis] < (lanes)(limits->lower[axis])) |
           (s->x[axis] > (lanes)(limits->upper[axis]));
  }
  return bad;
}

static lane_flags too_fast(const Patients* s, constant HealthLimits* limits) {
  const lanes speed2 = s->v[0] * s->v[0] + s->v[1] * s->v[1] + s->v[2] * s->v[2];
  return speed2 >= (lanes)(limits->speed * limits->speed);
}

static lane_flags wrong_density(const Patients* s, constant HealthLimits* limits) {
  return (s->density < (lanes)(limits->thinnest)) | (s->density > (lanes)(limits->densest));
}

// Where the particles that are now `i` and on were when the step began.
static lanes place_before(global const float* before, global const int* source, int i, int count) {
  float part[LANES];
  for (int lane = 0; lane < LANES; ++lane) part[lane] = before[source[min(i + lane, count - 1)]];
  return LOAD(part, 0);
}

static Patients load(constant FluidParams* p, global const float* position,
                     global const float* velocity, global const float* density,
                     global const float* before, global const int* source, int i) {
  const int n = p->capacity;
  Patients s;
  s.here = LANE_NUMBERS < (lane_flags)(p->count - i);
  s.density = LOAD(density, i);
  s.way2 = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    s.x[axis] = LOAD(position + axis * n, i);
    s.v[axis] = LOAD(velocity + axis * n, i);
    const lanes way = s.x[axis] - place_before(before + axis * n, source, i, p->count);
    s.way2 += way * way;
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

// A body that appears in the water, cuts through it or pinches it pushes aside what was there, at
// whatever speed, and presses what has no way out.
static lane_flags but_for_bodies(lane_flags far, global const BodyStep* bodies, int first_body,
                                 int body_count, global const float* position, int n, int i) {
  if (!any_lane(far)) return far;
  int flag[LANES];
  STORE(far, flag, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    const int j = i + lane;
    if (flag[lane] != 0 && near_bodies(bodies, first_body, body_count, position[j],
                                       position[n + j], position[2 * n + j])) {
      flag[lane] = 0;
    }
  }
  return LOAD(flag, 0);
}

static uint bits_of(lane_bits a) {
  uint part[LANES], sum = 0;
  STORE(a, part, 0);
  for (int lane = 0; lane < LANES; ++lane) sum += part[lane];
  return sum;
}

// Sum of the bits of LANES particles' places and speeds, and of numbers made of their ids.
static lane_bits state_bits(global const float* position, global const float* velocity, int n,
                            int i) {
  lane_bits sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    sum += LOAD_BITS(position + axis * n, i) + 3u * LOAD_BITS(velocity + axis * n, i);
  }
  return sum;
}

static lane_bits id_bits(global const int* id, int i) {
  const lane_bits a = LOAD_BITS(id, i) + 1u;
  return a * a * 2654435761u;  // a lost particle and a doubled one do not make up for each other
}

// `checks`: a bit for each thing that is looked at. `before`: the arrays as they were when the step
// began, unsorted.
kernel void check_health(constant FluidParams* p, constant HealthLimits* limits, int checks,
                         int parts, global const float* position, global const float* velocity,
                         global const float* density, global const int* id,
                         global const float* position_before,
                         global const float* velocity_before, global const int* id_before,
                         global const int* source, global const BodyStep* bodies, int first_body,
                         int body_count, int slot, global HealthRecord* records) {
  const int part = get_global_id(0);
  if (part >= parts) return;
  const int n = p->capacity;
  global HealthRecord* record = records + slot;
  lane_bits before = 0, after = 0, ids_before = 0, ids_after = 0;
#if LANES > 1  // each work-item its own stretch, in whole vectors
  const int size = ((p->count + parts - 1) / parts + LANES - 1) / LANES * LANES;
  const int stride = LANES, begin = part * size, end = min(begin + size, p->count);
#else
  const int stride = parts, begin = part, end = p->count;
#endif
  for (int i = begin; i < end; i += stride) {
    const Patients s = load(p, position, velocity, density, position_before, source, i);
    const lane_bits mine = ALL_BITS(s.here);
    before += mine & state_bits(position_before, velocity_before, n, i);
    after += mine & state_bits(position, velocity, n, i);
    ids_before += mine & id_bits(id_before, i);
    ids_after += mine & id_bits(id, i);
    lane_flags bad[HEALTH_CHECKS];
    bad[HEALTH_NOT_FINITE] = s.here & not_finite(&s);
    const lane_flags fine = s.here & (bad[HEALTH_NOT_FINITE] == (lane_flags)(0));
    bad[HEALTH_OUTSIDE] = fine & outside(&s, limits);
    bad[HEALTH_JUMP] = fine & (s.way2 > (lanes)(limits->way * limits->way));
    bad[HEALTH_SPEED] = fine & too_fast(&s, limits);
    bad[HEALTH_DENSITY] = fine & wrong_density(&s, limits);
    lane_flags any = 0;
    for (int check = 0; check < HEALTH_CHECKS; ++check) any |= bad[check];
    if (!any_lane(any)) continue;
    for (int check = HEALTH_JUMP; check < HEALTH_CHECKS; ++check) {
      bad[check] = but_for_bodies(bad[check], bodies, first_body, body_count, position, n, i);
    }
    for (int check = 0; check < HEALTH_CHECKS; ++check) {
      if (checks & (1 << check)) report_lanes(record, check, bad[check], id, i);
    }
  }
  atomic_add(&record->before, bits_of(before));
  atomic_add(&record->after, bits_of(after));
  atomic_add(&record->ids_before, bits_of(ids_before));
  atomic_add(&record->ids_after, bits_of(ids_after));
}
