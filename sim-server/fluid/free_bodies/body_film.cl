// SPDX-License-Identifier: MIT
// The film of water between a free body and a wall or another body that it touches or nearly
// touches. Particles do not fit in there, and without them the body would lack the pressure that
// carries it: a ball on the floor felt 18 % of its buoyancy. Solids touch in points only, so water
// is there, and where it hardly flows its pressure is that of its rim, but for the weight of the
// water in between:
//   p(x) = max(p0 + rho0 g . (x - c), 0)
// with c the body's centre. The body's surface is closed, so what p does to all of it is known, and
// what the particles do of that, too, with their areas A_i = m g_i / rho_i^2 (body_reach.h). The
// film does the rest, and takes back what particles between the solids do besides, which carry what
// those carry that are missing, by pressures that no water has:
//   F = - sum_s p(x_s) A_s - sum_i (p(x_i) + w_i (p_i - p(x_i))) A_i
// with A_s the faces of the body's skin, outwards, and w_i whether a particle is between: 1 where
// the solids' normals n, n' there face each other (n . n' < -1/2) and are two spacings apart or
// less, falling to 0 at right angles and three spacings.
// Particles next to a body are up to a fifth above the water's own pressure, all around it. So p0
// is what makes the others, together, push as p does: the p0 of the least
//   |sum_i (1 - w_i) (p_i - p(x_i)) A_i|^2
// and their mean where they have no direction together. It follows them in FILM_FOLLOWS seconds:
// what is faster, as the push of water that the body drives away, the body feels. So water at rest
// carries a body by the weight of what it displaces, wherever particles are missing.
// The film grows with 2 - gap / spacing between one and two spacings, and is full below: a layer of
// particles fits in there. A body that is mostly dry where p says that it is wet has none: below
// a quarter of the area, in full above half of it.
// What a film does to one solid, it does to the other: walls and bodies that go their way take it;
// free bodies that touch only each other share what is left of their sum.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/free_bodies/body_film.h"
#include "sim-server/fluid/free_bodies/body_reach.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

#define FILM_GAP 2.0f        // of the widest film [spacings]
#define LEAST 0.01f          // what those between the solids count where there are no others [1]
#define NO_DIRECTION 0.003f  // square of the share of the areas that is no direction [1]
#define FILM_FOLLOWS 0.1f    // [s]

#define FILM_HELD 0     // distance from walls and bodies that go their way [m]
#define FILM_NEXT 1     // distance from other free bodies [m]
#define FILM_AREA 2     // sum of 1 - w_i times |A_i|; then of this times p_i - rho0 g . (x_i - c)
#define FILM_TOWARDS 4  // sum of 1 - w_i times A_i, three parts; then of this times that

#define FILM_WET 6    // sum of |A_i| [m2]
#define FILM_BELOW 7  // of |A_s| where p > 0 and no solid is near [m2]

// What a group of particles is to a body beside it.
typedef struct {
  Lever area, arm;  // A_i [m2]; from the body's centre [m]
  lanes size;       // |A_i| [m2]
  lanes pressure;   // p_i [Pa]
  lanes between;    // w_i [1]
} Beside;

// Of the particles from `i` on, whose reach of the free body `k`, the scene's `body`, is known.
static Beside beside(constant FluidParams* p, float piston, const Bodies* bodies, int body,
                     global const float* position, global const float* density,
                     global const float* pressure, global float* reach, int k, int i) {
  global const BodyStep* steps = bodies->steps + bodies->first;
  const int n = p->capacity;
  const Reach r = load_reach(p, reach, k, i);
  const lanes rho = LOAD(density, i);
  const lanes x = LOAD(position, i), y = LOAD(position + n, i), z = LOAD(position + 2 * n, i);
  const Gap gap = gap_at(p, piston, bodies, body, x, y, z);
  const BodyFace own =
      nearest_face(bodies->shapes + body, bodies->meshes, steps + body, 0, 1, x, y, z);
  Beside w;
  w.area = areas_of(p, &r, rho);
  w.arm = lever_of(p, position, steps[body], i);
  w.size = length_of(w.area.x, w.area.y, w.area.z);
  w.pressure = LOAD(pressure, i) * rho * rho;
  w.between = between(p, &own, &gap);
  return w;
}

// One work-item for each free body and part of its skin and of the water: how far it is from other
// solids, and what the rim's pressure is.
kernel void measure_rims(constant FluidParams* p, float piston, int free_count,
                         constant FreeBody* frees, constant BodyShape* shapes,
                         global const float* meshes, global const BodyStep* steps, int first_body,
                         int body_count, global const float* skin, global const int* skin_from,
                         int skin_stride, global const float* position, global const float* density,
                         global const float* pressure, global float* reach,
                         global const int* reached, global float* rims) {
  const int item = get_global_id(0);
  if (item >= free_count * SPLASH_PUSH_PARTS) return;
  const int k = item / SPLASH_PUSH_PARTS, part = item % SPLASH_PUSH_PARTS;
  const int body = frees[k].body;
  const Bodies bodies = {shapes, meshes, steps, first_body, body_count};
  const BodyStep b = steps[first_body + body];
  Gap nearest = {FAR_AWAY, FAR_AWAY, 0.0f, 0.0f, 0.0f};
  lanes sum[SPLASH_RIM_ENTRIES];
  for (int e = 0; e < SPLASH_RIM_ENTRIES; ++e) sum[e] = 0.0f;
  if (has_neighbour(p, piston, &bodies, body)) {
    for (int i = skin_from[k] + part * LANES; i < skin_from[k + 1];
         i += SPLASH_PUSH_PARTS * LANES) {
      const Skin s = load_skin(skin, skin_stride, b, i);
      const Gap gap = gap_at(p, piston, &bodies, body, b.px + s.x, b.py + s.y, b.pz + s.z);
      nearest.held = fmin(nearest.held, gap.held);
      nearest.next = fmin(nearest.next, gap.next);
    }
    const float3 weight = weight_at(p, b);
    const int groups = group_count(p);
    for (int group = part; group < groups; group += SPLASH_PUSH_PARTS) {
      if (!reached[k * groups + group]) continue;
      const Beside w = beside(p, piston, &bodies, body, position, density, pressure, reach, k,
                              group * LANES);
      const lanes none = 0.0f;
      const lanes counts = select(none, fmax(1.0f - w.between, LEAST), w.size > none);
      const lanes level =
          select(none, w.pressure - (weight.x * w.arm.x + weight.y * w.arm.y + weight.z * w.arm.z),
                 w.size > none);
      const lanes counted[4] = {counts * w.size, counts * w.area.x, counts * w.area.y,
                             counts * w.area.z};
      sum[FILM_AREA] += counted[0];
      sum[FILM_AREA + 1] += level * counted[0];
      for (int axis = 0; axis < 3; ++axis) {
        sum[FILM_TOWARDS + axis] += counted[1 + axis];
        sum[FILM_TOWARDS + 3 + axis] += level * counted[1 + axis];
      }
    }
  }
  rims += item * SPLASH_RIM_ENTRIES;
  rims[FILM_HELD] = least(nearest.held);
  rims[FILM_NEXT] = least(nearest.next);
  for (int e = FILM_AREA; e < SPLASH_RIM_ENTRIES; ++e) rims[e] = total(sum[e]);
}

// What measure_rims found of one body.
typedef struct {
  float held, next;  // [m]
  float share;       // of a full film [1]
  float p0;          // at the body's centre [Pa]
} Film;

// `kept`: p0 of the step before, and whether there was a film.
static Film film_of(constant FluidParams* p, float dt, global const float* rims,
                    global const float* kept, int k) {
  Film film = {FAR_AWAY, FAR_AWAY, 0.0f, 0.0f};
  float sum[SPLASH_RIM_ENTRIES];
  for (int e = FILM_AREA; e < SPLASH_RIM_ENTRIES; ++e) sum[e] = 0.0f;
  rims += k * SPLASH_PUSH_PARTS * SPLASH_RIM_ENTRIES;
  for (int part = 0; part < SPLASH_PUSH_PARTS; ++part, rims += SPLASH_RIM_ENTRIES) {
    film.held = fmin(film.held, rims[FILM_HELD]);
    film.next = fmin(film.next, rims[FILM_NEXT]);
    for (int e = FILM_AREA; e < SPLASH_RIM_ENTRIES; ++e) sum[e] += rims[e];
  }
  const float area = sum[FILM_AREA];
  if (!(area > 0.0f)) return film;
  film.share = clamp(FILM_GAP - fmin(film.held, film.next) / p->spacing, 0.0f, 1.0f);
  const float3 towards = vload3(0, sum + FILM_TOWARDS), pushed = vload3(1, sum + FILM_TOWARDS);
  film.p0 = (dot(towards, pushed) + NO_DIRECTION * area * sum[FILM_AREA + 1]) /
            (dot(towards, towards) + NO_DIRECTION * area * area);
  if (kept[2 * k + 1] > 0.0f) {
    film.p0 = mix(kept[2 * k], film.p0, fmin(dt / FILM_FOLLOWS, 1.0f));
  }
  return film;
}

typedef struct {
  lanes of[SPLASH_FILM_ENTRIES];
} FilmSum;

static lanes pressure_at(const Film* film, float3 weight, Lever arm) {
  return fmax(film->p0 + weight.x * arm.x + weight.y * arm.y + weight.z * arm.z, 0.0f);
}

// Adds what a pressure does to faces of these areas.
static void press(lanes p, Lever arm, Lever area, lane_flags mine, FilmSum* sum) {
  const lanes none = 0.0f;
  const lanes fx = select(none, -p * area.x, mine), fy = select(none, -p * area.y, mine),
              fz = select(none, -p * area.z, mine);
  sum->of[0] += fx;
  sum->of[1] += fy;
  sum->of[2] += fz;
  sum->of[3] += select(none, arm.y * fz - arm.z * fy, mine);
  sum->of[4] += select(none, arm.z * fx - arm.x * fz, mine);
  sum->of[5] += select(none, arm.x * fy - arm.y * fx, mine);
}

// One work-item for each free body and part: F and its torque about the centre, and the areas.
kernel void press_films(constant FluidParams* p, float dt, float piston, int free_count,
                        constant FreeBody* frees, constant BodyShape* shapes,
                        global const float* meshes, global const BodyStep* steps, int first_body,
                        int body_count, global const float* skin, global const int* skin_from,
                        int skin_stride, global const float* position, global const float* density,
                        global const float* pressure, global float* reach,
                        global const int* reached, global const float* rims,
                        global const float* kept, global float* parts) {
  const int item = get_global_id(0);
  if (item >= free_count * SPLASH_PUSH_PARTS) return;
  const int k = item / SPLASH_PUSH_PARTS, part = item % SPLASH_PUSH_PARTS;
  const int body = frees[k].body;
  const Bodies bodies = {shapes, meshes, steps, first_body, body_count};
  const BodyStep b = steps[first_body + body];
  const Film film = film_of(p, dt, rims, kept, k);
  if (!(film.share > 0.0f)) return;
  const float3 weight = weight_at(p, b);
  FilmSum sum;
  for (int e = 0; e < SPLASH_FILM_ENTRIES; ++e) sum.of[e] = 0.0f;
  for (int i = skin_from[k] + part * LANES; i < skin_from[k + 1]; i += SPLASH_PUSH_PARTS * LANES) {
    const Skin s = load_skin(skin, skin_stride, b, i);
    const Lever arm = {s.x, s.y, s.z}, area = {s.ax, s.ay, s.az};
    const lanes level = pressure_at(&film, weight, arm);
    press(level, arm, area, (lane_flags)(-1), &sum);
    const Gap gap = gap_at(p, piston, &bodies, body, b.px + s.x, b.py + s.y, b.pz + s.z);
    const lanes open = clamp(fmin(gap.held, gap.next) / p->spacing, 0.0f, 1.0f);
    sum.of[FILM_BELOW] += select((lanes)(0.0f), open * length_of(s.ax, s.ay, s.az), level > 0.0f);
  }
  const int groups = group_count(p);
  for (int group = part; group < groups; group += SPLASH_PUSH_PARTS) {
    if (!reached[k * groups + group]) continue;
    const Beside w =
        beside(p, piston, &bodies, body, position, density, pressure, reach, k, group * LANES);
    const lanes level = pressure_at(&film, weight, w.arm);
    press(level + w.between * (w.pressure - level), w.arm, w.area, w.size > 0.0f, &sum);
    sum.of[FILM_WET] += w.size;
  }
  for (int e = 0; e < SPLASH_FILM_ENTRIES; ++e) {
    parts[item * SPLASH_FILM_ENTRIES + e] = total(sum.of[e]);
  }
}

// The film's push on one body, by all its parts: none where most of it is dry.
static void sum_film(const Film* film, global const float* parts, int k, global float* push) {
  float sum[SPLASH_FILM_ENTRIES];
  parts += k * SPLASH_PUSH_PARTS * SPLASH_FILM_ENTRIES;
  for (int e = 0; e < SPLASH_FILM_ENTRIES; ++e) {
    sum[e] = 0.0f;
    for (int part = 0; film->share > 0.0f && part < SPLASH_PUSH_PARTS; ++part) {
      sum[e] += parts[part * SPLASH_FILM_ENTRIES + e];
    }
  }
  const float wet = sum[FILM_BELOW] > 0.0f ? sum[FILM_WET] / sum[FILM_BELOW] : 0.0f;
  const float share = film->share * clamp(4.0f * wet - 1.0f, 0.0f, 1.0f);
  for (int e = 0; e < 6; ++e) push[6 * k + e] = share * sum[e];
}

static bool is_pushed(global const float* push, int k) {
  for (int e = 0; e < 6; ++e) {
    if (push[6 * k + e] != 0.0f) return true;
  }
  return false;
}

// Lists the bodies with a film that touch each other, `first` among them; their number. `listed`:
// of each free body, whether it is in any list.
static int list_group(constant FreeBody* frees, global const BodyStep* bodies, int free_count,
                      global const float* push, int first, global int* listed, global int* list) {
  int count = 1;
  list[0] = first;
  listed[first] = 1;
  for (int at = 0; at < count; ++at) {
    const BodyStep one = bodies[frees[list[at]].body];
    for (int k = 0; k < free_count; ++k) {
      if (listed[k] || !is_pushed(push, k) || !reaches_meet(one, bodies[frees[k].body])) continue;
      listed[k] = 1;
      list[count++] = k;
    }
  }
  return count;
}

// Takes equal parts of what these bodies have together from each of them.
static void balance_group(constant FreeBody* frees, global const BodyStep* bodies, int count,
                          global const int* list, global float* push) {
  float3 force = (float3)(0.0f), torque = (float3)(0.0f);
  for (int at = 0; at < count; ++at) force += vload3(2 * list[at], push);
  const float part = 1.0f / count;
  const BodyStep origin = bodies[frees[list[0]].body];
  for (int at = 0; at < count; ++at) {
    const int k = list[at];
    const BodyStep b = bodies[frees[k].body];
    const float3 left = vload3(2 * k, push) - part * force;
    vstore3(left, 2 * k, push);
    torque += vload3(2 * k + 1, push) +
              cross((float3)(b.px - origin.px, b.py - origin.py, b.pz - origin.pz), left);
  }
  for (int at = 0; at < count; ++at) {
    const int k = list[at];
    vstore3(vload3(2 * k + 1, push) - part * torque, 2 * k + 1, push);
  }
}

// One work-item does it all: bodies are few. `push`: of each free body's film, force [N] and torque
// about its centre [N m]; `lists`: room for three numbers of each.
kernel void sum_films(constant FluidParams* p, float dt, int free_count, constant FreeBody* frees,
                      global const BodyStep* steps, int first_body, global const float* rims,
                      global const float* parts, global float* kept, global int* lists,
                      global float* push) {
  if (get_global_id(0) > 0) return;
  global int* listed = lists + free_count;
  global int* held = listed + free_count;
  for (int k = 0; k < free_count; ++k) {
    const Film film = film_of(p, dt, rims, kept, k);
    sum_film(&film, parts, k, push);
    kept[2 * k] = film.p0;
    kept[2 * k + 1] = film.share > 0.0f ? 1.0f : 0.0f;
    listed[k] = 0;
    // A body without a mass goes its own way: nothing that it touches changes its film.
    held[k] = film.held < FILM_GAP * p->spacing || frees[k].mass <= 0.0f ? 1 : 0;
  }
  for (int k = 0; k < free_count; ++k) {
    if (listed[k] || !is_pushed(push, k)) continue;
    const int count = list_group(frees, steps + first_body, free_count, push, k, listed, lists);
    int any_held = 0;
    for (int at = 0; at < count; ++at) any_held |= held[lists[at]];
    if (!any_held) balance_group(frees, steps + first_body, count, lists, push);
  }
}
