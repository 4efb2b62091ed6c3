// SPDX-License-Identifier: MIT
// The smoothing kernel: Wendland C2 in three dimensions with support H (Wendland 1995; Dehnen &
// Aly 2012), and what a half-space of it weighs.
//   W(r)      = sigma (1 - q)^4 (1 + 4 q),   q = r / H,  sigma = 21 / (2 pi H^3)
//   grad W(x) = F(q) x,   F = -20 sigma / H^2 (1 - q)^3

#define TINY 1e-12f

// u = 1 - q, 0 outside the support, from the squared distance.
static lanes one_minus_q(lanes r2, float inverse_support) {
  const lanes r = r2 * inverse_root(r2 + TINY);
  return fmax(1.0f - r * inverse_support, 0.0f);
}

// W / sigma
static lanes kernel_shape(lanes u) {
  const lanes u2 = u * u;
  return u2 * u2 * (5.0f - 4.0f * u);
}

// Weight of the kernel's plane at distance z from its centre: the integral of W over it [1/m].
static lanes plane_marginal(lanes z, float inverse_support) {
  const lanes u = fmin(fabs(z) * inverse_support, 1.0f);
  const lanes u2 = u * u;
  return 21.0f * inverse_support *
         (1.0f / 14.0f + u2 * (-0.5f + u2 * (2.5f + u * (-4.0f + u * (2.5f - u * (4.0f / 7.0f))))));
}

// -d/dz of it, which is 2 pi z W(z) [1/m2].
static lanes plane_marginal_fall(lanes z, float inverse_support) {
  const lanes u = fmin(fabs(z) * inverse_support, 1.0f);
  const lanes left = 1.0f - u;
  const lanes left2 = left * left;
  return 21.0f * inverse_support * inverse_support * u * left2 * left2 * (1.0f + 4.0f * u);
}
