// SPDX-License-Identifier: MIT
// The smoothing kernel on the host, in double precision: Wendland C2 with support H (Wendland
// 1995). The device's copy is kernels/smoothing.h; a test holds them together.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::sim {

/// sigma = 21 / (2 pi H^3) [1/m3]
inline double kernel_norm(double support) {
  return 21.0 / (2.0 * std::numbers::pi * support * support * support);
}

/// W(r) [1/m3]
inline double kernel_value(double r, double support) {
  const double u = std::max(1.0 - r / support, 0.0);
  return kernel_norm(support) * u * u * u * u * (5.0 - 4.0 * u);
}

/// F(r) of grad W(x) = F(r) x [1/m5]
inline double kernel_gradient(double r, double support) {
  const double u = std::max(1.0 - r / support, 0.0);
  return -20.0 * kernel_norm(support) / (support * support) * u * u * u;
}

/// Weight of the kernel's plane at distance z from its centre: the integral of W over it [1/m].
inline double plane_marginal(double z, double support) {
  const double u = std::min(std::abs(z) / support, 1.0);
  const double u2 = u * u;
  return 21.0 / support *
         (1.0 / 14.0 + u2 * (-0.5 + u2 * (2.5 + u * (-4.0 + u * (2.5 - u * (4.0 / 7.0))))));
}

}  // namespace splash::sim
