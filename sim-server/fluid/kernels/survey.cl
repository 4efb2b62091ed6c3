// SPDX-License-Identifier: MIT
// Health and limits of the whole fluid, once a frame, in a program of its own that is built
// without relaxed mathematics: finiteness is read from the exponent bits.

#ifdef __FAST_RELAXED_MATH__
#error "the survey guards against infinities: build it without relaxed mathematics"
#endif

static bool is_finite(float a) { return (as_uint(a) & 0x7F800000u) != 0x7F800000u; }

typedef struct {
  float speed2;        // largest [m2/s2]
  float acceleration2; // largest [m2/s4]
  float excess_sum;    // of max(rho / rho0 - 1, 0)
  float excess_max;
  int not_finite;      // particles with a coordinate, speed or density that is no number
  int first_bad;       // the smallest id of such a particle, 2^31 - 1: none
  int runaway;         // particles at the speed limit
  int unused;
} SurveyPart;

kernel void survey(constant FluidParams* p, int parts, global const float* position,
                   global const float* velocity, global const float* acceleration,
                   global const float* density, global const int* id,
                   global SurveyPart* out) {
  const int part = get_global_id(0);
  if (part >= parts) return;
  const int n = p->capacity;
  SurveyPart s = {0.0f, 0.0f, 0.0f, 0.0f, 0, 0x7FFFFFFF, 0, 0};
  const int size = (p->count + parts - 1) / parts;
  const int last = min((part + 1) * size, p->count);
  for (int i = part * size; i < last; ++i) {
    bool finite = is_finite(density[i]);
    float speed2 = 0.0f, acceleration2 = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      const float v = velocity[axis * n + i], a = acceleration[axis * n + i];
      finite = finite && is_finite(position[axis * n + i]) && is_finite(v) && is_finite(a);
      speed2 += v * v;
      acceleration2 += a * a;
    }
    if (!finite) {
      ++s.not_finite;
      s.first_bad = min(s.first_bad, id[i]);
      continue;
    }
    const float excess = fmax(density[i] / p->rest_density - 1.0f, 0.0f);
    s.speed2 = fmax(s.speed2, speed2);
    s.acceleration2 = fmax(s.acceleration2, acceleration2);
    s.excess_sum += excess;
    s.excess_max = fmax(s.excess_max, excess);
    s.runaway += speed2 >= 0.98f * p->speed_limit * p->speed_limit;
  }
  out[part] = s;
}
