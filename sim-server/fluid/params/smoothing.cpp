// SPDX-License-Identifier: MIT
#include "sim-server/fluid/params/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::sim {
namespace {

/// What the kernel is a polynomial of: 1 - q^2, or 0 outside the support.
double inside(double q) {
  return std::max(1.0 - q * q, 0.0);
}

}  // namespace

double kernel_norm(double support) {
  return 5775.0 / (512.0 * std::numbers::pi * std::pow(support, 3));
}

double kernel_value(double r, double support) {
  const double t = inside(r / support);
  return kernel_norm(support) * std::pow(t, 5) * (1.1 + t * (-1.8 + t * 1.7));
}

double kernel_gradient(double r, double support) {
  const double t = inside(r / support);
  return -2.0 * kernel_norm(support) / (support * support) * std::pow(t, 4) *
         (5.5 + t * (-10.8 + t * 11.9));
}

double plane_marginal(double z, double support) {
  const double t = inside(z / support);
  return 5775.0 / 512.0 / support * std::pow(t, 6) *
         (11.0 / 60.0 + t * (-9.0 / 35.0 + t * 17.0 / 80.0));
}

}  // namespace splash::sim
