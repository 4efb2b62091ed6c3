// SPDX-License-Identifier: MIT
// The water at rest: as many particles as wanted, evenly spread, inside the tank, out of the
// bodies.
#include "sim-server/scene/initial_fluid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/scene/lattice.hpp"
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
    // Rows follow the slope; where it is shallower than a layer, the middle of the water is lower.
    const double floor = floor_height(scene, p[0]);
    EXPECT_GT(p[2], std::min(floor + 0.4 * spacing, floor + 0.4 * (0.2 - floor)));
    EXPECT_LT(p[2], 0.2);
  }
  EXPECT_GT(nearest_pair(particles), 0.5 * spacing);
}

BodySettings body(const Shape& shape, const Vector3& place, const Quaternion& turn = {0, 0, 0, 1}) {
  BodySettings body;
  body.shape = shape;
  body.rest.position = place;
  body.rest.rotation = turn;
  return body;
}

TEST(InitialFluid, BodiesDisplaceWater) {
  Scene scene = box({0.5, 0.5, 0.5}, 4000);
  const auto all = initial_particles(scene).size();
  const Quaternion upright = {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  scene.bodies = {body({ShapeKind::box, {0.3, 0.1, 0.08}, 0.0, 0.0}, {0.25, 0.25, 0.25}, upright)};
  const auto particles = initial_particles(scene);
  EXPECT_LT(particles.size(), all);
  for (const auto& p : particles) {
    const bool inside = std::abs(p[0] - 0.25) < 0.04 && std::abs(p[1] - 0.25) < 0.05 &&
                        std::abs(p[2] - 0.25) < 0.15;
    EXPECT_FALSE(inside) << p[0] << ' ' << p[1] << ' ' << p[2];
  }
  EXPECT_GT(nearest_pair(particles), 0.25 * particle_spacing(scene));
  const std::vector<Keyframe> away = {{0.0, {0.0, 0.0, 9.0}, {0.0, 0.0, 0.0, 1.0}}};
  EXPECT_EQ(initial_particles(scene, away).size(), all);
  EXPECT_THROW(static_cast<void>(initial_particles(scene, {})), std::invalid_argument);
}

/// A tank, what is in it, and the volume of its water by hand [m3].
struct Tub {
  const char* name;
  Vector3 size;
  std::vector<BodySettings> bodies;
  double displaced;
};

double sphere(double diameter) {
  return M_PI / 6.0 * diameter * diameter * diameter;
}

const Shape kBall = {ShapeKind::sphere, {0.12, 0.12, 0.12}};
const Shape kBoard = {ShapeKind::box, {0.01, 0.4, 0.6}};
const Shape kShoe = {ShapeKind::box, {0.29, 0.1, 0.07}, 0.03, 0.5};
const Quaternion kTilted = {0.0, std::sin(0.3), 0.0, std::cos(0.3)};

const std::vector<Tub> kTubs = {
    {"empty", {0.9, 0.4, 0.3}, {}, 0.0},
    {"odd_sides", {0.773, 0.391, 0.287}, {}, 0.0},
    {"flat", {1.213, 0.907, 0.101}, {}, 0.0},
    {"half_sunk_balls",
     {0.9, 0.4, 0.3},
     {body(kBall, {0.15, 0.2, 0.3}), body(kBall, {0.45, 0.2, 0.3}), body(kBall, {0.75, 0.2, 0.3})},
     1.5 * sphere(0.12)},
    {"sunken_balls",
     {0.9, 0.4, 0.3},
     {body(kBall, {0.15, 0.2, 0.06}), body(kBall, {0.45, 0.21, 0.15})},
     2.0 * sphere(0.12)},
    {"boards",
     {0.773, 0.4, 0.3},
     {body(kBoard, {0.111, 0.2, 0.3}), body(kBoard, {0.61, 0.2, 0.3})},
     2.0 * 0.01 * 0.4 * 0.3},
    {"tilted_box",
     {0.9, 0.4, 0.3},
     {body({ShapeKind::box, {0.2, 0.1, 0.05}}, {0.4, 0.2, 0.15}, kTilted)},
     0.2 * 0.1 * 0.05},
    {"shoe_on_the_floor", {0.9, 0.4, 0.3}, {body(kShoe, {0.4, 0.2, 0.035})}, volume_of(kShoe)},
    {"float",
     {0.8, 0.4, 0.4},
     {body({ShapeKind::box, {0.24, 0.24, 0.12}}, {0.4, 0.2, 0.42})},
     0.24 * 0.24 * 0.04},
};

class Volume : public ::testing::TestWithParam<std::tuple<Tub, int>> {};

TEST_P(Volume, IsThatOfTheBoxLessWhatBodiesDisplace) {
  const auto& [tub, particles] = GetParam();
  Scene scene = box(tub.size, particles);
  scene.bodies = tub.bodies;
  const double wanted = tub.size[0] * tub.size[1] * tub.size[2] - tub.displaced;
  const double there =
      static_cast<double>(initial_particles(scene).size()) * particle_volume(scene);
  EXPECT_NEAR(there / wanted, 1.0, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Tubs, Volume,
                         ::testing::Combine(::testing::ValuesIn(kTubs),
                                            ::testing::Values(1000, 3000, 7000, 15000, 30000)),
                         [](const auto& tub) {
                           return std::string(std::get<0>(tub.param).name) + "_" +
                                  std::to_string(std::get<1>(tub.param));
                         });

TEST(InitialFluid, ASlopesWaterIsWhatIsAboveIt) {
  for (const int particles : {1000, 3000, 15000}) {
    Scene scene = box({2.03, 0.51, 0.2}, particles);
    scene.slope = {true, 0.53, 0.12};
    const double there =
        static_cast<double>(initial_particles(scene).size()) * particle_volume(scene);
    EXPECT_NEAR(there / water_volume(scene), 1.0, 0.002) << particles;
  }
}

TEST(InitialFluid, RoundFormsAreFull) {
  for (const WaterForm form : {WaterForm::cylinder, WaterForm::sphere}) {
    Scene scene = box({0.4, 0.3, 0.4}, 2000);
    scene.water[0].form = form;
    const double there =
        static_cast<double>(initial_particles(scene).size()) * particle_volume(scene);
    EXPECT_NEAR(there / water_volume(scene), 1.0, 0.002);
  }
}

// Each weighs what its own depth compresses: 0.4 % more where it is 0.15 m deep, 0.8 where 0.3.
TEST(InitialFluid, EachOfTwoBasinsHasItsOwnWater) {
  for (const int particles : {1000, 3000, 15000}) {
    Scene scene = box({1.0, 0.31, 0.3}, particles);
    scene.water = {{{0.0, 0.0, 0.0}, {0.61, 0.31, 0.3}}, {{0.61, 0.0, 0.0}, {1.0, 0.31, 0.151}}};
    scene.gate = {true, 0.61};
    const InitialWater water = initial_water(scene, {}, scene_sound_speed(scene));
    const double left =
        static_cast<double>(std::count_if(water.particles.begin(), water.particles.end(),
                                          [](const Vector3& x) { return x[0] < 0.61; }));
    const double right = static_cast<double>(water.particles.size()) - left;
    const double unit =
        particle_volume(scene) * (1.0 + compression(scene, scene_sound_speed(scene)));
    const auto weight = [&](double length, double depth) {
      return length * 0.31 * depth *
             (1.0 + stratification(scene, scene_sound_speed(scene)) * depth / 2.0);
    };
    EXPECT_NEAR(left * unit / weight(0.61, 0.3), 1.0, 0.002) << particles;
    EXPECT_NEAR(right * unit / weight(0.39, 0.151), 1.0, 0.002 + 0.5 / right) << particles;
    EXPECT_NEAR(water.blocks[0].wanted, 0.61 * 0.31 * 0.3, 1e-9);
    EXPECT_NEAR(water.blocks[1].there / water.blocks[1].wanted, 1.0, 0.002 + 0.5 / right);
  }
}

TEST(InitialFluid, WhatHangsWeighsOnNothing) {
  Scene scene = box({0.5, 0.5, 0.3}, 4000);
  scene.water.push_back({{0.1, 0.1, 0.5}, {0.3, 0.3, 0.7}});
  const InitialWater water = initial_water(scene, {}, scene_sound_speed(scene));
  const auto drop = static_cast<double>(std::count_if(
      water.particles.begin(), water.particles.end(), [](const Vector3& x) { return x[2] > 0.4; }));
  const double unit = particle_volume(scene) * (1.0 + compression(scene, scene_sound_speed(scene)));
  EXPECT_NEAR(drop * unit, 0.2 * 0.2 * 0.2, 0.5 * unit);
}

// A slit between two boards has room for none.
TEST(InitialFluid, WhatFindsNoRoomLiesOnTop) {
  Scene scene = box({0.5, 0.3, 0.3}, 2000);
  const double gap = 0.3 * particle_spacing(scene);
  scene.bodies = {body({ShapeKind::box, {0.1, 0.3, 0.4}}, {0.2, 0.15, 0.2}),
                  body({ShapeKind::box, {0.1, 0.3, 0.4}}, {0.3 + gap, 0.15, 0.2})};
  const InitialWater water =
      initial_water(scene, std::vector<Keyframe>{scene.bodies[0].rest, scene.bodies[1].rest},
                    scene_sound_speed(scene));
  for (const Vector3& x : water.particles) {
    EXPECT_FALSE(x[0] > 0.24 && x[0] < 0.26 + gap) << x[0];
  }
  EXPECT_NEAR(water.blocks[0].wanted, 0.3 * 0.3 * 0.3, 1e-5);
  EXPECT_NEAR(water.blocks[0].there / water.blocks[0].wanted, 1.0, 0.002);
}

TEST(InitialFluid, IsTheSameEveryTime) {
  const Scene scene = box({0.5, 0.4, 0.3}, 2000);
  EXPECT_EQ(initial_particles(scene), initial_particles(scene));
}

}  // namespace
}  // namespace splash::sim
