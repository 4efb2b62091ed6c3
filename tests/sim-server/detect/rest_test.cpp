// SPDX-License-Identifier: MIT
// Still water is silent.
#include <gtest/gtest.h>

#include "tests/sim-server/detect/scene_run.hpp"

namespace splash::sim {
namespace {

void expect_silence(const SceneRun& run) {
  EXPECT_EQ(run.found.impacts.size(), 0U);
  EXPECT_EQ(run.found.bubbles.size(), 0U);
  EXPECT_EQ(run.found.cavities.size(), 0U);
  EXPECT_EQ(run.totals.resets, 0U);
}

TEST(Rest, IsSilent) {
  expect_silence(run_scene(scene_text("rest.yaml"), 5.0));
}

// A body that floats in the middle, one that stands on the floor through the surface, one just
// above it: all still.
TEST(Rest, AroundStillBodiesIsSilent) {
  const auto body = [](const std::string& name, const std::string& place) {
    return "  - name: " + name + "\n    shape: {kind: box, size: [0.12, 0.12, 0.1]}\n" +
           "    rest: {position: " + place + "}\n";
  };
  expect_silence(
      run_scene(scene_text("rest.yaml") + "bodies:\n" + body("sunk", "[0.1, 0.1, 0.25]") +
                    body("half", "[-0.12, 0.1, 0.5]") + body("above", "[0.0, -0.13, 0.57]"),
                3.0));
}

}  // namespace
}  // namespace splash::sim
