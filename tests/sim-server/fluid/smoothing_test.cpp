// SPDX-License-Identifier: MIT
// The smoothing kernel against numeric integrals and derivatives.
#include "sim-server/fluid/params/smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace splash::sim {
namespace {

constexpr double kSupport = 0.037;

/// Simpson's rule.
double integral(double from, double to, const std::function<double(double)>& f) {
  constexpr int kParts = 2000;
  const double step = (to - from) / kParts;
  double sum = f(from) + f(to);
  for (int k = 1; k < kParts; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * f(from + k * step);
  return sum * step / 3.0;
}

TEST(Smoothing, WeighsOne) {
  const double weight = integral(0.0, kSupport, [](double r) {
    return 4.0 * std::numbers::pi * r * r * kernel_value(r, kSupport);
  });
  EXPECT_NEAR(weight, 1.0, 1.0e-9);
}

TEST(Smoothing, IsTheSameFromTheSquare) {
  const SmoothingKernel kernel(kSupport);
  const double peak = kernel_value(0.0, kSupport);
  for (double r = 0.0; r < 1.2 * kSupport; r += 0.01 * kSupport) {
    EXPECT_NEAR(kernel.of_square(r * r), kernel_value(r, kSupport), 1.0e-14 * peak) << r;
  }
}

TEST(Smoothing, EndsAtTheSupport) {
  EXPECT_EQ(kernel_value(kSupport, kSupport), 0.0);
  EXPECT_EQ(kernel_value(2.0 * kSupport, kSupport), 0.0);
  EXPECT_EQ(kernel_gradient(1.001 * kSupport, kSupport), 0.0);
  const double peak = plane_marginal(0.0, kSupport);
  EXPECT_NEAR(plane_marginal(kSupport, kSupport) / peak, 0.0, 1.0e-13);
  EXPECT_NEAR(plane_marginal(-1.5 * kSupport, kSupport) / peak, 0.0, 1.0e-13);
}

TEST(Smoothing, GradientIsTheSlope) {
  for (const double q : {0.01, 0.15, 0.2, 0.5, 0.6, 0.8, 0.99}) {
    const double r = q * kSupport;
    const double step = 1.0e-6 * kSupport;
    const double slope =
        (kernel_value(r + step, kSupport) - kernel_value(r - step, kSupport)) / (2.0 * step);
    EXPECT_NEAR(kernel_gradient(r, kSupport) * r / slope, 1.0, 1.0e-4) << "q = " << q;
  }
}

TEST(Smoothing, MarginalIsTheIntegralOverThePlane) {
  const double peak = plane_marginal(0.0, kSupport);
  for (const double q : {0.0, 0.1, 0.25, 0.5, 0.75, 0.95}) {
    const double z = q * kSupport;
    const double weight = integral(0.0, kSupport, [z](double s) {
      return 2.0 * std::numbers::pi * s * kernel_value(std::hypot(s, z), kSupport);
    });
    EXPECT_NEAR(plane_marginal(z, kSupport) / peak, weight / peak, 1.0e-8) << "q = " << q;
    EXPECT_EQ(plane_marginal(-z, kSupport), plane_marginal(z, kSupport));
  }
}

// The kernels' plane_marginal_fall relies on it.
TEST(Smoothing, MarginalFallsByTwoPiZW) {
  for (const double q : {0.05, 0.25, 0.5, 0.75, 0.9}) {
    const double z = q * kSupport;
    const double step = 1.0e-5 * kSupport;
    const double fall =
        (plane_marginal(z - step, kSupport) - plane_marginal(z + step, kSupport)) / (2.0 * step);
    EXPECT_NEAR(2.0 * std::numbers::pi * z * kernel_value(z, kSupport) / fall, 1.0, 1.0e-6)
        << "q = " << q;
  }
}

/// The kernel's Fourier transform at a wave number per spacing, 1 at 0.
double transform(double waves) {
  const double k = waves * kSupportSpacings / kSupport;
  return integral(0.0, kSupport, [&](double r) {
    return 4.0 * std::numbers::pi * r * std::sin(k * r) / k * kernel_value(r, kSupport);
  });
}

// So that a sum over neighbours says the same on every packing: nothing is left where the structure
// of packed particles begins, and nothing below zero before.
TEST(Smoothing, DoesNotSeeHowParticlesArePacked) {
  for (double waves = 0.5; waves < 5.5; waves += 0.1) EXPECT_GT(transform(waves), 1.0e-4);
  for (double waves = 5.5; waves < 12.0; waves += 0.1) {
    EXPECT_NEAR(transform(waves), 0.0, 2.0e-4) << waves;
  }
}

}  // namespace
}  // namespace splash::sim
