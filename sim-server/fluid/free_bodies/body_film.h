// SPDX-License-Identifier: MIT
// Where films are (body_film.cl): how far a place is from what is not the body, whether it lies
// between the two, and the faces that a pressure acts on, of the body's skin and of particles.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/free_bodies/body_reach.h"
#include "sim-server/fluid/free_bodies/tank_contact.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

#define APART 3.0f  // from there on no particle counts as between solids [spacings]

typedef struct {
  lanes held, next;  // distance from solids that go their way, from other free bodies [m]
  lanes nx, ny, nz;  // normal of the nearest
} Gap;

// Whether the boxes around two bodies, both grown by the support, overlap.
static bool reaches_meet(BodyStep a, BodyStep b) {
  return a.upper_x > b.lower_x && a.lower_x < b.upper_x && a.upper_y > b.lower_y &&
         a.lower_y < b.upper_y && a.upper_z > b.lower_z && a.lower_z < b.upper_z;
}

static Gap gap_at(constant FluidParams* p, float piston, const Bodies* bodies, int body, lanes x,
                  lanes y, lanes z) {
  Gap gap = {FAR_AWAY, FAR_AWAY, 0.0f, 0.0f, 0.0f};
  for (int k = 0; k < p->wall_count; ++k) {
    const lanes distance = wall_distance(p, k, x, y, z, piston);
    const lane_flags nearer = distance < gap.held;
    gap.held = fmin(gap.held, distance);
    gap.nx = select(gap.nx, (lanes)(p->walls[k].nx), nearer);
    gap.ny = select(gap.ny, (lanes)(p->walls[k].ny), nearer);
    gap.nz = select(gap.nz, (lanes)(p->walls[k].nz), nearer);
  }
  global const BodyStep* steps = bodies->steps + bodies->first;
  for (int other = 0; other < bodies->count; ++other) {
    if (other == body || !reaches_meet(steps[body], steps[other])) continue;
    const BodyFace face =
        nearest_face(bodies->shapes + other, bodies->meshes, steps + other, 0, 1, x, y, z);
    const lane_flags nearer = face.distance < fmin(gap.held, gap.next);
    gap.nx = select(gap.nx, face.nx, nearer);
    gap.ny = select(gap.ny, face.ny, nearer);
    gap.nz = select(gap.nz, face.nz, nearer);
    if (bodies->shapes[other].free) {
      gap.next = fmin(gap.next, face.distance);
    } else {
      gap.held = fmin(gap.held, face.distance);
    }
  }
  return gap;
}

// w_i, of places whose distance from the body is `own`.
static lanes between(constant FluidParams* p, const BodyFace* own, const Gap* gap) {
  const lanes apart = own->distance + fmin(gap->held, gap->next);
  const lanes facing = -(own->nx * gap->nx + own->ny * gap->ny + own->nz * gap->nz);
  return clamp(2.0f * facing, 0.0f, 1.0f) * clamp(APART - apart / p->spacing, 0.0f, 1.0f);
}

// Whether anything else is within the support of the box around a body, already grown by it.
static bool has_neighbour(constant FluidParams* p, float piston, const Bodies* bodies, int body) {
  global const BodyStep* steps = bodies->steps + bodies->first;
  const BodyStep b = steps[body];
  for (int other = 0; other < bodies->count; ++other) {
    if (other != body && reaches_meet(b, steps[other])) return true;
  }
  const float3 reach = reach_along_axes(bodies->shapes[body], b);
  for (int k = 0; k < p->wall_count; ++k) {
    const float3 n = fabs(wall_normal(p, k));
    if (above_wall(p, k, piston, b, (float3)(0.0f)) < dot(n, reach) + p->support) return true;
  }
  return false;
}

// The skin's faces, in body axes: places and areas, part after part.
typedef struct {
  lanes x, y, z, ax, ay, az;  // in the world, from the body's centre [m], [m2]
} Skin;

static Skin load_skin(global const float* skin, int stride, BodyStep b, int i) {
  Skin s = {LOAD(skin, i),
            LOAD(skin + stride, i),
            LOAD(skin + 2 * stride, i),
            LOAD(skin + 3 * stride, i),
            LOAD(skin + 4 * stride, i),
            LOAD(skin + 5 * stride, i)};
  turn_lanes(&s.x, &s.y, &s.z, b.qx, b.qy, b.qz, b.qw);
  turn_lanes(&s.ax, &s.ay, &s.az, b.qx, b.qy, b.qz, b.qw);
  return s;
}

// By gravity and the central field at the body's centre, times rho0 [Pa/m].
static float3 weight_at(constant FluidParams* p, BodyStep b) {
  return p->rest_density * (float3)(p->gravity_x - p->pull_x * (b.px - p->centre_x),
                                    p->gravity_y - p->pull_y * (b.py - p->centre_y),
                                    p->gravity_z - p->pull_z * (b.pz - p->centre_z));
}

static lanes length_of(lanes x, lanes y, lanes z) {
  return sqrt(x * x + y * y + z * z);
}

// m g_i / rho_i^2 of the particles of a group: none of those that do not push the body.
static Lever areas_of(constant FluidParams* p, const Reach* r, lanes rho) {
  const lanes g2 = r->gx * r->gx + r->gy * r->gy + r->gz * r->gz;
  const lanes factor = select((lanes)(0.0f), p->mass / (rho * rho), g2 > 0.0f);
  const Lever area = {factor * r->gx, factor * r->gy, factor * r->gz};
  return area;
}
