// SPDX-License-Identifier: MIT
// Pistons and central fields as fast and as strong as a scene may ask for: sound is fast enough for
// them, so no frame is given up; and water that never comes to rest is the scene's mistake.
#include <gtest/gtest.h>

#include "program/failure.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "sim-server/start/come_to_rest.hpp"

namespace splash::sim {
namespace {

void expect_sound(const std::string& scene, double seconds) {
  Device device;
  Simulation simulation(device, parse_scene(scene, "fast.yaml"), {});
  while (simulation.seconds() < seconds) static_cast<void>(simulation.advance());
  EXPECT_EQ(simulation.totals().calmed, 0U);
  EXPECT_EQ(simulation.totals().resets, 0U);
}

TEST(FastWater, FollowsAPistonOfTwentyMetresPerSecond) {
  expect_sound(
      "fluid: {spacing: 0.05, solver: weakly_compressible}\n"
      "tank: {lower: [0, 0, 0], upper: [3, 0.3, 1.5]}\n"
      "wave_maker: {stroke: 1.35, period: 0.2}\n"
      "water:\n"
      "  - {lower: [0, 0, 0], upper: [3, 0.3, 0.4]}\n",
      0.25);
}

TEST(FastWater, SwingsInAStrongCentralField) {
  expect_sound(
      "fluid: {spacing: 0.025, gravity: [0, 0, 0], pull: [100, 100, 100], "
      "pull_centre: [0.5, 0.5, 0.5]}\n"
      "tank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
      "water:\n"
      "  - {lower: [0.2, 0.4, 0.4], upper: [0.4, 0.6, 0.6], form: sphere}\n",
      0.1);
}

TEST(FastWater, ComesToRestUnderAStrongPull) {
  expect_sound(
      "fluid: {spacing: 0.05, pull: [0, 0, 100]}\n"
      "tank: {lower: [0, 0, 0], upper: [0.5, 0.5, 0.6]}\n"
      "water:\n"
      "  - {lower: [0, 0, 0], upper: [0.5, 0.5, 0.3]}\n",
      0.02);
}

// Each particle is thirty times as heavy as its place has room for.
TEST(FastWater, ThatDoesNotComeToRestIsAMistakeOfTheScene) {
  Device device;
  const Scene scene = parse_scene(
      "fluid: {spacing: 0.05}\n"
      "tank: {lower: [0, 0, 0], upper: [0.5, 0.5, 0.6]}\n"
      "water:\n"
      "  - {lower: [0, 0, 0], upper: [0.5, 0.5, 0.3]}\n",
      "heavy.yaml");
  const std::vector<Vector3> particles = initial_particles(scene);
  FluidParams params = make_params(scene, particles);
  params.mass *= 30.0F;
  Fluid fluid(device, params, particles, {}, {});
  const Bodies none({}, {}, scene_support(scene));
  try {
    come_to_rest(fluid, scene, none,
                 std::vector<SupportState>(particles.size(), SupportState::supported), {});
    FAIL() << "at rest";
  } catch (const program::Failure& failure) {
    EXPECT_EQ(failure.code(), program::kExitConfig);
    EXPECT_NE(std::string(failure.what()).find("does not come to rest before it begins"),
              std::string::npos);
    EXPECT_NE(std::string(failure.what()).find("fluid.pull"), std::string::npos);
  }
}

}  // namespace
}  // namespace splash::sim
