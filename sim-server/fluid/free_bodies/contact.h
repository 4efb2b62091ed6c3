// SPDX-License-Identifier: MIT
// Solids that touch: places where a free body meets a wall or another body, each with a push that
// ends the approach (or turns it round, by the restitution) and one that rubs (Coulomb), found
// together by repeated sweeps, none of them ever pulling (Catto 2005, sequential impulses). What
// one body gets, the other gives, at the same place: momentum and angular momentum stay.
// What would pass the other within the step is stopped so that it just reaches it; what touches may
// have to be stopped, too, once that on which it lies is.
// A place in touch in the step before begins with the push that it had: so what is piled up is
// found in a few sweeps. Where the water was taken back, that push is of a step that did not come
// to be: a worse guess, no wrong answer.

#include "sim-server/fluid/boundary/body_inertia.h"
#include "sim-server/fluid/params/fluid_params.h"

#define REBOUND_SPEED 0.1f  // what comes slower does not rebound [m/s]
#define REBOUND_FALLS 2.0f  // nor what comes no faster than a fall of so many steps makes it
#define CONTACT_SWEEPS 16
#define MOST_SWEEPS 64
#define NO_BODY -1

typedef struct {
  int body;            // number of the free body
  int other;           // of the free body that it meets; NO_BODY: of what goes its way, or a wall
  float3 lever;        // of the place, from the body's centre [m]
  float3 other_lever;  // from the other's
  float3 normal;       // out of the other
  float3 drift;        // how the other moves there, where it goes its way [m/s]
  float friction;      // Coulomb's coefficient [1]
  float wanted;        // least speed away from the other [m/s]
  float pushed;        // so far [N s]
  float3 rubbed;       // [N s]
  int key;             // of this place of the body and what it meets, above 0
} Contact;

// The host gives each so much room.
typedef char contact_fits[sizeof(Contact) <= 4 * SPLASH_CONTACT_FLOATS ? 1 : -1];

// All contacts of a step, and the bodies that they change.
typedef struct {
  constant FreeBody* frees;
  global BodyStep* bodies;  // of the step: all, not only the free ones
  global Contact* list;
  global KeptPush* kept;    // of the last step; the first one's key is how many follow it
  int count, room;
  float rebound;            // what comes slower does not [m/s]
  global const float* friction;  // of each free body on each of `body_count`, then on walls [1]
  int body_count;
} Contacts;

// What lies on another falls towards it by g dt in each step; were that a knock, it would begin
// without the push of the step before, and a pile would never be carried.
static float rebound_speed(constant FluidParams* p, float dt) {
  const float g = length((float3)(p->gravity_x, p->gravity_y, p->gravity_z));
  return fmax(REBOUND_SPEED, REBOUND_FALLS * dt * g);
}

// `feature`: a number below 128 of the place; `turned`: it is not the body's, but the other's.
// `met`: number of the other body, or MET_WALLS and the wall's.
#define MET_WALLS 1000
static int contact_key(int body, int met, bool turned, int feature) {
  return ((body * 1024 + met) * 2 + (turned ? 1 : 0)) * 128 + feature + 1;
}

// Coulomb's coefficient of a free body on body `met`, or on walls from MET_WALLS on.
static float friction_on(const Contacts* all, int free_body, int met) {
  return all->friction[free_body * (all->body_count + 1) + min(met, all->body_count)];
}

static float kept_push(const Contacts* all, int key) {
  for (int k = 1; k <= all->kept[0].key; ++k) {
    if (all->kept[k].key == key) return all->kept[k].pushed;
  }
  return 0.0f;
}

static void keep_pushes(const Contacts* all) {
  all->kept[0].key = all->count;
  for (int k = 0; k < all->count; ++k) {
    all->kept[k + 1].key = all->list[k].key;
    all->kept[k + 1].pushed = all->list[k].pushed;
  }
}

static global BodyStep* step_of(const Contacts* all, int free_body) {
  return all->bodies + all->frees[free_body].body;
}

static float3 place_of(BodyStep b) { return (float3)(b.px, b.py, b.pz); }

static float3 speed_at(BodyStep b, float3 lever) {
  return (float3)(b.vx, b.vy, b.vz) + cross((float3)(b.wx, b.wy, b.wz), lever);
}

// Of the body against the other, at the place of contact [m/s].
static float3 slip_of(const Contacts* all, const Contact* c) {
  const float3 theirs = c->other == NO_BODY ? c->drift
                                            : speed_at(*step_of(all, c->other), c->other_lever);
  return speed_at(*step_of(all, c->body), c->lever) - theirs;
}

static void knock(FreeBody f, global BodyStep* b, float3 lever, float3 impulse) {
  const float3 dv = mass_solve(f, impulse), dw = inertia_solve(f, *b, cross(lever, impulse));
  b->vx += dv.x;
  b->vy += dv.y;
  b->vz += dv.z;
  b->wx += dw.x;
  b->wy += dw.y;
  b->wz += dw.z;
}

static void knock_both(const Contacts* all, const Contact* c, float3 impulse) {
  knock(all->frees[c->body], step_of(all, c->body), c->lever, impulse);
  if (c->other == NO_BODY) return;
  knock(all->frees[c->other], step_of(all, c->other), c->other_lever, -impulse);
}

// How much an impulse along `way` at the lever speeds a body up [1/kg].
static float yield_at(FreeBody f, BodyStep b, float3 lever, float3 way) {
  const float3 turn = cross(inertia_solve(f, b, cross(lever, way)), lever);
  return (f.held ? dot(mass_solve(f, way), way) : 1.0f / f.mass) + dot(turn, way);
}

// Mass that such an impulse meets [kg]; 0: nothing that it meets can move.
static float mass_at(const Contacts* all, const Contact* c, float3 way) {
  float yield = yield_at(all->frees[c->body], *step_of(all, c->body), c->lever, way);
  if (c->other != NO_BODY) {
    yield += yield_at(all->frees[c->other], *step_of(all, c->other), c->other_lever, way);
  }
  return yield > 0.0f ? 1.0f / yield : 0.0f;
}

// What is nearer than this touches: by as much as edges are round [m].
static float touching(BodyShape s) {
  return SPLASH_ROUNDED * fmin(s.half_z, fmin(s.half_x, s.half_y));
}

// Adds the contact `c`, apart by `gap` [m], if it closes within the step or is nearer than `touch`.
// Its push is still to be found.
static void add_contact(Contacts* all, Contact c, float gap, float touch, float dt) {
  const float leaving = dot(slip_of(all, &c), c.normal);
  const bool closes = gap + dt * leaving < 0.0f;
  if (!(closes || gap < touch) || all->count >= all->room) return;
  float restitution = all->frees[c.body].restitution;
  if (c.other != NO_BODY) restitution = fmax(restitution, all->frees[c.other].restitution);
  const bool rebounds = closes && leaving < -all->rebound && restitution > 0.0f;
  c.wanted = rebounds ? -restitution * leaving : -fmax(gap, 0.0f) / dt;
  c.pushed = rebounds ? 0.0f : kept_push(all, c.key);
  c.rubbed = (float3)(0.0f, 0.0f, 0.0f);
  all->list[all->count++] = c;
}

static void push_contact(const Contacts* all, global Contact* contact) {
  Contact c = *contact;
  const float leaving = dot(slip_of(all, &c), c.normal);
  const float wish = (c.wanted - leaving) * mass_at(all, &c, c.normal);
  const float pushed = fmax(c.pushed + wish, 0.0f);
  knock_both(all, &c, (pushed - c.pushed) * c.normal);
  contact->pushed = pushed;
}

static void rub_contact(const Contacts* all, global Contact* contact) {
  Contact c = *contact;
  const float3 speed = slip_of(all, &c);
  const float3 slip = speed - dot(speed, c.normal) * c.normal;
  const float fast = length(slip);
  float3 rubbed = c.rubbed;
  if (fast > 1.0e-9f) rubbed -= mass_at(all, &c, slip / fast) * slip;
  const float most = c.friction * c.pushed, size = length(rubbed);
  if (size > most) rubbed *= most / size;
  knock_both(all, &c, rubbed - c.rubbed);
  contact->rubbed = rubbed;
}

// A push travels on by one contact in a sweep, so a pile wants many; up and down by turns.
static void solve_contacts(const Contacts* all) {
  for (int k = 0; k < all->count; ++k) {
    const Contact c = all->list[k];
    knock_both(all, &c, c.pushed * c.normal);
  }
  const int sweeps = clamp(all->count, CONTACT_SWEEPS, MOST_SWEEPS);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const bool down = sweep % 2 == 1;
    for (int k = 0; k < all->count; ++k) {
      rub_contact(all, &all->list[down ? all->count - 1 - k : k]);
    }
    for (int k = 0; k < all->count; ++k) {
      push_contact(all, &all->list[down ? all->count - 1 - k : k]);
    }
  }
  keep_pushes(all);
}
