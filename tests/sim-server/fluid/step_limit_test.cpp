// SPDX-License-Identifier: MIT
// How long a step may be by theory. Small motions of particles at rest on a lattice are waves
// e exp(i k x). By them the density of a particle, in that at rest, grows by i s . e,
//   s(k) = V sum_j F(|x_j|) x_j sin(k . x_j),
// grad W(x) = F x, V = m / rho0 the volume of a particle, and the sums of pressure/density.cl and
// pressure/acceleration.cl make
//   a = -c0^2 s (s . d) - G v,
//   G(k) = sum_j V K (-F_j) x_j x_j^T / (r_j^2 + eta^2) (1 - cos(k . x_j)),
// with K = 10 nu + alpha c0 h. Symplectic Euler, which is the leapfrog with the speeds half a step
// late, keeps them bounded while (omega dt)^2 + 2 gamma dt < 4, omega = c0 |s|.
// Where water is one particle thick, a particle changes its density by its own way u, too: by what
// the image behind the wall or body grows, g . u. These are two parts of one wave, so
//   a = -c0^2 (g g^T + s s^T) u,   omega^2 <= c0^2 (|g|^2 + |s|^2),
// g and the place at which the film has the density at rest by the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/fluid/boundary/boundary.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.02;  ///< as in the built-in scenes, 0.016 to 0.03 m
constexpr double kSupport = kSupportSpacings * kSpacing;
constexpr double kLength = kLengthOfSupport * kSupport;     ///< h [m]
constexpr double kVolume = kSpacing * kSpacing * kSpacing;  ///< of a particle [m3]
constexpr double kSound = 13.0;                             ///< [m/s]

/// |s(k)| / V [1/m4].
double steepness(const std::vector<Vector3>& places, const Vector3& k) {
  Vector3 s = {};
  for (const Vector3& x : places) {
    s = s + std::sin(dot(k, x)) * kernel_gradient(length(x), kSupport) * x;
  }
  return length(s);
}

/// The places of a lattice around a particle, within the support [m]: `basis` [1] are those in one
/// cube, whose particles have `spacing`^3 each.
std::vector<Vector3> lattice(const std::vector<Vector3>& basis, double spacing = kSpacing) {
  const double edge = spacing * std::cbrt(static_cast<double>(basis.size()));
  std::vector<Vector3> places;
  constexpr int kFar = 4;
  for (int i = -kFar; i <= kFar; ++i) {
    for (int j = -kFar; j <= kFar; ++j) {
      for (int k = -kFar; k <= kFar; ++k) {
        for (const Vector3& b : basis) {
          const Vector3 x = {(i + b[0]) * edge, (j + b[1]) * edge, (k + b[2]) * edge};
          const double r = length(x);
          if (r > 1.0e-9 && r < kSupport) places.push_back(x);
        }
      }
    }
  }
  return places;
}

/// The largest |s(k)| of all waves, by climbing from many places [1/m]. `places` are the
/// neighbours [m], `volume` a particle's [m3].
double steepest_wave(const std::vector<Vector3>& places, double volume) {
  constexpr int kStarts = 7;
  const double unit = 1.0 / std::cbrt(volume);
  double best = 0.0;
  for (int start = 0; start < kStarts * kStarts * kStarts; ++start) {
    const auto at = [&](int part) { return 6.5 * unit * (part % kStarts) / (kStarts - 1.0); };
    Vector3 k = {at(start), at(start / kStarts), at(start / kStarts / kStarts)};
    double here = steepness(places, k);
    for (double step = 0.5 * unit; step > 1.0e-3 * unit; step /= 2.0) {
      for (std::size_t a = 0; a < 6; ++a) {
        Vector3 next = k;
        next[a / 2] += a % 2 == 0 ? step : -step;
        const double there = steepness(places, next);
        if (!(there > here)) continue;
        here = there;
        k = next;
      }
    }
    best = std::max(best, here);
  }
  return volume * best;
}

/// The trace of G / K for the shortest waves, 1 - cos = 2: no gamma is larger [1/m2].
double friction(const std::vector<Vector3>& places) {
  double sum = 0.0;
  for (const Vector3& x : places) {
    const double r2 = dot(x, x);
    sum -= 2.0 * kernel_gradient(std::sqrt(r2), kSupport) * r2 / (r2 + 0.01 * kLength * kLength);
  }
  return kVolume * sum / 3.0;  // alike along the three axes
}

struct Limits {
  double frictionless = 0.0;  ///< in H / c0 [1]
  double rubbing = 0.0;       ///< with the default viscosities
};

Limits limits_of(const std::vector<Vector3>& basis) {
  const std::vector<Vector3> places = lattice(basis);
  const double omega = kSound * steepest_wave(places, kVolume);
  const FluidSettings fluid;
  const double rub = 10.0 * fluid.viscosity + fluid.artificial * kSound * kLength;
  const double gamma = rub * friction(places);
  const double unit = kSupport / kSound;
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
double damping(const std::vector<Vector3>& places, const Vector3& k) {
  Vector3 way = {0.8, 0.5, 0.33};
  double largest = 0.0;
  for (int turn = 0; turn < 40; ++turn) {
    Vector3 next = {};
    for (const Vector3& x : places) {
      const double r2 = dot(x, x);
      const double wave = 1.0 - std::cos(dot(k, x));
      const double weight = -kernel_gradient(std::sqrt(r2), kSupport) * wave * dot(x, way) /
                            (r2 + 0.01 * kLength * kLength);
      next = next + weight * x;
    }
    const double size = length(next);
    largest = kVolume * size;
    way = (1.0 / std::max(size, 1.0e-12)) * next;
  }
  return largest;
}

/// What nu dt / h^2 may be at most: viscosity alone, explicit in time, is stable while 10 nu g dt <
/// 2, g the largest damping.
double viscous_limit(const std::vector<Vector3>& basis) {
  const std::vector<Vector3> places = lattice(basis);
  constexpr int kParts = 9;
  double most = 0.0;
  for (int part = 1; part < kParts * kParts * kParts; ++part) {
    const auto at = [](int i) { return 6.5 / kSpacing * (i % kParts) / (kParts - 1.0); };
    const Vector3 k = {at(part), at(part / kParts), at(part / kParts / kParts)};
    most = std::max(most, damping(places, k));
  }
  return 0.2 / (most * kLength * kLength);
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

constexpr int kReach = 4;  ///< of a film, from its middle particle [particles]
constexpr auto kMiddle = std::size_t{2} * kReach * (kReach + 1);

struct Ground {
  FluidState state;
  Vector3 middle = {};  ///< of its face [m]
};

/// The floor of a wide tank.
Ground floor_of_tank() {
  const double width = 21.0 * kSpacing;
  const Scene scene = tank_scene(kSpacing, {width, width, 30.0 * kSpacing}, 8.0 * kSpacing);
  Ground ground;
  ground.state.params = make_params(scene, initial_particles(scene));
  ground.middle = {0.5 * width, 0.5 * width, 0.0};
  return ground;
}

/// The top of a plate in it, far from its walls. Its own points are a lattice, and the film's
/// middle one lies `aside` of one of them.
Ground plate(const Vector3& aside) {
  Ground ground = floor_of_tank();
  BodySettings body;
  body.shape.size = {13.0 * kSpacing, 13.0 * kSpacing, 3.0 * kSpacing};
  const Vector3 centre = ground.middle + Vector3{0.0, 0.0, 12.0 * kSpacing};
  for (const BodyPoint& point : sample_bodies({body}, kSpacing, kSupport)) {
    ground.state.body_position.push_back(centre + point.place);
    ground.state.body_volume.push_back(point.volume);
  }
  ground.state.shapes = body_outlines({body}).shapes;
  ground.state.fields.resize(1);
  BodyStep step = {};
  step.px = static_cast<float>(centre[0]);
  step.py = static_cast<float>(centre[1]);
  step.pz = static_cast<float>(centre[2]);
  step.qw = 1.0F;
  ground.state.bodies = {step};
  ground.middle = centre + Vector3{0.0, 0.0, 1.5 * kSpacing} + aside;
  return ground;
}

/// Of the film's middle particle, in that at rest, where the film is `height` above the ground, its
/// particles `stretch` spacings apart, and that one `way` from its place [1].
double density(const Ground& ground, double stretch, double height, const Vector3& way) {
  FluidState film = ground.state;
  for (int i = -kReach; i <= kReach; ++i) {
    for (int j = -kReach; j <= kReach; ++j) {
      const double edge = stretch * kSpacing;
      film.position.push_back(ground.middle + Vector3{i * edge, j * edge, height});
    }
  }
  film.position[kMiddle] = film.position[kMiddle] + way;
  return reference_density(film)[kMiddle] / static_cast<double>(film.params.rest_density);
}

/// Where the film has the density at rest [m].
double height_at_rest(const Ground& ground, double stretch) {
  double low = 0.05 * kSpacing;
  double high = kSpacing;
  while (high - low > 1.0e-6 * kSpacing) {
    const double middle = 0.5 * (low + high);
    (density(ground, stretch, middle, {}) > 1.0 ? low : high) = middle;
  }
  return low;
}

/// Of the density's growth by a particle's own way, |g| [1/m].
double growth(const Ground& ground, double stretch, double height) {
  const auto moved = [&](const Vector3& way) { return density(ground, stretch, height, way); };
  const double step = 1.0e-3 * kSpacing;
  return length(differences(moved, {0.0, 0.0, 0.0}, step)) / (2.0 * step);
}

/// |s|, the largest, of a film's particles among each other [1/m].
double growth_within(const Ground& ground, double stretch) {
  std::vector<Vector3> plane;
  for (const Vector3& x : lattice({{0, 0, 0}}, stretch * kSpacing)) {
    if (x[2] == 0.0) plane.push_back(x);
  }
  const FluidParams& p = ground.state.params;
  return steepest_wave(plane, static_cast<double>(p.mass / p.rest_density));
}

/// How long a step may be without friction, in H / c0 [1].
double limit(const Ground& ground, double stretch) {
  const double height = height_at_rest(ground, stretch);
  const double swing =
      std::hypot(growth(ground, stretch, height), growth_within(ground, stretch)) * kSupport;
  std::printf("stretched by %.2f: %.3f spacings high, %.2f c0/H, steps of %.3f H/c0; used: %.3f\n",
              stretch, height / kSpacing, swing, 2.0 / swing, kAcousticCfl);
  return 2.0 / swing;
}

// With the mirror image's weight as it is nearer than half a spacing (boundary/walls.h) these were
// 0.54 to 0.57.
TEST(FilmLimit, OnAWallIsAboveTheDefault) {
  for (const double stretch : {1.05, 1.0, 0.95}) {
    EXPECT_GT(limit(floor_of_tank(), stretch), kAcousticCfl);
  }
}

TEST(FilmLimit, OnABodyIsAboveTheDefault) {
  for (const double part : {0.0, 0.25, 0.5}) {
    const Ground ground = plate({part * kSpacing, part * kSpacing, 0.0});
    for (const double stretch : {1.05, 1.0, 0.95}) {
      EXPECT_GT(limit(ground, stretch), kAcousticCfl) << part << " spacings aside";
    }
  }
}

}  // namespace
}  // namespace splash::sim
