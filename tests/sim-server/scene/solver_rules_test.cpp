// SPDX-License-Identifier: MIT
// A solver is refused where the scene has what it cannot do, at its line, with what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program/config.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/scene_rules.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A pool of grid-projected water that has `more`.
std::string pool(const std::string& more = "") {
  return "fluid:\n"
         "  particles: 1000\n"
         "  solver: grid_projected\n"
         "tank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
         "water:\n"
         "  - {lower: [0, 0, 0], upper: [1, 1, 0.5]}\n" +
         more;
}

std::string refusal(const std::string& more) {
  try {
    static_cast<void>(parse_scene(pool(more), "pool.yaml"));
  } catch (const program::ConfigError& error) {
    return error.what();
  }
  return {};
}

TEST(SolverRules, AGridCarriesAPool) {
  const Scene scene = parse_scene(pool(), "pool.yaml");
  EXPECT_EQ(scene.fluid.solver, PressureKind::grid_projected);
  EXPECT_EQ(solver_lacks(scene), "");
}

TEST(SolverRules, AGridCarriesNoFreeBodiesSlopesAndWaveMakers) {
  const auto says = [](const std::string& what) {
    return AllOf(HasSubstr("pool.yaml:3:"), HasSubstr("fluid.solver"), HasSubstr(what),
                 HasSubstr("take weakly_compressible"));
  };
  EXPECT_THAT(refusal("bodies:\n"
                      "  - {name: ball, shape: {kind: sphere, size: [0.2, 0.2, 0.2]},"
                      " rest: {position: [0.5, 0.5, 0.8]}, motion: {kind: free, density: 500}}\n"),
              says("bodies that the water moves yet, and this scene has 1"));
  EXPECT_THAT(refusal("slope: {foot: 0.5, gradient: 0.2}\n"), says("a slope yet"));
  EXPECT_THAT(refusal("wave_maker: {stroke: 0.1}\n"), says("a wave maker yet"));
}

TEST(SolverRules, AGridTakesNoLongerSteps) {
  const auto with = [](const std::string& factor) {
    std::string text = pool();
    return parse_scene(text.insert(text.find("  solver"), "  time_step_factor: " + factor + "\n"),
                       "pool.yaml");
  };
  EXPECT_DOUBLE_EQ(with("1.05").fluid.time_step_factor, 1.05);
  try {
    static_cast<void>(with("1.06"));
    ADD_FAILURE() << "longer steps are taken";
  } catch (const program::ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("pool.yaml:3:"), HasSubstr("0.05..1.05"),
                                    HasSubstr("gains energy")));
  }
}

TEST(SolverRules, OtherSolversLackNothing) {
  Scene scene = parse_scene(pool(), "pool.yaml");
  scene.bodies.emplace_back();
  EXPECT_EQ(solver_lacks(scene), "");
  scene.bodies.back().motion.kind = MotionKind::free;
  EXPECT_NE(solver_lacks(scene), "");
  for (const PressureKind solver :
       {PressureKind::weakly_compressible, PressureKind::divergence_free}) {
    scene.fluid.solver = solver;
    EXPECT_EQ(solver_lacks(scene), "");
  }
}

}  // namespace
}  // namespace splash::sim
