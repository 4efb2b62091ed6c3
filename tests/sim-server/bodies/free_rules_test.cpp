// SPDX-License-Identifier: MIT
// What scenes say of free bodies that are held, have an inertia of their own, or rub on something
// in a way of their own: read, and each mistake told at its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/refusal.hpp"

namespace splash::sim {
namespace {

using ::testing::HasSubstr;

std::string pool(const std::string& motion, const std::string& more = "") {
  return "fluid: {particles: 1000}\n"
         "tank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
         "water: [{lower: [0, 0, 0], upper: [1, 1, 0.5]}]\n"
         "bodies:\n"
         "  - name: post\n"
         "    shape: {size: [0.1, 0.1, 0.1]}\n"
         "    rest: {position: [0.2, 0.5, 0.8]}\n"
         "  - name: float\n"
         "    shape: {size: [0.1, 0.1, 0.1]}\n"
         "    rest: {position: [0.5, 0.5, 0.8]}\n"
         "    motion: {kind: free, mass: 0.5" +
         motion + "}\n" + more;
}

std::string refusal(const std::string& motion, const std::string& more = "") {
  return tests::refusal([&] { return parse_scene(pool(motion, more), "pool.yaml"); });
}

TEST(FreeRules, WhatIsHeldAndItsInertiaReachTheDevice) {
  const Scene scene =
      parse_scene(pool(", held: [x, rz], inertia: [0.001, 0.002, 0.0025]"), "pool.yaml");
  const FreeBody body = free_bodies(scene.bodies).at(0);
  EXPECT_EQ(body.held, 1 | 32);
  EXPECT_FLOAT_EQ(body.iy, 0.002F);
  EXPECT_FLOAT_EQ(body.mass, 0.5F);
  const Scene plain = parse_scene(pool(""), "pool.yaml");
  EXPECT_EQ(free_bodies(plain.bodies).at(0).held, 0);
  EXPECT_FLOAT_EQ(free_bodies(plain.bodies).at(0).iy, static_cast<float>(0.5 * 0.02 / 12.0));
}

TEST(FreeRules, FrictionsNameTwoOfWhichOneIsFree) {
  const Scene scene = parse_scene(pool("",
                                       "frictions:\n"
                                       "  - {between: [post, float], friction: 0.1}\n"
                                       "  - {between: [walls, float], friction: 0}\n"),
                                  "pool.yaml");
  ASSERT_EQ(scene.frictions.size(), 2U);
  EXPECT_EQ(scene.frictions[0].one, 0);
  EXPECT_EQ(scene.frictions[0].other, 1);
  EXPECT_EQ(scene.frictions[1].one, -1);
  const auto of_pair = [](const std::string& between) {
    return refusal("", "frictions: [{between: " + between + ", friction: 0.1}]\n");
  };
  EXPECT_THAT(of_pair("[post, flaot]"), HasSubstr("pool.yaml:12:"));
  EXPECT_THAT(of_pair("[post, flaot]"), HasSubstr("no body named 'flaot'"));
  EXPECT_THAT(of_pair("[post]"), HasSubstr("names two, not 1"));
  EXPECT_THAT(of_pair("[float, float]"), HasSubstr("the same twice"));
  EXPECT_THAT(of_pair("[post, walls]"), HasSubstr("no free body"));
  EXPECT_EQ(of_pair("[walls, float]"), "");
}

TEST(FreeRules, MistakesAreTold) {
  EXPECT_THAT(refusal(", held: [x, turn]"), HasSubstr("'turn' must be one of x, y, z, rx"));
  EXPECT_THAT(refusal(", held: [x], velocity: [1, 0, 0]"), HasSubstr("held by x, but its 'velo"));
  EXPECT_THAT(refusal(", held: [ry], spin: [0, 1, 0]"), HasSubstr("held by ry, but its 'spin'"));
  EXPECT_THAT(refusal(", inertia: [1, 2, 4]"), HasSubstr("about z is larger than the other two"));
  EXPECT_THAT(refusal(", inertia: [0, 1, 1]"), HasSubstr("inertia"));
  EXPECT_EQ(refusal(", held: [x], velocity: [0, 1, 0]"), "");
}

}  // namespace
}  // namespace splash::sim
