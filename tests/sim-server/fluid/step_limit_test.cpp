// SPDX-License-Identifier: MIT
// How long a step may be by theory: small motions of water at rest on a lattice are waves
// e exp(i k x), for which the sums of kernels/density.cl and kernels/acceleration.cl make
//   a = -c0^2 s (s . d) - G v,   s(k) = sum_j m / rho0 grad W_j sin(k . x_j),
//   G(k) = sum_j m / rho0 K (-F_j) x_j x_j^T / (r_j^2 + eta^2) (1 - cos(k . x_j)),
// with K = 10 nu + alpha c0 h. Symplectic Euler, which is the leapfrog with the speeds half a step
// late, keeps them bounded while (omega dt)^2 + 2 gamma dt < 4, omega = c0 |s|.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim-server/fluid/smoothing.hpp"
#include "sim-server/scene/resolution.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.0225;  ///< as in the built-in scenes, 0.016 to 0.03 m
constexpr double kSound = 13.0;      ///< [m/s]

/// The places of a lattice around a particle, one particle to a volume of kSpacing^3 [m].
std::vector<Vector3> lattice(const std::vector<Vector3>& basis, double reach) {
  const double edge = kSpacing * std::cbrt(static_cast<double>(basis.size()));
  std::vector<Vector3> places;
  constexpr int kFar = 4;
  for (int i = -kFar; i <= kFar; ++i) {
    for (int j = -kFar; j <= kFar; ++j) {
      for (int k = -kFar; k <= kFar; ++k) {
        for (const Vector3& b : basis) {
          const Vector3 x = {(i + b[0]) * edge, (j + b[1]) * edge, (k + b[2]) * edge};
          const double r = std::hypot(x[0], x[1], x[2]);
          if (r > 1.0e-9 && r < reach) places.push_back(x);
        }
      }
    }
  }
  return places;
}

/// c0 |s(k)| [1/s].
double frequency(const std::vector<Vector3>& places, const Smoothing& smoothing, const Vector3& k) {
  Vector3 s = {};
  for (const Vector3& x : places) {
    const double wave = std::sin(k[0] * x[0] + k[1] * x[1] + k[2] * x[2]);
    const double slope = kernel_gradient(std::hypot(x[0], x[1], x[2]), smoothing);
    for (std::size_t a = 0; a < 3; ++a) s[a] += slope * x[a] * wave;
  }
  return kSound * kSpacing * kSpacing * kSpacing * std::hypot(s[0], s[1], s[2]);
}

/// The trace of G / K for the shortest waves, 1 - cos = 2: no gamma is larger [1/m2].
double friction(const std::vector<Vector3>& places, const Smoothing& smoothing, double length) {
  double sum = 0.0;
  for (const Vector3& x : places) {
    const double r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    sum -= 2.0 * kernel_gradient(std::sqrt(r2), smoothing) * r2 / (r2 + 0.01 * length * length);
  }
  return kSpacing * kSpacing * kSpacing * sum / 3.0;  // alike along the three axes
}

/// The highest frequency of all waves, by climbing from many places [1/s].
double highest(const std::vector<Vector3>& places, const Smoothing& smoothing) {
  constexpr int kStarts = 7;
  double best = 0.0;
  for (int start = 0; start < kStarts * kStarts * kStarts; ++start) {
    const auto at = [&](int part) { return 6.5 / kSpacing * (part % kStarts) / (kStarts - 1.0); };
    Vector3 k = {at(start), at(start / kStarts), at(start / kStarts / kStarts)};
    double here = frequency(places, smoothing, k);
    for (double step = 0.5 / kSpacing; step > 1.0e-3 / kSpacing; step /= 2.0) {
      for (std::size_t a = 0; a < 6; ++a) {
        Vector3 next = k;
        next[a / 2] += a % 2 == 0 ? step : -step;
        const double there = frequency(places, smoothing, next);
        if (!(there > here)) continue;
        here = there;
        k = next;
      }
    }
    best = std::max(best, here);
  }
  return best;
}

struct Limits {
  double frictionless = 0.0;  ///< in H / c0 [1]
  double rubbing = 0.0;       ///< with the default viscosities
};

Limits limits_of(SmoothingKind kind, const std::vector<Vector3>& basis) {
  const SmoothingTraits& traits = traits_of(kind);
  const Smoothing smoothing(traits.support_spacings * kSpacing, kind);
  const std::vector<Vector3> places = lattice(basis, smoothing.support);
  const double omega = highest(places, smoothing);
  const FluidSettings fluid;
  const double length = traits.length * smoothing.support;
  const double rub = 10.0 * fluid.viscosity + fluid.artificial * kSound * length;
  const double gamma = rub * friction(places, smoothing, length);
  const double unit = smoothing.support / kSound;
  return {2.0 / omega / unit,
          (std::sqrt(gamma * gamma + 4.0 * omega * omega) - gamma) / (omega * omega) / unit};
}

const std::vector<std::vector<Vector3>> kLattices = {
    {{0, 0, 0}},
    {{0, 0, 0}, {0.5, 0.5, 0.5}},
    {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}};

class StepLimit : public testing::TestWithParam<SmoothingKind> {};

TEST_P(StepLimit, OfTheoryIsAboveTheLongestStepAndFarBelowTwiceTheDefault) {
  const double share = traits_of(GetParam()).acoustic;
  const double most = longest_step_factor(PressureKind::weakly_compressible);
  for (const auto& basis : kLattices) {
    const Limits limits = limits_of(GetParam(), basis);
    std::printf("%zu per cell: %.3f H/c0 without friction, %.3f with it; used: %.3f\n",
                basis.size(), limits.frictionless, limits.rubbing, share);
    EXPECT_LE(most * share, limits.rubbing);
    EXPECT_GT(2.0 * share, 1.5 * limits.frictionless);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, StepLimit,
                         testing::Values(SmoothingKind::narrow, SmoothingKind::wide),
                         [](const auto& kind) {
                           return kind.param == SmoothingKind::wide ? "wide" : "narrow";
                         });

}  // namespace
}  // namespace splash::sim
