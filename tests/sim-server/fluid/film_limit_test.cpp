// SPDX-License-Identifier: MIT
// How long a step may be where water is one particle thick. By its own way u a particle of a film
// changes its density by what the image behind the wall or body grows, g . u, and by what it moves
// along with its neighbours in the film, i s . u (lattice_waves.hpp): two parts of one wave, so
//   a = -c0^2 (g g^T + s s^T) u,   omega^2 <= c0^2 (|g|^2 + |s|^2),
// g and the place at which the film has the density at rest by the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/fluid/boundary/boundary.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/lattice_waves.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.02;
constexpr double kSupport = kSupportSpacings * kSpacing;
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
  const double step = 1.0e-3 * kSpacing;
  Vector3 g = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vector3 way = {};
    way[axis] = step;
    g[axis] =
        (density(ground, stretch, height, way) - density(ground, stretch, height, -1.0 * way)) /
        (2.0 * step);
  }
  return length(g);
}

/// |s|, the largest, of a film's particles among each other [1/m].
double growth_within(const Ground& ground, double stretch) {
  std::vector<Vector3> plane;
  for (const Vector3& x : lattice({{0, 0, 0}}, stretch * kSpacing, kSupport)) {
    if (x[2] == 0.0) plane.push_back(x);
  }
  const FluidParams& p = ground.state.params;
  return steepest_wave(plane, static_cast<double>(p.mass / p.rest_density), kSupport);
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
