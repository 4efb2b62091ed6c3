// SPDX-License-Identifier: MIT
// The causes that alarms name can cause them: each is provoked here, but for memory that was
// overwritten and steps that are too long, which stress_test does, and speed, which the lid made by
// hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation.hpp"

namespace splash::sim {
namespace {

/// All alarms of a scene's first `seconds`.
std::string alarms(const std::string& text, double seconds) {
  Device device;
  Simulation simulation(device, parse_scene(text, "cause.yaml"), {});
  std::string all;
  while (simulation.seconds() < seconds) {
    const FrameResult frame = simulation.advance();
    if (frame.mishap) all += describe(*frame.mishap) + "\n";
  }
  return all;
}

TEST(LikelyCause, OfDensityIsABodyThatLeavesNoWayOut) {
  const std::string found = alarms(R"(
fluid: {spacing: 0.025}
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

TEST(LikelyCause, OfParticlesAstrayIsAWaveMakerThatIsTooFast) {
  const std::string found = alarms(R"(
fluid: {spacing: 0.05}
tank: {lower: [0, 0, 0], upper: [3.0, 0.2, 1.2]}
water: [{lower: [0, 0, 0], upper: [3.0, 0.2, 0.2]}]
wave_maker: {stroke: 1.35, period: 0.2}
)",
                                   0.1);
  EXPECT_THAT(found, ::testing::HasSubstr("not where its motion took it"));
  EXPECT_THAT(found, ::testing::HasSubstr("the wave maker is faster"));
}

}  // namespace
}  // namespace splash::sim
