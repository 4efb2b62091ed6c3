// SPDX-License-Identifier: MIT
// Air that a disc of 10 cm takes down, by the energy that the water loses at its surface: it grows
// with the disc's speed and is not lost where slow water is skipped.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/sim-server/detect/scene_run.hpp"

namespace splash::sim {
namespace {

/// The disc goes 15 cm deep and stays there.
std::string entry_at(double speed) {
  const double begins = 0.28 + 0.1 * speed;  // height of its centre, its thickness being 2 cm [m]
  const double stops = (begins - 0.1) / speed;
  char text[700];
  std::snprintf(text, sizeof text,
                "fluid: {spacing: 0.02}\n"
                "tank: {lower: [-0.15, -0.15, 0], upper: [0.15, 0.15, 1]}\n"
                "water: [{lower: [-0.15, -0.15, 0], upper: [0.15, 0.15, 0.24]}]\n"
                "detect: {bubble_energy: 0.38}\n"
                "bodies:\n"
                "  - name: disc\n"
                "    shape: {kind: cylinder, size: [0.1, 0.1, 0.02]}\n"
                "    motion: {kind: script, smooth: false, keyframes: [\n"
                "      {time: 0, position: [0, 0, %g]}, {time: %g, position: [0, 0, 0.1]},\n"
                "      {time: 9, position: [0, 0, 0.1]}]}\n",
                begins, stops);
  return text;
}

/// Until 0.4 s after the disc has stopped [s].
double lasts(double speed) {
  return 0.1 + 0.18 / speed + 0.4;
}

SceneRun entry(double speed) {
  return run_scene(entry_at(speed), lasts(speed));
}

// Eddies lose k^(3/2) of their energy k a second: the cube of the disc's speed, for a time that is
// as the inverse of it. What `bubble_energy` leaves out makes the air grow faster than with the
// square.
TEST(EntrainedAir, GrowsFasterThanTheSquareOfSpeed) {
  const double slowest = 0.3, fastest = 3.0;  // [m/s]
  std::vector<double> air;                    // [m3]
  for (const double speed : {slowest, 0.5, 1.0, 2.0, fastest}) {
    const SceneRun run = entry(speed);
    const AirTotals& now = run.totals.air;
    std::printf("%.1f m/s: %zu bubbles, %.1f ml folded in, %.1f ml told\n", speed,
                run.found.bubbles.size(), 1e6 * now.entrapped, 1e6 * now.told);
    EXPECT_GT(now.entrapped, air.empty() ? 0.0 : air.back());
    air.push_back(now.entrapped);
  }
  EXPECT_GT(air.back(), std::pow(fastest / slowest, 2.0) * air.front());
}

// Water slower than bubble_speed has eddies that fold air in, too: frames with them are not
// skipped.
TEST(EntrainedAir, IsNotLeftOutInWaterSlowerThanBubbleSpeed) {
  const std::string skips = changed(entry_at(0.3), "energy: 0.38", "energy: 0.38, bubble_speed: 5");
  const SceneRun some = run_scene(skips, lasts(0.3));
  const SceneRun all = run_scene(skips + "skip: {bubbles: false}\n", lasts(0.3));
  std::printf("%.3f and %.3f ml\n", 1e6 * some.totals.air.entrapped,
              1e6 * all.totals.air.entrapped);
  EXPECT_GT(some.totals.skipped.bubbles, 0U);
  EXPECT_GT(all.totals.air.entrapped, 0.0);
  EXPECT_EQ(some.totals.air.entrapped, all.totals.air.entrapped);
}

}  // namespace
}  // namespace splash::sim
