// SPDX-License-Identifier: MIT
// From colour to distance and back, and against a lattice of particles itself.
#include "sim-server/detect/surface_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "sim-server/fluid/params/smoothing.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.0238;
constexpr double kSupport = kSupportSpacings * kSpacing;

/// Volume of a particle such that an unbounded cubic lattice has colour 1 [m3].
double particle_volume() {
  double sum = 0.0;
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      for (int k = -2; k <= 2; ++k) {
        sum += kernel_value(kSpacing * std::hypot(i, j, k), kSupport);
      }
    }
  }
  return 1.0 / sum;
}

SurfaceDistance make() {
  return {kSpacing, kSupport, particle_volume() / (kSpacing * kSpacing)};
}

/// Colour at height `d` over the surface of a perfect lattice whose top layer is as deep as that of
/// settled water, at `x`, `y` from a particle.
double lattice_colour(double x, double y, double d) {
  double colour = 0.0;
  for (int k = 0; k < 4; ++k) {
    for (int i = -3; i <= 4; ++i) {
      for (int j = -3; j <= 4; ++j) {
        const double depth = d + (k + 0.5 + kSurfaceLoss) * kSpacing;
        const double r = std::hypot(x - i * kSpacing, y - j * kSpacing, depth);
        colour += particle_volume() * kernel_value(r, kSupport);
      }
    }
  }
  return colour;
}

TEST(SurfaceDistance, InvertsTheColour) {
  const SurfaceDistance distance = make();
  for (double d = -0.5 * kSpacing; d <= 1.5 * kSpacing; d += 0.00317 * kSpacing) {
    // Near the rim the colour tells distances apart ever less.
    const double bound = d < 1.4 * kSpacing ? 1.0e-4 : 5.0e-3;
    ASSERT_NEAR(distance.distance_for(distance.colour_at(d)), d, bound * kSpacing) << d;
  }
}

TEST(SurfaceDistance, ColourFallsWithDistance) {
  const SurfaceDistance distance = make();
  double last = distance.colour_at(-0.5 * kSpacing);
  for (double d = -0.499 * kSpacing; d < 1.5 * kSpacing; d += 1.0e-3 * kSpacing) {
    const double colour = distance.colour_at(d);
    ASSERT_LT(colour, last) << d;
    last = colour;
  }
}

TEST(SurfaceDistance, DistanceFallsWithColour) {
  const SurfaceDistance distance = make();
  const double most = distance.colour_at(-0.5 * kSpacing);
  double last = distance.distance_for(0.0);
  for (double colour = 1.0e-4; colour < most; colour += 1.0e-3) {
    const double d = distance.distance_for(colour);
    ASSERT_LT(d, last) << colour;
    last = d;
  }
}

TEST(SurfaceDistance, KeepsItsBounds) {
  const SurfaceDistance distance = make();
  EXPECT_EQ(distance.distance_for(0.0), distance.farthest());
  EXPECT_EQ(distance.distance_for(-1.0), distance.farthest());
  EXPECT_DOUBLE_EQ(distance.distance_for(2.0), -(0.5 + kSurfaceLoss) * kSpacing);
  EXPECT_DOUBLE_EQ(distance.farthest(), (2.0 - kSurfaceLoss) * kSpacing);
  EXPECT_NEAR(distance.colour_at(distance.farthest()), 0.0, 1.0e-12);
}

// At the surface of half a lattice, half of the support is full but for its coarseness; one support
// deep, all of it.
TEST(SurfaceDistance, KnowsFullAndHalf) {
  EXPECT_NEAR(make().colour_at(-kSurfaceLoss * kSpacing), 0.5, 0.05);
  EXPECT_NEAR(make().colour_at(-3.0 * kSpacing), 1.0, 0.03);
}

// What bodies go by: the mean over points anywhere above the lattice.
TEST(SurfaceDistance, IsTheLatticesOnAverage) {
  const SurfaceDistance distance = make();
  double worst = 0.0;
  for (double d = -0.4; d <= 1.4; d += 0.05) {
    double mean = 0.0;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) {
        mean +=
            lattice_colour((i + 0.5) / 8.0 * kSpacing, (j + 0.5) / 8.0 * kSpacing, d * kSpacing) /
            64.0;
      }
    }
    const double error = distance.distance_for(mean) / kSpacing - d;
    worst = std::max(worst, std::abs(error));
    ASSERT_NEAR(error, 0.0, 0.03) << d << " spacings above";
  }
  std::printf("worst error of the mean over a lattice: %.4f spacings\n", worst);
}

// A single point sees the particles under it, too: over one it sees more, between them less. Where
// that would count, deep in the water and near the rim, bodies average over points.
TEST(SurfaceDistance, IsNearTheLatticesAtAnyPoint) {
  const SurfaceDistance distance = make();
  double worst = 0.0;
  for (double d = -0.3; d <= 1.1; d += 0.05) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}, {0.25, 0.25}}) {
      const double colour = lattice_colour(x * kSpacing, y * kSpacing, d * kSpacing);
      const double error = distance.distance_for(colour) / kSpacing - d;
      worst = std::max(worst, std::abs(error));
      ASSERT_NEAR(error, 0.0, 0.03) << d << " spacings above " << x << ", " << y;
    }
  }
  std::printf("worst error at a point over a lattice: %.4f spacings\n", worst);
}

}  // namespace
}  // namespace splash::sim
