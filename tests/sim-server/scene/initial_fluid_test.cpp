// SPDX-License-Identifier: MIT
// The water at rest: as many particles as wanted, evenly spread, inside the tank, out of the
// bodies.
#include "sim-server/scene/initial_fluid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

Scene box(const Vector3& size, int particles) {
  Scene scene;
  scene.tank = {{0.0, 0.0, 0.0}, {size[0], size[1], size[2] + 0.5}};
  scene.water = {{{0.0, 0.0, 0.0}, size}};
  scene.fluid.particles = particles;
  return scene;
}

double distance(const Vector3& a, const Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double nearest_pair(const std::vector<Vector3>& points) {
  double nearest = 1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) nearest = std::min(nearest, distance(points[i], points[k]));
  }
  return nearest;
}

TEST(InitialFluid, NumberIsWithinThreePercent) {
  for (const int wanted : {800, 1234, 3500, 7000, 12000, 15000, 40000}) {
    for (const Vector3& size : {Vector3{0.5, 0.5, 0.5}, Vector3{1.83, 1.83, 0.2},
                                Vector3{1.55, 0.9, 0.09}, Vector3{0.3, 0.3, 0.3}}) {
      const auto number = initial_particles(box(size, wanted)).size();
      EXPECT_NEAR(static_cast<double>(number), wanted, 0.03 * wanted)
          << size[0] << " x " << size[1] << " x " << size[2];
    }
  }
}

TEST(InitialFluid, FillsTheBlockExactly) {
  const Vector3 size = {1.55, 0.9, 0.09};
  const Scene scene = box(size, 3000);
  const auto particles = initial_particles(scene);
  const double spacing = particle_spacing(scene);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto by_axis = [i](const Vector3& a, const Vector3& b) { return a[i] < b[i]; };
    const auto [low, high] = std::minmax_element(particles.begin(), particles.end(), by_axis);
    EXPECT_NEAR((*low)[i], size[i] - (*high)[i], 1e-12) << "centred";
    EXPECT_NEAR((*low)[i], 0.5 * spacing, 0.1 * spacing) << "half a spacing from the walls";
  }
  EXPECT_GT(nearest_pair(particles), 0.85 * spacing);
}

TEST(InitialFluid, SlopeCutsWithoutCrowding) {
  Scene scene = box({2.0, 0.5, 0.2}, 3000);
  scene.slope = {true, 0.5, 0.12};
  const auto particles = initial_particles(scene);
  const double spacing = particle_spacing(scene);
  EXPECT_NEAR(static_cast<double>(particles.size()), 3000, 90);
  for (const auto& p : particles) {
    EXPECT_GT(p[2], floor_height(scene, p[0]) + 0.4 * spacing);
    EXPECT_LT(p[2], 0.2 + 0.5 * spacing);
  }
  EXPECT_GT(nearest_pair(particles), 0.85 * spacing);
}

TEST(InitialFluid, BodiesDisplaceWater) {
  Scene scene = box({0.5, 0.5, 0.5}, 4000);
  const auto all = initial_particles(scene).size();
  BodySettings body;
  body.shape = {ShapeKind::box, {0.3, 0.1, 0.08}, 0.0, 0.0};
  body.rest.position = {0.25, 0.25, 0.25};
  body.rest.rotation = {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};  // stands upright
  scene.bodies = {body};
  const auto particles = initial_particles(scene);
  const double gap = 0.5 * particle_spacing(scene);
  EXPECT_LT(particles.size(), all);
  for (const auto& p : particles) {
    const bool inside = std::abs(p[0] - 0.25) < 0.04 + gap * 0.99 && std::abs(p[1] - 0.25) < 0.05 &&
                        std::abs(p[2] - 0.25) < 0.15;
    EXPECT_FALSE(inside) << p[0] << ' ' << p[1] << ' ' << p[2];
  }
  const std::vector<Keyframe> away = {{0.0, {0.0, 0.0, 9.0}, {0.0, 0.0, 0.0, 1.0}}};
  EXPECT_EQ(initial_particles(scene, away).size(), all);
  EXPECT_THROW(static_cast<void>(initial_particles(scene, {})), std::invalid_argument);
}

TEST(InitialFluid, IsTheSameEveryTime) {
  const Scene scene = box({0.5, 0.4, 0.3}, 2000);
  EXPECT_EQ(initial_particles(scene), initial_particles(scene));
}

}  // namespace
}  // namespace splash::sim
