// SPDX-License-Identifier: MIT
// Still water stays silent for a minute.
#include <gtest/gtest.h>

#include "tests/sim-server/detect/scene_run.hpp"

namespace splash::sim {
namespace {

TEST(LongRest, IsSilent) {
  const SceneRun run = run_scene(scene_text("rest.yaml"), 60.0);
  EXPECT_EQ(run.found.impacts.size(), 0U);
  EXPECT_EQ(run.found.bubbles.size(), 0U);
  EXPECT_EQ(run.found.cavities.size(), 0U);
  EXPECT_EQ(run.totals.resets, 0U);
  EXPECT_GT(run.totals.frames, 1000);
}

}  // namespace
}  // namespace splash::sim
