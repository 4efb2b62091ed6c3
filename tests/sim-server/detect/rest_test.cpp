// SPDX-License-Identifier: MIT
// Still water is silent, and so are still bodies.
#include <gtest/gtest.h>

#include <string>

#include "tests/sim-server/detect/scene_run.hpp"

namespace splash::sim {
namespace {

void expect_silence(const SceneRun& run) {
  EXPECT_EQ(run.found.impacts.size(), 0U);
  EXPECT_EQ(run.found.bubbles.size(), 0U);
  EXPECT_EQ(run.found.cavities.size(), 0U);
  EXPECT_EQ(run.totals.resets, 0U);
}

/// A box that never moves, behind the bodies of the scene.
std::string box(const std::string& name, const std::string& place) {
  return "  - name: " + name + "\n    shape: {kind: box, size: [0.12, 0.12, 0.1]}\n" +
         "    rest: {position: " + place + "}\n";
}

TEST(Rest, IsSilent) {
  expect_silence(run_scene(scene_text("rest.yaml"), 5.0));
}

TEST(Rest, IsSilentForAMinute) {
  const SceneRun run = run_scene(scene_text("rest.yaml"), 60.0);
  expect_silence(run);
  EXPECT_GT(run.totals.frames, 1000);
}

// One sunk, one half in the water, one just above it.
TEST(Rest, AroundStillBodiesIsSilent) {
  const std::string text = scene_text("rest.yaml") + box("sunk", "[0.1, 0.1, 0.25]") +
                           box("half", "[-0.12, 0.1, 0.5]") + box("above", "[0.0, -0.13, 0.57]");
  expect_silence(run_scene(text, 3.0));
}

// A dam breaks over bodies that stand: water comes to them, they hit nothing.
TEST(Rest, OfBodiesInAWaveMakesNoImpact) {
  const std::string dam =
      changed(scene_text("rest.yaml"), "upper: [0.25, 0.25, 0.5]", "upper: [-0.05, 0.25, 0.5]");
  const SceneRun run =
      run_scene(dam + box("low", "[0.12, 0.1, 0.05]") + box("high", "[0.15, -0.12, 0.3]"), 1.5);
  EXPECT_EQ(run.found.impacts.size(), 0U);
  EXPECT_GT(run.found.bubbles.size(), 20U);  // the wave was one
}

}  // namespace
}  // namespace splash::sim
