// SPDX-License-Identifier: MIT
// The cause that an alarm names can cause it: a body that leaves water no way out is tried here,
// memory that was overwritten and steps that are too long are in stress_test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

/// All alarms of a scene's first `seconds`.
std::string alarms(const std::string& text, double seconds) {
  Device device;
  Simulation simulation(device, parse_scene(text, "cause.yaml"), {});
  std::string all;
  while (simulation.seconds() < seconds) {
    const FrameResult frame = simulation.advance();
    if (frame.step_fault) all += describe(*frame.step_fault) + "\n";
  }
  return all;
}

TEST(LikelyCause, OfDensityIsABodyThatLeavesNoWayOut) {
  const std::string found = alarms(R"(
fluid: {spacing: 0.025, solver: weakly_compressible}
tank: {lower: [0, 0, 0], upper: [0.4, 0.3, 1.2]}
water: [{lower: [0, 0, 0], upper: [0.4, 0.3, 0.3]}]
bodies:
  - name: lid
    shape: {kind: box, size: [0.4, 0.3, 0.2]}
    motion:
      kind: script
      keyframes: [{time: 0.0, position: [0.2, 0.15, 0.6]}, {time: 0.5, position: [0.2, 0.15, 0.15]}]
)",
                                   0.45);
  EXPECT_THAT(found, ::testing::HasSubstr("impossible density"));
  EXPECT_THAT(found, ::testing::HasSubstr("leave it a way out"));
  EXPECT_THAT(found, ::testing::Not(::testing::HasSubstr("memory"))) << found;
}

}  // namespace
}  // namespace splash::sim
