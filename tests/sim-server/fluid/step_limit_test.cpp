// SPDX-License-Identifier: MIT
// How long a step may be by theory: small motions of water at rest on a lattice are waves
// e exp(i k x), for which the sums of pressure/density.cl and pressure/acceleration.cl make
//   a = -c0^2 s (s . d) - G v,   s(k) = sum_j m / rho0 grad W_j sin(k . x_j),
//   G(k) = sum_j m / rho0 K (-F_j) x_j x_j^T / (r_j^2 + eta^2) (1 - cos(k . x_j)),
// with K = 10 nu + alpha c0 h. Symplectic Euler, which is the leapfrog with the speeds half a step
// late, keeps them bounded while (omega dt)^2 + 2 gamma dt < 4, omega = c0 |s|.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "tests/sim-server/fluid/lattice_waves.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.0225;  ///< as in the built-in scenes, 0.016 to 0.03 m
constexpr double kSound = 13.0;      ///< [m/s]

/// The trace of G / K for the shortest waves, 1 - cos = 2: no gamma is larger [1/m2].
double friction(const std::vector<Vector3>& places, double support, double length) {
  double sum = 0.0;
  for (const Vector3& x : places) {
    const double r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    sum -= 2.0 * kernel_gradient(std::sqrt(r2), support) * r2 / (r2 + 0.01 * length * length);
  }
  return kSpacing * kSpacing * kSpacing * sum / 3.0;  // alike along the three axes
}

struct Limits {
  double frictionless = 0.0;  ///< in H / c0 [1]
  double rubbing = 0.0;       ///< with the default viscosities
};

Limits limits_of(const std::vector<Vector3>& basis) {
  const double support = kSupportSpacings * kSpacing;
  const std::vector<Vector3> places = lattice(basis, kSpacing, support);
  const double volume = kSpacing * kSpacing * kSpacing;
  const double omega = kSound * steepest_wave(places, volume, support);
  const FluidSettings fluid;
  const double length = kLengthOfSupport * support;
  const double rub = 10.0 * fluid.viscosity + fluid.artificial * kSound * length;
  const double gamma = rub * friction(places, support, length);
  const double unit = support / kSound;
  return {2.0 / omega / unit,
          (std::sqrt(gamma * gamma + 4.0 * omega * omega) - gamma) / (omega * omega) / unit};
}

const std::vector<std::vector<Vector3>> kLattices = {
    {{0, 0, 0}},
    {{0, 0, 0}, {0.5, 0.5, 0.5}},
    {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}};

TEST(StepLimit, OfTheoryIsAboveTheLongestStepAndFarBelowTwiceTheDefault) {
  const double most = StepPolicy::stable_factor(PressureKind::weakly_compressible);
  for (const auto& basis : kLattices) {
    const Limits limits = limits_of(basis);
    std::printf("%zu per cell: %.3f H/c0 without friction, %.3f with it; used: %.3f\n",
                basis.size(), limits.frictionless, limits.rubbing, kAcousticCfl);
    EXPECT_LE(most * kAcousticCfl, limits.rubbing);
    EXPECT_GT(2.0 * kAcousticCfl, 1.4 * limits.frictionless);
  }
}

/// The largest eigenvalue of G / K for the wave k, by the power method from a skew start [1/m2].
double damping(const std::vector<Vector3>& places, double support, double length,
               const Vector3& k) {
  Vector3 way = {0.8, 0.5, 0.33};
  double largest = 0.0;
  for (int turn = 0; turn < 40; ++turn) {
    Vector3 next = {};
    for (const Vector3& x : places) {
      const double r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
      const double along = x[0] * way[0] + x[1] * way[1] + x[2] * way[2];
      const double wave = 1.0 - std::cos(k[0] * x[0] + k[1] * x[1] + k[2] * x[2]);
      const double weight =
          -kernel_gradient(std::sqrt(r2), support) * wave * along / (r2 + 0.01 * length * length);
      for (std::size_t a = 0; a < 3; ++a) next[a] += weight * x[a];
    }
    const double size = std::hypot(next[0], next[1], next[2]);
    largest = kSpacing * kSpacing * kSpacing * size;
    for (std::size_t a = 0; a < 3; ++a) way[a] = next[a] / std::max(size, 1.0e-12);
  }
  return largest;
}

/// What nu dt / h^2 may be at most: viscosity alone, explicit in time, is stable while 10 nu g dt <
/// 2, g the largest damping.
double viscous_limit(const std::vector<Vector3>& basis) {
  const double support = kSupportSpacings * kSpacing;
  const double length = kLengthOfSupport * support;
  const std::vector<Vector3> places = lattice(basis, kSpacing, support);
  constexpr int kParts = 9;
  double most = 0.0;
  for (int part = 1; part < kParts * kParts * kParts; ++part) {
    const auto at = [](int i) { return 6.5 / kSpacing * (i % kParts) / (kParts - 1.0); };
    most = std::max(most, damping(places, support, length,
                                  {at(part), at(part / kParts), at(part / kParts / kParts)}));
  }
  return 0.2 / (most * length * length);
}

// The longest step that a scene may ask for stays below it (time_step.cpp).
TEST(StepLimit, OfViscosityIsAboveTheLongestStep) {
  for (const auto& basis : kLattices) {
    FluidParams p = {};
    p.support = 1.0e6F;                                   // the sound sets no limit
    p.spacing = p.length = static_cast<float>(kSpacing);  // h is one spacing
    p.viscous = 1.0F;                                     // 10 nu
    const double most = StepPolicy::stable_factor(PressureKind::weakly_compressible);
    const double used = largest_time_step(p, 0.0, 0.0, most) * 0.1 / (kSpacing * kSpacing);
    const double limit = viscous_limit(basis);
    std::printf("%zu per cell: %.3f h^2/nu; used: %.3f\n", basis.size(), limit, used);
    EXPECT_LT(used, limit);
    EXPECT_GT(used, 0.75 * limit);
  }
}

}  // namespace
}  // namespace splash::sim
