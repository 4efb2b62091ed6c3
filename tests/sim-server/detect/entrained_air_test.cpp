// SPDX-License-Identifier: MIT
// Air that a disc of 10 cm takes down, and water that falls into water: how it grows with speed,
// that half the spacing gives as much, and that it is not lost where slow water is skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "sim-server/detect/cavity_laws.hpp"
#include "tests/sim-server/detect/scene_run.hpp"

namespace splash::sim {
namespace {

constexpr double kGravity = 9.81;  ///< [m/s2]
constexpr double kDeep = 0.15;     ///< that the disc goes [m]

/// The disc goes 15 cm deep and stays there.
std::string entry_at(double speed, double spacing = 0.02) {
  const double begins = 0.28 + 0.1 * speed;  // height of its centre, its thickness being 2 cm [m]
  const double stops = (begins - 0.1) / speed;
  char text[700];
  std::snprintf(text, sizeof text,
                "fluid: {spacing: %g}\n"
                "tank: {lower: [-0.15, -0.15, 0], upper: [0.15, 0.15, 1]}\n"
                "water: [{lower: [-0.15, -0.15, 0], upper: [0.15, 0.15, 0.24]}]\n"
                "detect: {bubble_speed: 0.5}\n"
                "bodies:\n"
                "  - name: disc\n"
                "    shape: {kind: cylinder, size: [0.1, 0.1, 0.02]}\n"
                "    motion: {kind: script, smooth: false, keyframes: [\n"
                "      {time: 0, position: [0, 0, %g]}, {time: %g, position: [0, 0, 0.1]},\n"
                "      {time: 9, position: [0, 0, 0.1]}]}\n",
                spacing, begins, stops);
  return text;
}

/// Until 0.4 s after the disc has stopped [s].
double lasts(double speed) {
  return 0.1 + 0.18 / speed + 0.4;
}

SceneRun entry(double speed, double spacing = 0.02) {
  return run_scene(entry_at(speed, spacing), lasts(speed));
}

/// What wake_air.hpp's law gives the disc on its way [m3].
double law(double speed) {
  constexpr double kRadius = 0.05;  // [m]
  const double open = closing_time(kRadius, kGravity);
  const double all =
      0.06 * 1.1 * std::numbers::pi * kRadius * kRadius * (speed * speed - 0.3 * 0.3) / kGravity;
  return std::min(kDeep / (speed * open), 1.0) * all;
}

class Entry : public ::testing::TestWithParam<double> {};

TEST_P(Entry, HoldsTheAirOfTheLawAndAsManyBubblesWithHalfTheSpacing) {
  const SceneRun run = entry(GetParam());
  const SceneRun finer = entry(GetParam(), 0.01);
  const AirTotals& now = run.totals.air;
  const AirTotals& then = finer.totals.air;
  std::printf("%.1f m/s: %zu bubbles, %.1f ml of %.1f by the disc; finer %zu, %.1f of %.1f\n",
              GetParam(), run.found.bubbles.size(), 1e6 * now.by_bodies, 1e6 * now.entrapped,
              finer.found.bubbles.size(), 1e6 * then.by_bodies, 1e6 * then.entrapped);
  EXPECT_NEAR(now.by_bodies, law(GetParam()), 0.1 * law(GetParam()));
  EXPECT_NEAR(then.entrapped, now.entrapped, 0.15 * now.entrapped);
  const auto bubbles = static_cast<double>(run.found.bubbles.size());
  EXPECT_NEAR(static_cast<double>(finer.found.bubbles.size()), bubbles, 0.2 * bubbles);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Entry, ::testing::Values(1.0, 3.0));

/// What that law gives a sphere of 10 cm of radius that goes 0.24 m deep and stays there [m3].
double law_of_sphere(double speed) {
  constexpr double kRadius = 0.1;  // [m]
  constexpr int kRings = 1000;
  const double open = closing_time(kRadius, kGravity);
  double air = 0.0;
  for (int k = 0; k < kRings; ++k) {
    const double c = (k + 0.5) / kRings;  // normal along the way
    const double pushes = speed * c;
    if (pushes <= 0.3) continue;
    const double lasts = std::min(open, (0.24 - kRadius * (1.0 - c)) / speed);
    air += 0.06 * 1.1 * pushes * (pushes * pushes - 0.3 * 0.3) / (kGravity * speed * open) * lasts *
           2.0 * std::numbers::pi * kRadius * kRadius / kRings;
  }
  return air;
}

struct SolverAndSpacing {
  const char* solver;
  double spacing;  // [m]
};

class SphereEntry : public ::testing::TestWithParam<SolverAndSpacing> {};

// Skin of a sphere that gets wet late is met by water that the sphere has moved: the law is of the
// water before.
TEST_P(SphereEntry, HoldsTheAirOfTheLaw) {
  for (const double speed : {0.5, 1.0}) {
    const double begins = 0.5 + 0.1 * speed;  // height of its centre, 0.1 s above the water [m]
    const double stops = (begins - 0.26) / speed;
    char text[600];
    std::snprintf(text, sizeof text,
                  "fluid: {spacing: %g, solver: %s}\n"
                  "tank: {lower: [-0.3, -0.3, 0], upper: [0.3, 0.3, 1.2]}\n"
                  "water: [{lower: [-0.3, -0.3, 0], upper: [0.3, 0.3, 0.4]}]\n"
                  "bodies:\n"
                  "  - name: ball\n"
                  "    shape: {kind: sphere, size: [0.2, 0.2, 0.2]}\n"
                  "    motion: {kind: script, smooth: false, keyframes: [\n"
                  "      {time: 0, position: [0, 0, %g]}, {time: %g, position: [0, 0, 0.26]},\n"
                  "      {time: 9, position: [0, 0, 0.26]}]}\n",
                  GetParam().spacing, GetParam().solver, begins, stops);
    const double found = run_scene(text, stops + 0.3).totals.air.by_bodies;
    std::printf("%.1f m/s: %.1f ml of %.1f\n", speed, 1e6 * found, 1e6 * law_of_sphere(speed));
    EXPECT_NEAR(found, law_of_sphere(speed), 0.1 * law_of_sphere(speed)) << speed;
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, SphereEntry,
                         ::testing::Values(SolverAndSpacing{"weakly_compressible", 0.03},
                                           SolverAndSpacing{"grid_projected", 0.02}),
                         [](const auto& water) { return std::string(water.param.solver); });

// A lump of 10 cm falls into still water, which no body touches.
TEST(FallingWater, FoldsAirInWhereItIsFast) {
  const auto fall_from = [](double height) {
    char text[400];
    std::snprintf(text, sizeof text,
                  "fluid: {spacing: 0.015}\n"
                  "tank: {lower: [-0.2, -0.2, 0], upper: [0.2, 0.2, 0.8]}\n"
                  "water:\n"
                  "  - {lower: [-0.2, -0.2, 0], upper: [0.2, 0.2, 0.15]}\n"
                  "  - {lower: [-0.05, -0.05, %g], upper: [0.05, 0.05, %g]}\n",
                  0.15 + height, 0.25 + height);
    const SceneRun run = run_scene(text, 0.2 + std::sqrt(2.0 * height / kGravity) + 0.3);
    std::printf("from %.2f m: %zu bubbles, %.2f ml\n", height, run.found.bubbles.size(),
                1e6 * run.totals.air.entrapped);
    EXPECT_EQ(run.totals.air.by_bodies, 0.0);
    return run.totals.air.entrapped;
  };
  const double low = fall_from(0.02);
  EXPECT_GT(fall_from(0.2), 5.0 * low);
}

// Water slower than bubble_speed has eddies that fold air in, too: frames with them are not
// skipped.
TEST(EntrainedAir, IsNotLeftOutInWaterSlowerThanBubbleSpeed) {
  const std::string skips = changed(entry_at(0.29), "bubble_speed: 0.5", "bubble_speed: 5");
  const SceneRun some = run_scene(skips, lasts(0.29));
  const SceneRun all = run_scene(skips + "skip: {bubbles: false}\n", lasts(0.29));
  std::printf("%.3f and %.3f ml\n", 1e6 * some.totals.air.entrapped,
              1e6 * all.totals.air.entrapped);
  EXPECT_GT(some.totals.skipped.bubbles, 0U);
  EXPECT_GT(all.totals.air.entrapped, 0.0);
  EXPECT_EQ(some.totals.air.entrapped, all.totals.air.entrapped);
}

}  // namespace
}  // namespace splash::sim
