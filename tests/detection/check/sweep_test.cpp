// SPDX-License-Identifier: MIT
// Two short cases of the sweeps, run whole: the bench runs them all.
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "tests/detection/run.hpp"
#include "tests/detection/shipped.hpp"

namespace splash::detection {
namespace {

Case case_of(const std::string& sweep, const std::string& name) {
  Material material;
  material.folder = std::filesystem::temp_directory_path() / ("splash_sweep_" + sweep);
  std::filesystem::create_directories(material.folder);
  material.walk.file = scene_folder() / "walk.trc";
  for (const char* place :
       {"Heel", "Toe.Tip", "Toe.Lat", "Toe.Med", "Midfoot.Sup", "Midfoot.Lat"}) {
    material.walk.left.push_back(std::string("L.") + place);
    material.walk.right.push_back(std::string("R.") + place);
  }
  for (const Case& item : all_cases(material)) {
    if (item.sweep == sweep && item.name == name) return item;
  }
  throw std::runtime_error("no case " + name);
}

// In 17 cm of water the heels sink at 1 to 1.6 m/s while the sole, toe down, goes back along its
// normal: no slam, but the one that ends each step in the hollow that it has made.
TEST(Sweep, WalkInAPoolHasNoFalseImpacts) {
  sim::Device device;
  const Outcome outcome = run_case(device, case_of("walk", "17 cm, shoe 25 cm"));
  EXPECT_EQ(outcome.score.wanted, 0);
  EXPECT_LE(outcome.score.untrue, 1);
}

TEST(Sweep, PatsOfOneAndAHalfCentimetresAreToldEach) {
  sim::Device device;
  const Outcome outcome = run_case(device, case_of("patting", "1.5 cm at 4 Hz"));
  EXPECT_EQ(outcome.score.hit, 8);
  EXPECT_EQ(outcome.score.untrue, 0);
}

}  // namespace
}  // namespace splash::detection
