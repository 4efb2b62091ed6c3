// SPDX-License-Identifier: MIT
// Two short cases of the sweeps, run whole: the bench runs them all.
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "sim-server/scene/rotation.hpp"
#include "tests/detection/run.hpp"
#include "tests/detection/run_water.hpp"

namespace splash::detection {
namespace {

Case case_of(const std::string& sweep, const std::string& name) {
  Material material;
  material.folder = std::filesystem::temp_directory_path() / ("splash_sweep_" + sweep);
  std::filesystem::create_directories(material.folder);
  material.walk = own_walk();
  for (const Case& item : all_cases(material)) {
    if (item.sweep == sweep && item.name == name) return item;
  }
  throw std::runtime_error("no case " + name);
}

// What a place sees of still water: how far its surface is, and what is behind that.
TEST(RunWater, SeesAStillSurfaceWhereItIs) {
  sim::Device device;
  sim::Scene scene;
  scene.fluid.spacing = 0.02;
  scene.tank = {{0.0, 0.0, 0.0}, {0.3, 0.3, 0.4}};
  scene.water = {{{0.0, 0.0, 0.0}, {0.3, 0.3, 0.2}}};
  sim::Simulation simulation(device, scene, {});
  const RunWater there(simulation, 0.05);
  const Water water = there.water(0.01);
  for (const double gap : {-0.002, 0.0, 0.005, 0.01, 0.02}) {
    double mean = 0.0;
    for (int k = 0; k < 16; ++k) {
      mean += water.at({0.1 + 0.031 * (k / 4), 0.1 + 0.031 * (k % 4), 0.2 + gap}).gap;
    }
    EXPECT_NEAR(mean / 16.0, gap, 0.15 * 0.02) << gap;
  }
  EXPECT_NEAR(water.ahead({0.15, 0.15, 0.2}, {0, 0, -1}), 1.0, 0.05);
  EXPECT_NEAR(water.ahead({0.15, 0.15, 0.2}, {0, 0, 1}), 0.0, 0.02);
  EXPECT_LT(sim::length(water.at({0.15, 0.15, 0.2}).water), 0.05);
}

// In 17 cm of water the heels sink at 1 to 1.6 m/s while the sole, toe down, goes back along its
// normal: what each step ends with is the sole's blow in the hollow that it has made.
TEST(Sweep, EachStepInAPoolIsOneImpactInItsHollow) {
  sim::Device device;
  const Outcome outcome = run_case(device, case_of("walk", "17 cm, shoe 25 cm"),
                                   sim::PressureKind::weakly_compressible);
  EXPECT_EQ(outcome.score.wanted, 4);
  EXPECT_EQ(outcome.score.hit, 4);
  EXPECT_LE(outcome.score.untrue, 1);
}

// On the grid the water closes around the foot, and it hits none; but beside it the water is thin.
// False impacts vary from run to run: the benchmark's six walks in 17 cm of water have 0 to 2.
TEST(Sweep, NoStepInAPoolIsAnImpactWhereTheWaterCloses) {
  sim::Device device;
  const Outcome outcome =
      run_case(device, case_of("walk", "17 cm, shoe 25 cm"), sim::PressureKind::grid_projected);
  EXPECT_EQ(outcome.score.wanted, 0);
  EXPECT_LE(outcome.score.untrue, 3);
}

TEST(Sweep, PatsOfOneAndAHalfCentimetresAreToldEach) {
  sim::Device device;
  const Outcome outcome = run_case(device, case_of("patting", "1.5 cm at 4 Hz"),
                                   sim::PressureKind::weakly_compressible);
  EXPECT_EQ(outcome.score.hit, 8);
  EXPECT_EQ(outcome.score.untrue, 0);
}

}  // namespace
}  // namespace splash::detection
