// SPDX-License-Identifier: MIT
#include "sim-server/scene/solver_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kLevel[] = "[{lower: [0, 0, 0], upper: [1, 1, 0.5]}]";
constexpr char kDam[] = "[{lower: [0, 0, 0], upper: [0.5, 1, 0.5]}]";
constexpr char kGate[] = "gate: {x: 0.5}\n";

/// A basin whose fluid, water and rest of the scene are these, without a word of the solver.
Scene basin(const std::string& more = "", const std::string& fluid = "",
            const std::string& water = kLevel) {
  return parse_scene("fluid: {spacing: 0.05" + fluid +
                         "}\n"
                         "tank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
                         "water: " +
                         water + "\n" + more,
                     "basin.yaml");
}

/// A body of 0.3 m, of this motion.
std::string body(const std::string& motion, const std::string& rest = "") {
  return "bodies:\n  - {name: it, shape: {kind: box, size: [0.3, 0.3, 0.3]}, motion: " + motion +
         (rest.empty() ? "" : ", rest: {position: " + rest + "}") + "}\n";
}

/// Down by 0.2 m in `seconds`, its underside from 10 cm above the water to 10 cm below.
std::string lowered(const std::string& seconds) {
  return body(
      "{kind: script, smooth: false, keyframes: [{time: 0, position: [0.5, 0.5, 0.75]}, "
      "{time: " +
      seconds + ", position: [0.5, 0.5, 0.55]}]}");
}

struct Case {
  const char* name;
  Scene scene;
  PressureKind solver;
  const char* reason;
};

constexpr PressureKind kGrid = PressureKind::grid_projected;
constexpr PressureKind kState = PressureKind::weakly_compressible;

TEST(SolverChoice, ASceneGetsWhatSuitsWhatItCanDo) {
  const std::string free = "{kind: free, density: ";
  const std::string under = body(
      "{kind: script, keyframes: [{time: 0, position: [0.5, 0.5, 0.2]}, "
      "{time: 0.1, position: [0.6, 0.5, 0.2]}]}");
  const Case cases[] = {
      {"still", basin(), kGrid, "deep"},
      {"waves", basin("wave_maker: {stroke: 0.1, period: 2}\n"), kGrid, "deep"},
      {"standing wave", basin("flow: {kind: standing_wave, amplitude: 0.02}\n"), kGrid, ""},
      {"swaying", basin("tank_motion: {sway: [0.02, 0, 0], period: 1}\n"), kGrid, ""},
      {"gauges", basin("gauges: {probes: [{name: h, kind: height, x: 0.5, y: 0.5}]}\n"), kGrid, ""},
      {"fixed", basin(body("{kind: fixed}", "[0.5, 0.5, 0.5]")), kGrid, ""},
      {"under water", basin(under), kGrid, ""},
      {"lowered slowly", basin(lowered("5")), kGrid, ""},
      {"afloat", basin(body(free + "500}", "[0.5, 0.5, 0.5]")), kGrid, ""},
      {"dropped", basin(body(free + "500}", "[0.5, 0.5, 0.75]")), kGrid, ""},
      {"thrown up", basin(body(free + "500, velocity: [0, 0, 2]}", "[0.5, 0.5, 0.5]")), kGrid, ""},
      {"sinks", basin(body(free + "2000}", "[0.5, 0.5, 0.3]")), kGrid, ""},
      {"held", basin(body(free + "500, held: [x]}", "[0.5, 0.5, 0.5]")), kGrid, ""},
      {"tracked", basin(body("{kind: osc}", "[0.5, 0.5, 0.8]")), kGrid, "deep"},
      {"two boxes",
       basin(body(free + "500}", "[0.5, 0.5, 0.5]") +
             "  - {name: lid, shape: {kind: box, size: [0.1, 0.1, 0.1]}, motion: {kind: fixed}, "
             "rest: {position: [0.2, 0.2, 0.9]}}\n"),
       kState, "short steps"},
      {"a box and a ball",
       basin(body(free + "500}", "[0.5, 0.5, 0.5]") +
             "  - {name: ball, shape: {kind: sphere, size: [0.1, 0.1, 0.1]}, motion: {kind: "
             "fixed}, rest: {position: [0.2, 0.2, 0.9]}}\n"),
       kGrid, ""},
      {"sheet", basin("", "", "[{lower: [0, 0, 0], upper: [1, 1, 0.15]}]"), kState, "shallower"},
      {"dam", basin("", "", kDam), kState, "nothing holds"},
      {"gate", basin(kGate, "", kDam), kState, "gate"},
      {"drop", basin("", "", "[{lower: [0.3, 0.3, 0.6], upper: [0.7, 0.7, 0.9], form: sphere}]"),
       kState, "nothing holds"},
      {"no weight", basin("", ", gravity: [0, 0, 0]"), kState, "nothing holds"},
      {"central field", basin("", ", gravity: [0, 0, 0], pull: [1, 1, 1]"), kState,
       "central field"},
      {"stream", basin("flow: {kind: uniform, velocity: [1, 0, 0]}\n"), kState, "flow"},
      {"sound", basin("", ", sound_speed: 30"), kState, "how fast sound"},
      {"artificial", basin("", ", artificial: 0.2"), kState, "artificial"},
  };
  for (const Case& tried : cases) {
    EXPECT_EQ(tried.scene.fluid.solver, tried.solver) << tried.name;
    const SolverChoice choice = suitable_solver(tried.scene);
    EXPECT_EQ(choice.solver, tried.solver) << tried.name;
    EXPECT_THAT(choice.reason, HasSubstr(tried.reason)) << tried.name;
  }
}

TEST(SolverChoice, EachSceneThatIsShippedHasItsOwn) {
  const std::vector<std::string> names = tests::scene_names();
  for (const std::string& name : names) {
    const Scene scene = read_scene(tests::scene_file(name));
    // A treadmill's belt goes through a thin layer of water, a boat may meet a hand's edges.
    const bool thin = scene.name == "walk";
    const bool stacks = scene.name == "boat";
    EXPECT_EQ(scene.fluid.solver, thin || stacks ? kState : kGrid) << scene.name;
    EXPECT_THAT(solver_notice(scene), HasSubstr(thin     ? "shallower"
                                                : stacks ? "short steps"
                                                         : "deep"));
  }
  EXPECT_GE(names.size(), 10U);
}

TEST(SolverChoice, WhatASceneNamesItGets) {
  EXPECT_EQ(basin("", ", solver: auto").fluid.solver, kGrid);
  EXPECT_EQ(basin("", ", solver: weakly_compressible").fluid.solver, kState);
  EXPECT_EQ(basin(kGate, ", solver: auto", kDam).fluid.solver, kState);
  EXPECT_EQ(basin(kGate, ", solver: grid_projected", kDam).fluid.solver, kGrid);
}

TEST(SolverChoice, OnlyAGridThatDoesNotSuitIsWarnedOf) {
  EXPECT_THAT(solver_notice(basin(kGate, ", solver: grid_projected", kDam)),
              AllOf(HasSubstr("the gate lets water go"), HasSubstr("weakly_compressible is what")));
  EXPECT_THAT(solver_notice(basin("", ", solver: weakly_compressible")), Not(HasSubstr("but")));
  EXPECT_THAT(solver_notice(basin(kGate, "", kDam)), Not(HasSubstr("but")));
}

TEST(SolverChoice, AnUnknownNameIsRefusedWithAllThatThereAre) {
  EXPECT_THAT(
      tests::refusal([] { return basin("", ", solver: automatic"); }),
      AllOf(HasSubstr("got 'automatic'"), HasSubstr("weakly_compressible, grid_projected, auto")));
}

}  // namespace
}  // namespace splash::sim
