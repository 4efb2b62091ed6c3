// SPDX-License-Identifier: MIT
// A hand in the whole simulation: a cavity closes behind it when it goes in fast and deep, once and
// in time, and never else. tests/detection has the sweeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim-server/detect/scene_run.hpp"

namespace splash::sim {
namespace {

constexpr double kLevel = 0.45;
/// 2.285 sqrt(R / g) of 18 cm by 9 cm.
constexpr double kCloses = 0.1955;

/// A hand of 4 cm on straight ways; keyframes: time, height of its underside above the level.
std::string scene_of(std::vector<std::pair<double, double>> keys, const std::string& more = "") {
  std::string text =
      "fluid: {spacing: 0.03}\n"
      "tank: {lower: [-0.24, -0.21, 0], upper: [0.24, 0.21, 1]}\n"
      "water: [{lower: [-0.24, -0.21, 0], upper: [0.24, 0.21, 0.45]}]\n"
      "bodies:\n"
      "  - name: hand\n"
      "    shape: {kind: box, size: [0.18, 0.09, 0.04]}\n"
      "    motion: {kind: script, smooth: false, keyframes: [";
  for (const auto& [time, height] : keys) {
    text += "{time: " + std::to_string(time) + ", position: [0, 0, " +
            std::to_string(kLevel + height + 0.02) + "]}, ";
  }
  return text + "]}\n" + more;
}

/// Down from 10 cm above the level at a speed, to a depth, and rest there [m/s], [m].
std::string stroke(double speed, double depth, const std::string& more = "") {
  return scene_of({{0.0, 0.1}, {(0.1 + depth) / speed, -depth}, {9.0, -depth}}, more);
}

class DeepStroke : public testing::TestWithParam<double> {};

TEST_P(DeepStroke, ShutsInOneCavity) {
  const double speed = GetParam();
  const double entry = 0.1 / speed;
  const SceneRun run = run_scene(stroke(speed, 0.3), entry + 0.6);
  ASSERT_EQ(run.found.cavities.size(), 1U);
  const DetectedCavity& cavity = run.found.cavities.front();
  std::printf("%.1f m/s: %.3f s after the entry, r %.0f mm, %.0f mm deep, eps %.4f, life %.2f s\n",
              speed, cavity.time - entry, 1e3 * cavity.radius, 1e3 * (kLevel - cavity.position[2]),
              cavity.epsilon, cavity.life);
  EXPECT_NEAR(cavity.time - entry, kCloses, 0.15 * kCloses);
  EXPECT_EQ(cavity.body, 0);
  EXPECT_GT(cavity.radius, 0.03);
  EXPECT_LT(cavity.radius, 0.1);
  EXPECT_LT(cavity.position[2], kLevel - 0.08);
  EXPECT_GE(cavity.epsilon, 0.002);
  EXPECT_LE(cavity.epsilon, 0.035);
  EXPECT_GT(cavity.life, 0.05);
  EXPECT_LT(cavity.life, 0.4);
  // The look is only worth while where one can close.
  EXPECT_GT(run.totals.skipped.cavities, static_cast<std::uint64_t>(run.totals.frames) / 2);
}

INSTANTIATE_TEST_SUITE_P(Speeds, DeepStroke, testing::Values(1.0, 1.5, 2.0));

TEST(CavityScene, IsNoneOfASlowOrShallowStroke) {
  EXPECT_TRUE(run_scene(stroke(0.3, 0.25), 0.1 / 0.3 + 0.9).found.cavities.empty());
  EXPECT_TRUE(run_scene(stroke(1.0, 0.06), 0.6).found.cavities.empty());
}

TEST(CavityScene, IsNoneOfAHandThatIsPulledOut) {
  for (const double speed : {1.0, 2.0}) {
    const double out = 0.5 + 0.3 / speed;
    const SceneRun run =
        run_scene(scene_of({{0.0, -0.15}, {0.5, -0.15}, {out, 0.15}, {9.0, 0.15}}), out + 0.6);
    EXPECT_TRUE(run.found.cavities.empty()) << speed;
  }
}

TEST(CavityScene, ByThePapersRuleHasThePapersValues) {
  const SceneRun run = run_scene(
      stroke(2.0, 0.3,
             "detect: {bubble_gradient: 0, bubble_per_particle: true, cavity_by_count: true}\n"),
      0.8);
  ASSERT_FALSE(run.found.cavities.empty());
  for (const DetectedCavity& cavity : run.found.cavities) {
    EXPECT_EQ(cavity.epsilon, 0.1);
    EXPECT_EQ(cavity.life, 0.0);
    EXPECT_GE(cavity.bubbles, 5);
  }
}

}  // namespace
}  // namespace splash::sim
