// SPDX-License-Identifier: MIT
// The smoothing kernel: W(r), its slope, and what a plane of it weighs.
//   grad W(x) = -gradient_norm slope(r) x

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

#define TINY 1e-12f

// Over 2.5 spacings: an even polynomial; with t = 1 - q^2, q = r / H,
//   W(r)      = sigma t^5 (a + b t + c t^2)  inside the support,   sigma = 5775 / (512 pi H^3)
//   grad W(x) = -2 sigma / H^2 t^4 (5 a + 6 b t + 7 c t^2) x
//   integral of W over the plane at distance z = pi sigma H^2 t^6 (a / 6 + b / 7 t + c / 8 t^2)
// No root, and half the operations of the quartic B-spline M5 (Schoenberg 1946; Price 2012), whose
// Fourier transform a = 1.1, b = -1.8 and c = 1.7 repeat: next to nothing from the wave number 5.5
// per spacing on, where packed particles have their structure, so that a sum over neighbours says
// the same on every packing (README.md, "The smoothing kernel").

#define CENTRE_SHAPE 1.0f              // W(0) / sigma
#define PLANE_PEAK 1.56433105f         // weight of the plane through the centre [1/H]
#define PLANE_NORM (5775.0f / 256.0f)  // 2 pi sigma H^3
#define WALL_LAYERS 3                  // of fluid behind a wall that reach into the support
#define SLOPE_UNIT p->support          // slope times distance is of this order

// t; 0 outside the support.
static lanes inside(lanes r2, float inverse_support) {
  return fmax(1.0f - r2 * (inverse_support * inverse_support), 0.0f);
}

// W / sigma, from the squared distance.
static lanes kernel_shape(lanes r2, float inverse_support) {
  const lanes t = inside(r2, inverse_support);
  const lanes t2 = t * t;
  return t2 * t2 * t * (1.1f + t * (-1.8f + t * 1.7f));
}

// t^4 (5 a + 6 b t + 7 c t^2)
static lanes kernel_slope(lanes r2, float inverse_support) {
  const lanes t = inside(r2, inverse_support);
  const lanes t2 = t * t;
  return t2 * t2 * (5.5f + t * (-10.8f + t * 11.9f));
}

static float gradient_norm(constant FluidParams* p) {
  return 2.0f * p->kernel_norm * p->inverse_support * p->inverse_support;
}

// Weight of the kernel's plane at distance z from its centre: the integral of W over it [1/m].
static lanes plane_marginal(lanes z, float inverse_support) {
  const lanes t = inside(z * z, inverse_support);
  const lanes t2 = t * t;
  return 0.5f * PLANE_NORM * inverse_support * t2 * t2 * t2 *
         (11.0f / 60.0f + t * (-9.0f / 35.0f + t * (17.0f / 80.0f)));
}

// -d/dz of it, which is 2 pi z W(z) [1/m2].
static lanes plane_marginal_fall(lanes z, float inverse_support) {
  return PLANE_NORM * inverse_support * inverse_support * inverse_support * fabs(z) *
         kernel_shape(z * z, inverse_support);
}
