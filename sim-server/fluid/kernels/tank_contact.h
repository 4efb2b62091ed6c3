// SPDX-License-Identifier: MIT
// Free bodies against the tank's walls: points of the outline that a wall meets first, each with a
// push that ends the approach (or turns it round, by the restitution) and one that rubs (Coulomb),
// found together by repeated sweeps, none of them ever pulling (Catto 2005, sequential impulses).
// A point that would pass the wall within the step is stopped so that it just reaches it.

#define CONTACTS 24          // 8 points on 3 walls
#define CONTACT_SWEEPS 16
#define REBOUND_SPEED 0.1f   // what comes slower does not rebound [m/s]

typedef struct {
  float3 lever;   // from the body's centre [m]
  float3 normal;  // out of the wall
  float wall;     // the wall's speed along it [m/s]
  float wanted;   // least speed away from the wall [m/s]
  float pushed;   // so far [N s]
  float3 rubbed;  // [N s]
} Contact;

static float above_wall(constant FluidParams* p, int k, float piston, BodyStep b, float3 lever) {
  const float moved = k == p->piston ? piston : 0.0f;
  return p->walls[k].nx * (b.px + lever.x) + p->walls[k].ny * (b.py + lever.y) +
         p->walls[k].nz * (b.pz + lever.z) - (p->walls[k].offset + moved);
}

static float3 wall_normal(constant FluidParams* p, int k) {
  return (float3)(p->walls[k].nx, p->walls[k].ny, p->walls[k].nz);
}

static float3 speed_at(BodyStep b, float3 lever) {
  return (float3)(b.vx, b.vy, b.vz) + cross((float3)(b.wx, b.wy, b.wz), lever);
}

static void knock(FreeBody f, BodyStep* b, float3 lever, float3 impulse) {
  const float3 dv = impulse / f.mass, dw = inertia_solve(f, *b, cross(lever, impulse));
  b->vx += dv.x;
  b->vy += dv.y;
  b->vz += dv.z;
  b->wx += dw.x;
  b->wy += dw.y;
  b->wz += dw.z;
}

// Mass that an impulse along `way` at the lever meets [kg].
static float mass_at(FreeBody f, BodyStep b, float3 lever, float3 way) {
  const float3 turn = cross(inertia_solve(f, b, cross(lever, way)), lever);
  return 1.0f / (1.0f / f.mass + dot(turn, way));
}

static int find_contacts(constant FluidParams* p, BodyShape shape, FreeBody f, BodyStep b,
                         float dt, float piston, float piston_speed, Contact* contacts) {
  int count = 0;
  float3 lever[CONTACT_POINTS];
  for (int k = 0; k < p->wall_count; ++k) {
    const float3 normal = wall_normal(p, k);
    const float wall = k == p->piston ? piston_speed : 0.0f;
    const int points = contact_points(shape, b, normal, lever);
    for (int i = 0; i < points && count < CONTACTS; ++i) {
      const float gap = above_wall(p, k, piston, b, lever[i]);
      const float leaving = dot(speed_at(b, lever[i]), normal) - wall;
      if (!(gap + dt * leaving < 0.0f)) continue;
      const bool rebounds = leaving < -REBOUND_SPEED && f.restitution > 0.0f;
      const Contact contact = {lever[i], normal, wall,
                               rebounds ? -f.restitution * leaving : -fmax(gap, 0.0f) / dt, 0.0f,
                               (float3)(0.0f, 0.0f, 0.0f)};
      contacts[count++] = contact;
    }
  }
  return count;
}

static void push_contact(FreeBody f, BodyStep* b, Contact* c) {
  const float leaving = dot(speed_at(*b, c->lever), c->normal) - c->wall;
  const float wish = (c->wanted - leaving) * mass_at(f, *b, c->lever, c->normal);
  const float pushed = fmax(c->pushed + wish, 0.0f);
  knock(f, b, c->lever, (pushed - c->pushed) * c->normal);
  c->pushed = pushed;
}

static void rub_contact(FreeBody f, BodyStep* b, Contact* c) {
  const float3 speed = speed_at(*b, c->lever);
  const float3 slip = speed - dot(speed, c->normal) * c->normal;
  const float fast = length(slip);
  float3 rubbed = c->rubbed;
  if (fast > 1.0e-9f) rubbed -= mass_at(f, *b, c->lever, slip / fast) * slip;
  const float most = f.friction * c->pushed, size = length(rubbed);
  if (size > most) rubbed *= most / size;
  knock(f, b, c->lever, rubbed - c->rubbed);
  c->rubbed = rubbed;
}

// Changes the speeds of a body so that nothing of it is beyond a wall after the step.
static void meet_walls(constant FluidParams* p, BodyShape shape, FreeBody f, float dt,
                       float piston, float piston_speed, BodyStep* b) {
  Contact contacts[CONTACTS];
  const int count = find_contacts(p, shape, f, *b, dt, piston, piston_speed, contacts);
  for (int sweep = 0; sweep < CONTACT_SWEEPS; ++sweep) {
    for (int k = 0; k < count; ++k) rub_contact(f, b, &contacts[k]);
    for (int k = 0; k < count; ++k) push_contact(f, b, &contacts[k]);
  }
}

// What turned into a wall, or was there, is put back: no motion comes of it.
static void leave_walls(constant FluidParams* p, BodyShape shape, float piston, BodyStep* b) {
  float3 lever[CONTACT_POINTS];
  for (int k = 0; k < p->wall_count; ++k) {
    const float3 normal = wall_normal(p, k);
    const int points = contact_points(shape, *b, normal, lever);
    float deepest = 0.0f;
    for (int i = 0; i < points; ++i) {
      deepest = fmin(deepest, above_wall(p, k, piston, *b, lever[i]));
    }
    b->px -= deepest * normal.x;
    b->py -= deepest * normal.y;
    b->pz -= deepest * normal.z;
  }
}
