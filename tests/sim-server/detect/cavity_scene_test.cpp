// SPDX-License-Identifier: MIT
// A hand in the whole simulation: a cavity closes behind it when it goes in fast and deep, once and
// in time, and never else. tests/detection has the sweeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "sim-server/detect/air_account.hpp"
#include "tests/sim-server/detect/scene_run.hpp"

namespace splash::sim {
namespace {

constexpr double kLevel = 0.45;
/// 2.285 sqrt(R / g) of 18 cm by 9 cm.
constexpr double kCloses = 0.1955;

/// Keyframes: time, height of its lowest edge above the level.
using Keys = std::vector<std::pair<double, double>>;

/// A hand of 4 cm on straight ways, turned so that its fingers are down.
std::string scene_of(const Keys& keys, const std::string& more = "", double degrees = 0.0,
                     double spacing = 0.03) {
  const double half = degrees * std::numbers::pi / 360.0;
  const double low = 0.09 * std::sin(2.0 * half) + 0.02 * std::cos(2.0 * half);
  std::string text = "fluid: {spacing: " + std::to_string(spacing) +
                     "}\n"
                     "tank: {lower: [-0.24, -0.21, 0], upper: [0.24, 0.21, 1]}\n"
                     "water: [{lower: [-0.24, -0.21, 0], upper: [0.24, 0.21, 0.45]}]\n"
                     "bodies:\n"
                     "  - name: hand\n"
                     "    shape: {kind: box, size: [0.18, 0.09, 0.04]}\n"
                     "    motion: {kind: script, smooth: false, keyframes: [";
  for (const auto& [time, height] : keys) {
    text += "{time: " + std::to_string(time) + ", position: [0, 0, " +
            std::to_string(kLevel + height + low) + "], rotation: [0, " +
            std::to_string(std::sin(half)) + ", 0, " + std::to_string(std::cos(half)) + "]}, ";
  }
  return text + "]}\n" + more;
}

/// Down from 10 cm above the level at a speed, to a depth, and rest there [m/s], [m].
Keys keys_of(double speed, double depth) {
  return {{0.0, 0.1}, {(0.1 + depth) / speed, -depth}, {9.0, -depth}};
}

std::string stroke(double speed, double depth, const std::string& more = "") {
  return scene_of(keys_of(speed, depth), more);
}

// On the grid particles meet on the axis where the hollow behind a disc at 5 m/s closes: for a
// moment they are more than twice too dense, and no water is stopped for that.
TEST(FastDisc, StopsNoWaterWhereItsHollowCloses) {
  const SceneRun run = run_scene(
      "fluid: {spacing: 0.01, solver: grid_projected}\n"
      "tank: {lower: [-0.15, -0.15, 0], upper: [0.15, 0.15, 1.2]}\n"
      "water: [{lower: [-0.15, -0.15, 0], upper: [0.15, 0.15, 0.24]}]\n"
      "bodies:\n"
      "  - name: disc\n"
      "    shape: {kind: cylinder, size: [0.05, 0.05, 0.02]}\n"
      "    motion: {kind: script, smooth: false, keyframes: [{time: 0, position: [0, 0, 0.75]}, "
      "{time: 0.13, position: [0, 0, 0.1]}, {time: 9, position: [0, 0, 0.1]}]}\n",
      0.35);
  EXPECT_EQ(run.found.impacts.size(), 1U);
  EXPECT_EQ(run.totals.calmed + run.totals.resets, 0U);
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

// The air is that of the hand's way, not of the hollow's cells.
TEST(CavityScene, HasTheSameAirAtAnySpacing) {
  const SceneRun coarse = run_scene(stroke(1.0, 0.3), 0.5);
  const SceneRun fine = run_scene(scene_of(keys_of(1.0, 0.3), "", 0.0, 0.02), 0.5);
  ASSERT_EQ(coarse.found.cavities.size(), 1U);
  ASSERT_EQ(fine.found.cavities.size(), 1U);
  const double ratio =
      bubble_volume(fine.found.cavities[0].radius) / bubble_volume(coarse.found.cavities[0].radius);
  std::printf("%.0f ml, 20 mm by 30 mm: %.2f\n",
              1e6 * bubble_volume(coarse.found.cavities[0].radius), ratio);
  EXPECT_NEAR(ratio, 1.0, 0.3);
  // 2 R^3 (1 + 0.26 Fr^1/2) Fr^1/2 less the hand, the 2 being 1.5 to 3.
  EXPECT_GT(bubble_volume(coarse.found.cavities[0].radius), 0.22e-3);
  EXPECT_LT(bubble_volume(coarse.found.cavities[0].radius), 1.1e-3);
}

// Its fingers meet the water long before the middle of what it shows from below is under it.
TEST(CavityScene, OfASlantedHandIsToldInTime) {
  for (const double degrees : {30.0, 45.0}) {
    const double turn = degrees * std::numbers::pi / 180.0;
    const double under = 0.18 * std::cos(turn);  // and its end, of the width that it shows
    const double end = 0.04 * std::sin(turn);
    const double low = 0.09 * std::sin(turn) + 0.02 * std::cos(turn);
    const double middle =
        (under * 0.02 * std::cos(turn) + end * 0.09 * std::sin(turn)) / (under + end);
    const double closes =
        2.285 * std::sqrt(std::sqrt((under + end) * 0.09 / std::numbers::pi) / 9.81);
    const double speed = 1.0;
    const double entry = (0.1 + low - middle) / speed;
    const SceneRun run = run_scene(scene_of(keys_of(speed, 0.33), "", degrees), entry + 0.3);
    ASSERT_EQ(run.found.cavities.size(), 1U) << degrees;
    EXPECT_NEAR(run.found.cavities[0].time - entry, closes, 0.15 * closes) << degrees;
  }
}

// The demo: a hand that comes down fingers first at up to 1 m/s and slows down.
TEST(CavityScene, IsToldOfTheBasinsFirstPlunge) {
  const std::string motion = std::string(SPLASH_SOURCE_DIR) + "/configs/scenes/basin_plunge.csv";
  const std::string scene =
      changed(scene_text("basin.yaml"), "file: basin_plunge.csv", "file: " + motion);
  const SceneRun run = run_scene(scene, 1.6);
  EXPECT_EQ(run.found.impacts.size(), 1U);
  ASSERT_EQ(run.found.cavities.size(), 1U);
  EXPECT_NEAR(run.found.cavities[0].time, 1.38, 0.03);
}

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
