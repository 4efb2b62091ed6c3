// SPDX-License-Identifier: MIT
// Free bodies move on by one step, after all that the water and the walls do to them:
//   x += dt V
//   R turns by dt w at the middle of the step; angular momentum L = R I R^T w is what it was
// (explicit midpoint: a body that nothing touches keeps its angular momentum to rounding).
// The result is where the body is in the next step.

// The rotation by a vector of any length, then `b`'s.
static void turn_body(float3 turn, BodyStep* b) {
  const float angle = length(turn);
  const float part = angle > 1.0e-3f ? sin(0.5f * angle) / angle : 0.5f - angle * angle / 48.0f;
  const float4 a = (float4)(part * turn, cos(0.5f * angle));
  const float4 q = (float4)(b->qx, b->qy, b->qz, b->qw);
  float4 r = (float4)(a.w * q.xyz + q.w * a.xyz + cross(a.xyz, q.xyz),
                      a.w * q.w - dot(a.xyz, q.xyz));
  r /= length(r);
  b->qx = r.x;
  b->qy = r.y;
  b->qz = r.z;
  b->qw = r.w;
}

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
  b->speed = length((float3)(b->vx, b->vy, b->vz)) +
             length(extent) * length((float3)(b->wx, b->wy, b->wz));
}

// One work-item does it all: bodies are few. `force`: of the water on each in this step, and its
// torque about the centre [N], [N m], from what it `felt`, which begins anew.
kernel void move_bodies(constant FluidParams* p, float dt, float piston, float piston_speed,
                        int free_count, constant FreeBody* frees, constant BodyShape* shapes,
                        int first_body, int body_count, global BodyStep* bodies,
                        global float* felt, global float* force) {
  if (get_global_id(0) > 0) return;
  for (int k = 0; k < free_count; ++k) {
    const FreeBody f = frees[k];
    BodyStep b = bodies[first_body + f.body];
    meet_walls(p, shapes[f.body], f, dt, piston, piston_speed, &b);
    move_on(f, dt, &b);
    leave_walls(p, shapes[f.body], piston, &b);
    note_reach(shapes[f.body], p->support, &b);
    bodies[first_body + body_count + f.body] = b;
    for (int e = 6 * k; e < 6 * k + 6; ++e) {
      force[e] = felt[e] / dt;
      felt[e] = 0.0f;
    }
  }
}
