// SPDX-License-Identifier: MIT
// The guard keeps quiet where nothing is wrong: the built-in scenes, coarse, with either solver,
// through their first splashes, without one frame computed again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim-server/simulation/simulation.hpp"
#include "tests/stress/endurance.hpp"
#include "tests/stress/faults.hpp"

namespace splash::stress {
namespace {

class Alarms : public testing::TestWithParam<sim::PressureKind> {};

TEST_P(Alarms, AreNotRaisedByAnyBuiltInScene) {
  sim::Device device;
  Endurance coarse;
  coarse.coarser = 2.0;
  coarse.solver = GetParam();
  const std::vector<std::string> scenes = built_in_scenes();
  ASSERT_GE(scenes.size(), 7U);
  for (const std::string& name : scenes) {
    sim::Simulation simulation(device, built_in_scene(name, coarse), {});
    while (simulation.seconds() < 2.0) {
      const sim::FrameResult frame = simulation.advance();
      ASSERT_FALSE(frame.step_fault) << name << ": " << describe(*frame.step_fault);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Waters, Alarms, testing::ValuesIn(kBothSolvers),
                         [](const auto& solver) { return sim::name_of(solver.param); });

}  // namespace
}  // namespace splash::stress
