// SPDX-License-Identifier: MIT
// Where a body is nearest: its distance, and the outward normal there, from its outline in closed
// form.

typedef struct {
  lanes distance;    // [m], negative inside
  lanes nx, ny, nz;  // its gradient: away from the body
  lanes owner;       // number of the body
} BodyFace;

// What is left of up to three faces at right angles to each other: `q` are the distances from them
// [m], `part` becomes how much of each one's normal is in the normal there.
static lanes from_corner(const lanes q[3], lanes part[3]) {
  const lanes none = 0.0f, one = 1.0f;
  lanes out2 = 0.0f;
  for (int k = 0; k < 3; ++k) out2 += fmax(q[k], none) * fmax(q[k], none);
  const lanes inverse_out = inverse_root(fmax(out2, 1.0e-20f));
  const lanes deepest = fmax(q[0], fmax(q[1], q[2]));
  lanes taken = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const lanes nearest = select(none, one - taken, q[k] >= deepest);
    taken += nearest;
    part[k] = select(nearest, fmax(q[k], none) * inverse_out, out2 > none);
  }
  return select(deepest, out2 * inverse_out, out2 > none);
}

static BodyFace face_of_round(BodyShape s, lanes x, lanes y, lanes z) {
  const lanes above = s.kind == SPLASH_SPHERE ? z : (lanes)(0.0f);
  const lanes r2 = x * x + y * y + above * above;
  const lanes inverse_r = inverse_root(fmax(r2, 1.0e-20f));
  lanes q[3] = {r2 * inverse_r - s.half_x, fabs(z) - s.half_z, -FAR_AWAY};
  if (s.kind == SPLASH_SPHERE) q[1] = -FAR_AWAY;
  lanes part[3];
  BodyFace face;
  face.distance = from_corner(q, part);
  face.nx = part[0] * x * inverse_r;
  face.ny = part[0] * y * inverse_r;
  face.nz = part[0] * above * inverse_r + part[1] * copysign((lanes)(1.0f), z);
  return face;
}

// The underside of a box may curve up at both ends (sole_rise of keep_out.h); there its distance is
// the height, of which the slope is known.
static BodyFace face_of_box(BodyShape s, lanes x, lanes y, lanes z) {
  const lanes one = 1.0f;
  const float bend = s.flat < 1.0f ? 1.0f / (1.0f - s.flat) : 0.0f;
  const lanes curved = fmax(fmin(fabs(x) / s.half_x, 1.0f) - s.flat, 0.0f) * bend;
  const lanes steep = select((lanes)(0.0f), 2.0f * s.rocker * curved * bend / s.half_x,
                             fabs(x) < s.half_x);
  const lanes under = s.rocker * curved * curved - s.half_z - z;
  const lanes over = z - s.half_z;
  const lanes q[3] = {fabs(x) - s.half_x, fabs(y) - s.half_y, fmax(under, over)};
  lanes part[3];
  BodyFace face;
  face.distance = from_corner(q, part);
  face.nx = (part[0] + select(part[2] * steep, (lanes)(0.0f), over > under)) * copysign(one, x);
  face.ny = part[1] * copysign(one, y);
  face.nz = part[2] * select(-one, one, over > under);
  return face;
}

static void turn_lanes(lanes* x, lanes* y, lanes* z, float qx, float qy, float qz, float qw) {
  const lanes tx = 2.0f * (qy * *z - qz * *y);
  const lanes ty = 2.0f * (qz * *x - qx * *z);
  const lanes tz = 2.0f * (qx * *y - qy * *x);
  *x += qw * tx + qy * tz - qz * ty;
  *y += qw * ty + qz * tx - qx * tz;
  *z += qw * tz + qx * ty - qy * tx;
}

// Of all bodies at one step.
static BodyFace nearest_face(constant BodyShape* shapes, global const BodyStep* bodies,
                             int first_body, int body_count, lanes x, lanes y, lanes z) {
  BodyFace nearest = {FAR_AWAY, 0.0f, 0.0f, 0.0f, 0.0f};
  for (int k = 0; k < body_count; ++k) {
    const BodyStep b = bodies[first_body + k];
    lanes ax = x - b.px, ay = y - b.py, az = z - b.pz;
    turn_lanes(&ax, &ay, &az, -b.qx, -b.qy, -b.qz, b.qw);
    const BodyShape s = shapes[k];
    const bool box = s.kind == SPLASH_BOX;
    BodyFace face = box ? face_of_box(s, ax, ay, az) : face_of_round(s, ax, ay, az);
    turn_lanes(&face.nx, &face.ny, &face.nz, b.qx, b.qy, b.qz, b.qw);
    const lane_flags nearer = face.distance < nearest.distance;
    nearest.distance = select(nearest.distance, face.distance, nearer);
    nearest.nx = select(nearest.nx, face.nx, nearer);
    nearest.ny = select(nearest.ny, face.ny, nearer);
    nearest.nz = select(nearest.nz, face.nz, nearer);
    nearest.owner = select(nearest.owner, (lanes)(k), nearer);
  }
  return nearest;
}
