// SPDX-License-Identifier: MIT
// Which water something holds where a scene puts it, and which begins to flow or fall.
#include "sim-server/scene/support_state.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::sim {
namespace {

using Kinds = std::set<SupportState>;
const Kinds kHeld = {SupportState::supported};
const Kinds kFlows = {SupportState::flowing};
const Kinds kHangs = {SupportState::free_falling};

/// A tank 1 m long, 0.5 m wide and high, particles 25 mm apart.
Scene tank(std::vector<WaterBlock> water) {
  Scene scene;
  scene.fluid.spacing = 0.025;
  scene.tank.upper = {1.0, 0.5, 0.5};
  scene.water = std::move(water);
  return scene;
}

const WaterBlock kPool = {{0.0, 0.0, 0.0}, {1.0, 0.5, 0.2}};
const WaterBlock kDam = {{0.0, 0.0, 0.0}, {0.4, 0.5, 0.2}};
const WaterBlock kDrop = {{0.4, 0.2, 0.3}, {0.5, 0.3, 0.4}, WaterForm::sphere};

void add_box(Scene& scene, const Vector3& size, const Vector3& place) {
  BodySettings body;
  body.shape.size = size;
  body.rest.position = place;
  scene.bodies.push_back(body);
}

std::vector<SupportState> states(const Scene& scene) {
  std::vector<Keyframe> poses;
  for (const BodySettings& body : scene.bodies) poses.push_back(body.rest);
  return support_states(scene, poses, initial_particles(scene, poses));
}

Kinds kinds(const Scene& scene) {
  const std::vector<SupportState> all = states(scene);
  return {all.begin(), all.end()};
}

TEST(SupportState, LevelWaterFromWallToWallIsHeld) {
  EXPECT_EQ(kinds(tank({kPool})), kHeld);
  Scene open = tank({kPool});
  open.water[0].upper[2] = 0.5;
  EXPECT_EQ(kinds(open), kHeld) << "up to the brim";
}

TEST(SupportState, GapsAndStepsBelowTheSpacingDoNotCount) {
  EXPECT_EQ(kinds(tank({{{0.02, 0.01, 0.01}, {0.98, 0.5, 0.2}}})), kHeld);
  EXPECT_EQ(kinds(tank({kDam, {{0.4, 0.0, 0.0}, {1.0, 0.5, 0.23}}})), kHeld);
  EXPECT_EQ(kinds(tank({{{0.08, 0.0, 0.0}, {1.0, 0.5, 0.2}}})), kFlows);
  EXPECT_EQ(kinds(tank({kDam, {{0.4, 0.0, 0.0}, {1.0, 0.5, 0.3}}})), kFlows);
}

TEST(SupportState, ADamNeedsAGateOrABody) {
  EXPECT_EQ(kinds(tank({kDam})), kFlows);
  Scene gated = tank({kDam});
  gated.gate = {true, 0.4};
  EXPECT_EQ(kinds(gated), kHeld);
  gated.water.push_back({{0.4, 0.0, 0.0}, {1.0, 0.5, 0.1}});
  EXPECT_EQ(kinds(gated), kHeld) << "so does the bed on its other side";
  gated.water[1].upper[0] = 0.7;
  EXPECT_EQ(kinds(gated), Kinds({SupportState::supported, SupportState::flowing}))
      << "if a wall ends it";
  Scene walled = tank({kDam});
  add_box(walled, {0.01, 0.5, 0.5}, {0.405, 0.25, 0.25});
  EXPECT_EQ(kinds(walled), kHeld) << "a board thinner than a spacing";
  walled.bodies[0].rest.position[2] = 0.4;
  EXPECT_EQ(kinds(walled), kFlows) << "the board stands 15 cm above the floor";
}

TEST(SupportState, WhatIsInTheAirHangs) {
  EXPECT_EQ(kinds(tank({kDrop})), kHangs);
  EXPECT_EQ(kinds(tank({{{0.0, 0.0, 0.3}, {1.0, 0.5, 0.325}}})), kHangs) << "from wall to wall";
}

TEST(SupportState, EachBodyOfWaterIsLookedAtAlone) {
  const Scene scene = tank({kPool, kDrop});
  const std::vector<SupportState> all = states(scene);
  const std::vector<Vector3> places = initial_particles(scene);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i], places[i][2] < 0.25 ? SupportState::supported : SupportState::free_falling);
  }
}

TEST(SupportState, AColumnOnAPoolTakesThePoolAlong) {
  EXPECT_EQ(kinds(tank({kPool, {{0.4, 0.2, 0.2}, {0.5, 0.3, 0.4}}})), kFlows);
}

TEST(SupportState, ABasinOfBodiesHolds) {
  Scene scene = tank({{{0.3, 0.1, 0.2}, {0.6, 0.4, 0.35}}});
  add_box(scene, {0.4, 0.4, 0.05}, {0.45, 0.25, 0.175});
  for (const double side : {-1.0, 1.0}) {
    add_box(scene, {0.05, 0.4, 0.2}, {0.45 + side * 0.175, 0.25, 0.3});
    add_box(scene, {0.4, 0.05, 0.2}, {0.45, 0.25 + side * 0.175, 0.3});
  }
  EXPECT_EQ(kinds(scene), kHeld);
  scene.bodies.pop_back();
  EXPECT_EQ(kinds(scene), kFlows) << "it has lost a side";
}

TEST(SupportState, ABeachIsHeldUpToItsEdge) {
  Scene scene = tank({kPool});
  scene.slope = {true, 0.2, 0.4};
  EXPECT_EQ(kinds(scene), kHeld);
  scene.water[0].upper[0] = 0.5;
  EXPECT_EQ(kinds(scene), kFlows) << "8 cm deep where the block ends";
}

TEST(SupportState, TheWayDownIsThatOfTheField) {
  Scene scene = tank({kPool});
  scene.fluid.gravity = {0.0, 0.0, 0.0};
  EXPECT_EQ(kinds(scene), kHangs) << "nothing pulls it to the floor";
  scene.water = {kDrop};
  EXPECT_EQ(kinds(scene), kHangs);
  scene.fluid.pull = {10.0, 10.0, 10.0};
  scene.fluid.pull_centre = {0.45, 0.25, 0.35};
  EXPECT_EQ(kinds(scene), kHeld) << "round, about what it is drawn to";
  scene.fluid.pull_centre = {0.2, 0.25, 0.35};
  EXPECT_EQ(kinds(scene), kHangs) << "it will fly there";
  scene = tank({kPool});
  scene.fluid.gravity = {0.0, 0.0, 9.81};
  EXPECT_EQ(kinds(scene), kHangs) << "upwards the tank is open";
  scene.fluid.gravity = {6.9, 0.0, -6.9};
  EXPECT_EQ(kinds(scene), kFlows) << "tilted, it is not level";
}

/// All scenes that are shipped, and those that are compared with experiments.
std::vector<std::filesystem::path> scene_files() {
  std::vector<std::filesystem::path> all;
  for (const auto& folder :
       {tests::scene_folder(), tests::source_folder() / "tests/validation/scenes"}) {
    for (const std::string& name : tests::scene_names(folder))
      all.push_back(folder / (name + ".yaml"));
  }
  return all;
}

class HoldingOf : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(HoldingOf, AllItsWater) {
  const Scene scene = read_scene(GetParam());
  EXPECT_EQ(kinds(scene), scene.name == "elliptical_drop" ? kHangs : kHeld);
}

INSTANTIATE_TEST_SUITE_P(Scenes, HoldingOf, ::testing::ValuesIn(scene_files()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace splash::sim
