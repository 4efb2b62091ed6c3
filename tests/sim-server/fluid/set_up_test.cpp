// SPDX-License-Identifier: MIT
// From a scene to parameters, each against its formula.
#include "sim-server/fluid/set_up.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

Scene beach_scene() {
  Scene scene = tank_scene(0.02, {0.6, 0.2, 0.4}, 0.16);
  scene.slope = {true, 0.2, 0.3};
  scene.wave_maker = {true, 0.1, 2.0};
  scene.fluid.viscosity = 2.0e-6;
  scene.fluid.artificial = 0.07;
  scene.fluid.gravity = {0.5, -0.25, -9.5};
  scene.fluid.pull = {3.0, 0.0, 0.5};
  scene.fluid.pull_centre = {0.3, 0.2, -0.1};
  return scene;
}

TEST(SetUp, ParametersFollowTheirFormulas) {
  const Scene scene = beach_scene();
  const auto particles = initial_particles(scene);
  const FluidParams p = make_params(scene, particles);
  EXPECT_EQ(p.count, static_cast<int>(particles.size()));
  EXPECT_FLOAT_EQ(p.spacing, 0.02F);
  EXPECT_FLOAT_EQ(p.support, 0.05F);
  EXPECT_FLOAT_EQ(p.inverse_support, 20.0F);
  EXPECT_FLOAT_EQ(p.inverse_cell, 20.0F);
  EXPECT_FLOAT_EQ(p.kernel_norm, static_cast<float>(5775.0 / (512.0 * std::numbers::pi * 1.25e-4)));
  EXPECT_FLOAT_EQ(p.rest_density, 998.0F);
  EXPECT_FLOAT_EQ(p.sound_speed, 15.0F);
  EXPECT_FLOAT_EQ(p.viscous, 2.0e-5F);                   // 10 nu
  EXPECT_FLOAT_EQ(p.artificial, 0.07F * 15.0F * 0.02F);  // alpha c0 h, h = 0.4 H
  EXPECT_FLOAT_EQ(p.gravity_x, 0.5F);
  EXPECT_FLOAT_EQ(p.gravity_y, -0.25F);
  EXPECT_FLOAT_EQ(p.gravity_z, -9.5F);
  EXPECT_FLOAT_EQ(p.pull_x, 9.0F);
  EXPECT_FLOAT_EQ(p.pull_y, 0.0F);
  EXPECT_FLOAT_EQ(p.pull_z, 0.25F);
  EXPECT_FLOAT_EQ(p.centre_x, 0.3F);
  EXPECT_FLOAT_EQ(p.centre_z, -0.1F);
  EXPECT_FLOAT_EQ(p.mass, 998.0F * 8.0e-6F);  // gravity is not straight down: nothing settles
  EXPECT_FLOAT_EQ(p.layer_weight, 0.02F);
}

TEST(SetUp, GridCoversTheTankAndAMargin) {
  const Scene scene = beach_scene();
  const FluidParams p = make_params(scene, initial_particles(scene));
  const double cell = 1.0 / static_cast<double>(p.inverse_cell);
  EXPECT_FLOAT_EQ(p.origin_x, -0.05F);
  EXPECT_LE(static_cast<double>(p.origin_z) + cell, 1.0e-6);
  EXPECT_GE(static_cast<double>(p.origin_x) + (p.cells_x - 1) * cell, 0.6 - 1.0e-6);
  EXPECT_GE(static_cast<double>(p.origin_y) + (p.cells_y - 1) * cell, 0.2 - 1.0e-6);
  EXPECT_GE(static_cast<double>(p.origin_z) + (p.cells_z - 1) * cell, 0.9 - 1.0e-6);
}

TEST(SetUp, RefusesAGridTooLarge) {
  Scene scene = tank_scene(0.001, {4.0, 4.0, 4.0}, 0.1);
  try {
    static_cast<void>(make_params(scene, {{0.1, 0.1, 0.1}}));
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("64 million"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("spacing larger"), std::string::npos) << error.what();
  }
}

TEST(SetUp, WallsFaceTheWaterAndTouchTheTank) {
  const Scene scene = beach_scene();
  const FluidParams p = make_params(scene, initial_particles(scene));
  ASSERT_EQ(p.wall_count, 6);
  EXPECT_EQ(p.piston, 1);
  EXPECT_EQ(p.slope, 5);
  const Vector3 inside = {0.1, 0.1, 0.3};
  const double distances[] = {0.3, 0.1, 0.5, 0.1, 0.1};
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(wall_distance(p, k, inside, 0.0), distances[k], 1.0e-6) << "wall " << k;
  }
  EXPECT_NEAR(wall_distance(p, 1, inside, 0.03), 0.07, 1.0e-6);
  // The slope: z = 0.3 (x - 0.2).
  EXPECT_NEAR(wall_distance(p, 5, {0.2, 0.1, 0.0}, 0.0), 0.0, 1.0e-6);
  EXPECT_NEAR(wall_distance(p, 5, {0.5, 0.1, 0.09}, 0.0), 0.0, 1.0e-6);
  EXPECT_NEAR(wall_distance(p, 5, {0.5, 0.1, 0.19}, 0.0), 0.1 / std::hypot(0.3, 1.0), 1.0e-6);
}

TEST(SetUp, PlainTankHasNeitherPistonNorSlope) {
  const FluidParams p = make_params(tank_scene(0.02, {0.2, 0.2, 0.2}, 0.1), {{0.1, 0.1, 0.1}});
  EXPECT_EQ(p.wall_count, 5);
  EXPECT_EQ(p.piston, -1);
  EXPECT_EQ(p.slope, -1);
}

// What the mass and the layers behind walls are for. The kernel's sum over a cubic lattice is one
// to 2e-4.
TEST(SetUp, LatticeHasTheDensityAtRest) {
  Scene scene = tank_scene(0.02, {0.2, 0.16, 0.3}, 0.2);
  scene.fluid.gravity = {0.0, 0.0, 0.0};
  FluidState state;
  state.position = initial_particles(scene);
  state.params = make_params(scene, state.position);
  const std::vector<double> density = reference_density(state);
  for (std::size_t i = 0; i < density.size(); ++i) {
    const Vector3& x = state.position[i];
    if (x[2] > 0.2 - 0.05) continue;  // the surface has air above
    const bool inner = x[0] > 0.05 && x[0] < 0.15 && x[1] > 0.05 && x[1] < 0.11 && x[2] > 0.05;
    EXPECT_NEAR(density[i] / 998.0, 1.0, inner ? 2.0e-4 : 0.02)
        << x[0] << ' ' << x[1] << ' ' << x[2];
  }
}

// Compressed by its own weight the water still stands where the scene wants it.
TEST(SetUp, MassMakesUpForWhatSettles) {
  Scene scene = tank_scene(0.02, {0.2, 0.16, 0.3}, 0.2);
  const auto particles = initial_particles(scene);
  const double heavy = static_cast<double>(make_params(scene, particles).mass);
  scene.fluid.gravity = {0.0, 0.0, 0.0};
  const double light = static_cast<double>(make_params(scene, particles).mass);
  // Half of g H / c0^2.
  EXPECT_NEAR(heavy / light, 1.0 + 9.81 * 0.2 / (2.0 * 225.0), 1.0e-6);
}

TEST(SetUp, SettledWaterIsDenserBelowAndNoLower) {
  Scene scene = tank_scene(0.02, {0.2, 0.16, 0.3}, 0.2);
  const std::vector<Vector3> column = {
      {0.1, 0.1, 0.0}, {0.1, 0.1, 0.05}, {0.1, 0.1, 0.1}, {0.1, 0.1, 0.15}, {0.1, 0.1, 0.2}};
  const auto there = settled(scene, column, scene_sound_speed(scene));
  EXPECT_NEAR(there.front()[2], 0.0, 1.0e-12);
  EXPECT_NEAR(there.back()[2], 0.2, 1.0e-12);
  for (std::size_t k = 1; k < 4; ++k) {
    const double z = column[k][2];
    EXPECT_NEAR(there[k][2], z - 9.81 * z * (0.2 - z) / (2.0 * 225.0), 1.0e-9);
  }
  EXPECT_LT(there[1][2] - there[0][2], there[4][2] - there[3][2]);
  scene.fluid.gravity = {1.0, 0.0, -9.81};
  EXPECT_EQ(settled(scene, column, scene_sound_speed(scene)), column);
}

// In the air it weighs on nothing.
TEST(SetUp, HangingWaterStaysWhereItIs) {
  Scene scene = tank_scene(0.02, {0.2, 0.16, 0.6}, 0.2);
  scene.water.push_back({{0.04, 0.04, 0.4}, {0.16, 0.12, 0.5}});
  const std::vector<Vector3> places = {{0.1, 0.08, 0.1}, {0.04, 0.08, 0.45}};
  const auto there = settled(scene, places, scene_sound_speed(scene),
                             {SupportState::supported, SupportState::free_falling});
  EXPECT_NEAR(there[0][2], 0.1 - 9.81 * 0.1 * 0.1 / (2.0 * 225.0), 1.0e-9) << "as without it";
  EXPECT_EQ(there[1], places[1]);
}

TEST(SetUp, PistonMovesAsItsFormula) {
  const WaveMaker maker = {true, 0.1, 2.0};
  EXPECT_EQ(piston_at({false, 0.1, 2.0}, 1.0).offset, 0.0);
  EXPECT_EQ(piston_at(maker, -1.0).offset, 0.0);
  EXPECT_NEAR(piston_at(maker, 0.0).speed, 0.0, 1.0e-15);
  EXPECT_NEAR(piston_at(maker, 0.5).offset, 0.05, 1.0e-12);
  EXPECT_NEAR(piston_at(maker, 1.0).offset, 0.1, 1.0e-12);
  EXPECT_NEAR(piston_at(maker, 2.0).offset, 0.0, 1.0e-12);
  for (const double t : {0.1, 0.7, 1.3}) {
    const double numeric =
        (piston_at(maker, t + 1.0e-6).offset - piston_at(maker, t - 1.0e-6).offset) / 2.0e-6;
    EXPECT_NEAR(piston_at(maker, t).speed, numeric, 1.0e-7);
  }
}

}  // namespace
}  // namespace splash::sim
