// SPDX-License-Identifier: MIT
// Volumes against a sum over thin slices; spacing and sound speed against their formulas.
#include "sim-server/scene/resolution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/scene/step_policy.hpp"

namespace splash::sim {
namespace {

Scene beach() {
  Scene scene;
  scene.tank = {{-1.0, 0.0, 0.1}, {2.0, 1.0, 1.0}};
  scene.slope = {true, 0.25, 0.15};
  scene.water = {{{-1.0, 0.0, 0.1}, {2.0, 0.5, 0.3}}, {{-1.0, 0.5, 0.2}, {2.0, 1.0, 0.4}}};
  scene.fluid.particles = 5000;
  return scene;
}

double volume_by_slices(const Scene& scene) {
  constexpr int kSlices = 300000;
  double volume = 0.0;
  for (const auto& block : scene.water) {
    const double dx = (block.upper[0] - block.lower[0]) / kSlices;
    for (int i = 0; i < kSlices; ++i) {
      const double x = block.lower[0] + (i + 0.5) * dx;
      const double bottom = std::max(block.lower[2], floor_height(scene, x));
      volume += std::max(0.0, block.upper[2] - bottom) * dx * (block.upper[1] - block.lower[1]);
    }
  }
  return volume;
}

TEST(Resolution, VolumeOfRoundForms) {
  Scene scene = beach();
  scene.slope.present = false;
  scene.water = {{{0.0, 0.0, 0.2}, {0.2, 0.5, 0.4}, WaterForm::cylinder}};
  EXPECT_NEAR(water_volume(scene), M_PI * 0.01 * 0.5, 1e-12);
  scene.water = {{{0.0, 0.0, 0.2}, {0.2, 0.2, 0.4}, WaterForm::sphere}};
  EXPECT_NEAR(water_volume(scene), 4.0 / 3.0 * M_PI * 1e-3, 1e-12);
}

TEST(Resolution, VolumeIsCutByTheSlope) {
  Scene scene = beach();
  EXPECT_NEAR(water_volume(scene), volume_by_slices(scene), 1e-6);
  scene.slope.foot = 1.9;  // ends below the level
  EXPECT_NEAR(water_volume(scene), volume_by_slices(scene), 1e-6);
  scene.slope.present = false;
  EXPECT_NEAR(water_volume(scene), 3.0 * 0.5 * 0.2 + 3.0 * 0.5 * 0.2, 1e-12);
}

TEST(Resolution, FloorRisesFromTheFootOfTheSlope) {
  const Scene scene = beach();
  EXPECT_DOUBLE_EQ(floor_height(scene, 0.0), 0.1);
  EXPECT_DOUBLE_EQ(floor_height(scene, 1.25), 0.25);
}

TEST(Resolution, SpacingFollowsFromTheNumberOfParticles) {
  Scene scene = beach();
  const double spacing = particle_spacing(scene);
  EXPECT_NEAR(water_volume(scene) / (spacing * spacing * spacing), 5000.0, 1e-6);
  scene.fluid.spacing = 0.07;
  EXPECT_DOUBLE_EQ(particle_spacing(scene), 0.07);
}

TEST(Resolution, SoundIsFastEnoughForWhatFalls) {
  Scene scene = beach();
  scene.slope.present = false;
  scene.water = {{{0.0, 0.0, 0.1}, {1.0, 1.0, 0.3}}};
  BodySettings body;
  body.rest.position = {0.0, 0.5, 5.1};
  scene.bodies = {body};
  EXPECT_EQ(fastest_fall(scene), 0.0) << "neither falls";
  scene.bodies[0].motion.kind = MotionKind::free;
  EXPECT_NEAR(fastest_fall(scene), std::sqrt(2.0 * 9.81 * 5.0), 1e-9);
  EXPECT_NEAR(scene_sound_speed(scene), std::sqrt(2.0 * 9.81 * 5.0) / 0.3, 1e-9);
  scene.bodies[0].motion.velocity = {3.0, 0.0, 4.0};
  EXPECT_NEAR(fastest_fall(scene), std::sqrt(2.0 * 9.81 * 5.0 + 25.0), 1e-9);
  scene.bodies.clear();
  scene.water.push_back({{0.0, 0.0, 2.1}, {1.0, 1.0, 2.3}});
  EXPECT_NEAR(fastest_fall(scene), std::sqrt(2.0 * 9.81 * 2.0), 1e-9);
  scene.fluid.gravity = {0.0, 0.0, 9.81};
  EXPECT_EQ(fastest_fall(scene), 0.0) << "it leaves the tank, nobody knows how fast";
  scene.fluid.gravity = {-2.0, 0.0, 0.0};
  EXPECT_NEAR(fastest_fall(scene), 2.0, 1e-9) << "to the left side";
}

TEST(Resolution, SoundIsFastEnoughForThePiston) {
  Scene scene = beach();
  scene.wave_maker = {true, 1.35, 0.2};
  EXPECT_NEAR(fastest_piston(scene.wave_maker), M_PI * 1.35 / 0.2, 1e-9);
  EXPECT_NEAR(scene_sound_speed(scene), M_PI * 1.35 / 0.2 / 0.3, 1e-9);
  EXPECT_NEAR(slowest_sound(scene), M_PI * 1.35 / 0.2 / std::sqrt(2.0) * 4.0, 1e-9);
  scene.wave_maker = {true, 0.15, 2.0};
  EXPECT_DOUBLE_EQ(scene_sound_speed(scene), scene_sound_speed(beach()));
}

// In a central field of rate k the energy per mass is (k r)^2 / 2.
TEST(Resolution, SoundIsFastEnoughForTheCentralField) {
  Scene scene = beach();
  scene.slope.present = false;
  scene.fluid.gravity = {0.0, 0.0, 0.0};
  scene.water = {{{0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}}};
  scene.fluid.pull = {0.0, 0.0, 100.0};
  scene.fluid.pull_centre = {0.5, 0.5, 0.5};
  EXPECT_NEAR(longest_wave(scene), std::sqrt(0.5) * 100.0 * 0.1, 1e-9);
  EXPECT_EQ(fastest_fall(scene), 0.0) << "it is where it is drawn to";
  EXPECT_NEAR(scene_sound_speed(scene), 8.0 * std::sqrt(0.5) * 10.0, 1e-9);
  scene.fluid.pull_centre[2] = 0.9;
  EXPECT_NEAR(longest_wave(scene), std::sqrt(0.5 * (0.25 - 0.09)) * 100.0, 1e-9);
  EXPECT_NEAR(fastest_fall(scene), 40.0, 1e-9);
  EXPECT_NEAR(scene_sound_speed(scene), 8.0 * longest_wave(scene), 1e-9);
  scene.fluid.pull_centre[2] = 2.5;
  EXPECT_NEAR(fastest_fall(scene), 100.0 * std::sqrt(4.0 - 2.25), 1e-9)
      << "up to the rim, 1 m high";
}

TEST(Resolution, DepthIsThatOfAColumn) {
  Scene scene = beach();
  EXPECT_DOUBLE_EQ(water_depth(scene), 0.2) << "the higher block hangs above the floor";
  scene.water.push_back({{-1.0, 0.5, 5.0}, {0.0, 1.0, 5.1}});
  EXPECT_DOUBLE_EQ(water_depth(scene), 0.2) << "a block far above adds nothing";
  scene.water.back() = {{-1.0, 0.5, 0.4}, {0.0, 1.0, 0.5}};
  EXPECT_DOUBLE_EQ(water_depth(scene), 0.3) << "one that lies on another does";
  const WaterColumn column = water_column(scene, {-0.5, 0.7, 0.25});
  EXPECT_DOUBLE_EQ(column.bottom, 0.2);
  EXPECT_DOUBLE_EQ(column.top, 0.5);
  EXPECT_DOUBLE_EQ(water_column(scene, {1.25, 0.2, 0.28}).bottom, 0.25) << "on the slope";
}

TEST(Resolution, SoundIsEightTimesTheWaveSpeedButNeverTooSlow) {
  Scene scene = beach();
  scene.water[1].lower[2] = 0.1;
  EXPECT_DOUBLE_EQ(water_depth(scene), 0.4 - 0.1);
  EXPECT_NEAR(scene_sound_speed(scene), 8.0 * std::sqrt(9.81 * 0.3), 1e-9);
  scene.water[1].upper[2] = 0.12;
  scene.water[0].upper[2] = 0.12;
  EXPECT_GE(scene_sound_speed(scene), 13.0);
  EXPECT_DOUBLE_EQ(scene_sound_speed(scene, 3.0), scene_sound_speed(scene)) << "fast enough";
  EXPECT_DOUBLE_EQ(scene_sound_speed(scene, 12.0), 40.0) << "Mach 0.3";
  scene.fluid.time_step_factor = 2.1;
  EXPECT_DOUBLE_EQ(scene_sound_speed(scene), 6.5) << "half, by which steps are longer";
  EXPECT_DOUBLE_EQ(scene_sound_speed(scene, 12.0), 40.0) << "but not below what bodies need";
  EXPECT_DOUBLE_EQ(StepPolicy(scene.fluid).factor(), 1.05);
  scene.fluid.sound_speed = 33.0;
  EXPECT_DOUBLE_EQ(scene_sound_speed(scene), 33.0);
  EXPECT_DOUBLE_EQ(scene_sound_speed(scene, 12.0), 33.0) << "the scene's own wish";
}

}  // namespace
}  // namespace splash::sim
