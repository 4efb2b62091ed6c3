// SPDX-License-Identifier: MIT
// A good scene is read as written; each kind of mistake is refused at its place with its reason;
// and the reference page holds what the reader knows.
#include "sim-server/scene/scene_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "program/config.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/text_of.hpp"

namespace splash::sim {
namespace {

using ::testing::HasSubstr;

const std::string kGood = R"(name: small
seed: 7
fluid:
  particles: 1000
tank:
  lower: [0.0, 0.0, 0.0]
  upper: [1.0, 1.0, 1.0]
slope:
  foot: 0.5
  gradient: 0.2
water:
  - lower: [0.0, 0.0, 0.0]
    upper: [1.0, 1.0, 0.5]
bodies:
  - name: ball
    shape: {kind: sphere, size: [0.2, 0.2, 0.2]}
    motion:
      kind: script
      keyframes:
        - {time: 0.0, position: [0.5, 0.5, 0.9]}
        - {time: 1.0, position: [0.5, 0.5, 0.3], rotation: [0.0, 0.0, 0.6, 0.6]}
  - name: post
    shape: {size: [0.1, 0.1, 0.4], rocker: 0.02, flat: 0.5}
    rest: {position: [0.2, 0.2, 0.2]}
detect:
  radius_max: 0.02
)";

TEST(SceneReader, ReadsWhatIsWritten) {
  const Scene scene = parse_scene(kGood, "small.yaml");
  EXPECT_EQ(scene.name, "small");
  EXPECT_EQ(scene.seed, 7);
  EXPECT_EQ(scene.fluid.particles, 1000);
  EXPECT_TRUE(scene.slope.present);
  EXPECT_DOUBLE_EQ(scene.slope.gradient, 0.2);
  EXPECT_FALSE(scene.wave_maker.present);
  ASSERT_EQ(scene.water.size(), 1U);
  EXPECT_DOUBLE_EQ(scene.water[0].upper[2], 0.5);
  ASSERT_EQ(scene.bodies.size(), 2U);
  const BodySettings& ball = scene.bodies[0];
  EXPECT_EQ(ball.shape.kind, ShapeKind::sphere);
  EXPECT_EQ(ball.motion.kind, MotionKind::script);
  ASSERT_EQ(ball.motion.keyframes.size(), 2U);
  EXPECT_DOUBLE_EQ(ball.rest.position[2], 0.9) << "a scripted body rests at its first keyframe";
  EXPECT_NEAR(ball.motion.keyframes[1].rotation[3], std::sqrt(0.5), 1e-12) << "to unit length";
  const BodySettings& post = scene.bodies[1];
  EXPECT_EQ(post.motion.kind, MotionKind::fixed);
  EXPECT_DOUBLE_EQ(post.shape.rocker, 0.02);
  EXPECT_DOUBLE_EQ(post.shape.flat, 0.5);
  EXPECT_DOUBLE_EQ(scene.detect.radius_max, 0.02);
  EXPECT_DOUBLE_EQ(scene.detect.radius_min, DetectSettings{}.radius_min);
}

TEST(SceneReader, NamesANamelessSceneAfterItsFile) {
  const std::string text = kGood.substr(kGood.find('\n') + 1);
  EXPECT_EQ(parse_scene(text, "some/where/pond.yaml").name, "pond");
}

/// Of the good scene with more keys of the fluid, and more bodies.
FluidSettings fluid_with(const std::string& keys, const std::string& bodies = "") {
  std::string text = kGood;
  text.insert(text.find("detect:"), bodies);
  return parse_scene(text.insert(text.find("  particles"), keys), "small.yaml").fluid;
}

TEST(SceneReader, ReadsTheSolver) {
  EXPECT_EQ(fluid_with("  solver: weakly_compressible\n").solver,
            PressureKind::weakly_compressible);
  EXPECT_EQ(fluid_with("").kernels, KernelKind::vector);
  const FluidSettings fluid = fluid_with("  solver: grid_projected\n  kernels: reference\n");
  EXPECT_EQ(fluid.solver, PressureKind::grid_projected);
  EXPECT_EQ(fluid.kernels, KernelKind::reference);
  EXPECT_EQ(fluid.pull, (Vector3{0.0, 0.0, 0.0}));
  EXPECT_EQ(fluid_with("  pull: [1.5, 0.0, 2.0]\n").pull, (Vector3{1.5, 0.0, 2.0}));
  EXPECT_THROW(static_cast<void>(fluid_with("  pull: [-1.0, 0.0, 0.0]\n")), program::ConfigError);
  EXPECT_THROW(static_cast<void>(fluid_with("  solver: magic\n")), program::ConfigError);
}

TEST(SceneReader, AllowsNoLongerStepsThanTheSolverStands) {
  EXPECT_DOUBLE_EQ(fluid_with("  time_step_factor: 2\n").time_step_factor, 2.0) << "slower sound";
  EXPECT_DOUBLE_EQ(fluid_with("  sound_speed: 15\n  time_step_factor: 1.05\n").time_step_factor,
                   1.05);
  EXPECT_DOUBLE_EQ(fluid_with("  solver: grid_projected\n  time_step_factor: 2\n").time_step_factor,
                   2.0);
  EXPECT_THROW(static_cast<void>(fluid_with("  sound_speed: 15\n  time_step_factor: 1.06\n")),
               program::ConfigError);
  EXPECT_THROW(static_cast<void>(fluid_with("  time_step_factor: 2.1\n")), program::ConfigError);
  EXPECT_THROW(static_cast<void>(fluid_with("  solver: grid_projected\n  time_step_factor: 2.1\n")),
               program::ConfigError);
}

// Half a metre of water has waves of 2.21 m/s, and what falls two metres is 6.26 m/s fast.
TEST(SceneReader, AllowsNoSoundThatIsTooSlowForItsWater) {
  const std::string falls =
      "  - {name: stone, shape: {size: [0.1, 0.1, 0.1]}, rest: {position: [0.8, 0.8, 2.0]},"
      " motion: {kind: free, density: 2000}}\n";
  EXPECT_DOUBLE_EQ(fluid_with("  sound_speed: 8.9\n").sound_speed, 8.9);
  EXPECT_THROW(static_cast<void>(fluid_with("  sound_speed: 8.8\n")), program::ConfigError);
  EXPECT_DOUBLE_EQ(fluid_with("  sound_speed: 17.8\n", falls).sound_speed, 17.8);
  EXPECT_THROW(static_cast<void>(fluid_with("  sound_speed: 17.6\n", falls)), program::ConfigError);
  EXPECT_NO_THROW(static_cast<void>(fluid_with("  sound_speed: 1\n  solver: grid_projected\n")))
      << "that has no use for it but for its viscosity";
}

TEST(SceneReader, AllowsNoPullThatTakesSoundFasterThanWaters) {
  EXPECT_DOUBLE_EQ(fluid_with("  pull: [100, 0, 0]\n  pull_centre: [0.5, 0, 0]\n").pull[0], 100.0);
  EXPECT_THAT(
      tests::refusal(
          [&] { return fluid_with("  pull: [100, 0, 0]\n  pull_centre: [50, 0, 0]\n"); }),
      AllOf(HasSubstr("'fluid.pull'"), HasSubstr("in water it is no faster than 1500 m/s")));
}

// By the spacing's rounding they are a billionth more.
TEST(SceneReader, TakesAsManyParticlesAsItSaysAreAllowed) {
  for (const char* depth : {"0.31", "0.37", "0.41", "0.43", "0.5"}) {
    std::string text = kGood;
    text.replace(text.find("particles: 1000"), 15, "particles: 4000000");
    text.replace(text.find("0.5]\nbodies"), 3, depth);
    EXPECT_EQ(parse_scene(text, "small.yaml").fluid.particles, 4'000'000) << depth;
  }
}

/// One change to the good scene, and what the error must say.
struct Mistake {
  std::string name;
  std::string from;
  std::string to;
  std::string place;   ///< "line:"
  std::string reason;  ///< part of the text
};

class SceneMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(SceneMistake, IsRefusedWithPlaceAndReason) {
  const Mistake& mistake = GetParam();
  std::string text = kGood;
  const auto at = text.find(mistake.from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, mistake.from.size(), mistake.to);
  EXPECT_THAT(tests::refusal([&] { return parse_scene(text, "bad.yaml"); }),
              AllOf(HasSubstr("bad.yaml:" + mistake.place), HasSubstr(mistake.reason)));
}

TEST(SceneReader, RefusesBodiesThatNoEventCanTellOf) {
  std::string text = kGood;
  const auto end = text.find("detect:");
  std::string posts;
  for (int i = 2; i < 256; ++i) {
    posts += "  - {name: post" + std::to_string(i) +
             ", shape: {size: [0.1, 0.1, 0.1]}, rest: {position: [0.2, 0.2, 0.2]}}\n";
  }
  text.insert(end, posts);
  EXPECT_EQ(parse_scene(text, "small.yaml").bodies.size(), 256U);
  text.insert(
      end,
      "  - {name: one_more, shape: {size: [0.1, 0.1, 0.1]}, rest: {position: [0.2, 0.2, 0.2]}}\n");
  EXPECT_THAT(tests::refusal([&] { return parse_scene(text, "small.yaml"); }),
              HasSubstr("body 257, and events tell of 256 at most"));
}

TEST(SceneReader, ReadsFreeBodies) {
  std::string text = kGood;
  const std::string fixed = "    shape: {size: [0.1, 0.1, 0.4], rocker: 0.02, flat: 0.5}\n";
  text.replace(text.find(fixed), fixed.size(),
               "    shape: {size: [0.1, 0.1, 0.4]}\n"
               "    motion: {kind: free, density: 600, velocity: [0.0, 1.0, 0.0], spin: [2.0, 0.0, "
               "0.0], restitution: 0.5, friction: 0.1}\n");
  const BodySettings post = parse_scene(text, "small.yaml").bodies.at(1);
  EXPECT_TRUE(is_free(post));
  EXPECT_DOUBLE_EQ(post.motion.density, 600.0);
  EXPECT_DOUBLE_EQ(post.motion.velocity[1], 1.0);
  EXPECT_DOUBLE_EQ(post.motion.spin[0], 2.0);
  EXPECT_DOUBLE_EQ(post.motion.restitution, 0.5);
  EXPECT_DOUBLE_EQ(post.motion.friction, 0.1);
  EXPECT_DOUBLE_EQ(post.rest.position[0], 0.2);
}

const std::vector<Mistake> kMistakes = {
    {"upside_down_tank", "upper: [1.0, 1.0, 1.0]", "upper: [1.0, 1.0, -1.0]",
     "7:", "z is -1, not above that of 'lower' (0)"},
    {"water_outside_tank", "    upper: [1.0, 1.0, 0.5]", "    upper: [1.0, 1.5, 0.5]",
     "13:", "y is 1.5, outside the tank, which ends at 1"},
    {"overlapping_water", "bodies:\n",
     "  - {lower: [0.5, 0.5, 0.4], upper: [0.9, 0.9, 0.9]}\nbodies:\n", "14:", "overlaps"},
    {"no_water", "water:\n  - lower: [0.0, 0.0, 0.0]\n    upper: [1.0, 1.0, 0.5]\n", "",
     "1:", "at least one block of water"},
    {"unknown_settling", "  particles: 1000", "  particles: 1000\n  settle: sometimes",
     "5:11:", "settle"},
    {"both_resolutions", "  particles: 1000", "  particles: 1000\n  spacing: 0.05",
     "5:", "exactly one of 'spacing' and 'particles'"},
    {"no_resolution", "fluid:\n  particles: 1000", "fluid:\n  density: 998", "",
     "exactly one of 'spacing' and 'particles'"},
    {"too_few_particles", "particles: 1000", "particles: 99", "4:", "100"},
    {"too_fine", "  particles: 1000", "  spacing: 0.002", "4:", "allowed are 100 to 4000000"},
    {"too_coarse", "  particles: 1000", "  spacing: 0.2", "4:", "allowed are 100"},
    {"slope_outside", "foot: 0.5", "foot: 1.5", "9:", "outside the tank"},
    {"slope_too_high", "  upper: [1.0, 1.0, 1.0]\nslope:\n  foot: 0.5\n  gradient: 0.2",
     "  upper: [1.0, 1.0, 0.6]\nslope:\n  foot: 0.5\n  gradient: 1.5",
     "10:", "ends at a height of 0.75 m"},
    {"long_stroke", "water:\n", "wave_maker:\n  stroke: 0.6\nwater:\n",
     "12:", "not below half the tank's length"},
    {"same_name", "name: post", "name: ball", "22:", "another body named 'ball'"},
    {"unknown_key", "seed: 7", "sead: 7", "2:", "seed"},
    {"times_run_back", "time: 1.0,", "time: 0.0,", "21:", "not later"},
    {"no_rotation", "rotation: [0.0, 0.0, 0.6, 0.6]", "rotation: [0.0, 0.0, 0.0, 0.0]",
     "21:", "length is zero"},
    {"oval_ball", "size: [0.2, 0.2, 0.2]", "size: [0.2, 0.2, 0.3]",
     "16:", "three diameters must be equal"},
    {"ball_with_sole", "size: [0.2, 0.2, 0.2]", "size: [0.2, 0.2, 0.2], rocker: 0.01",
     "16:", "only a box"},
    {"deep_rocker", "rocker: 0.02", "rocker: 0.4", "23:", "not below the box's height"},
    {"resting_script", "    motion:\n", "    rest: {position: [0.0, 0.0, 0.0]}\n    motion:\n",
     "17:", "the motion already says"},
    {"fixed_without_rest", "    rest: {position: [0.2, 0.2, 0.2]}\n", "", "22:", "rest"},
    {"foreign_key", "      kind: script\n", "      kind: script\n      start: 1.0\n",
     "19:", "no meaning for a motion of kind script"},
    {"gap_of_a_script", "      kind: script\n", "      kind: script\n      gap: hold\n",
     "19:", "no meaning for a motion of kind script"},
    {"unknown_gap", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: osc, gap: guess}\n", "24:", "bridge, hold"},
    {"limit_of_a_held_gap", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: osc, gap: hold, gap_limit: 0.1}\n", "24:", "where a gap is held"},
    {"endless_gap", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: osc, gap_limit: 60}\n", "24:", "0..1 s"},
    {"script_without_keyframes",
     "      keyframes:\n        - {time: 0.0, position: [0.5, 0.5, "
     "0.9]}\n        - {time: 1.0, position: [0.5, 0.5, 0.3], "
     "rotation: [0.0, 0.0, 0.6, 0.6]}\n",
     "", "18:", "at least one"},
    {"scripted_too_fast", "{time: 1.0, position: [0.5, 0.5, 0.3]",
     "{time: 1.0e-6, position: [0.5, 0.5, 0.3]", "21:", "600000 m/s, beyond the limit of 100"},
    {"free_beyond_a_wall",
     "    shape: {size: [0.1, 0.1, 0.4], rocker: 0.02, flat: 0.5}\n"
     "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    shape: {size: [0.1, 0.1, 0.4]}\n"
     "    rest: {position: [0.2, 1.5, 0.2]}\n    motion: {kind: free, density: 600}\n",
     "24:", "y is 1.5, where the tank goes from 0 to 1"},
    {"free_without_mass", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    rest: {position: [0.2, 0.2, 0.2]}\n    motion: {kind: free}\n",
     "25:", "one of 'density' and 'mass'"},
    {"mass_and_density", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    rest: {position: [0.2, 0.2, 0.2]}\n    motion: {kind: free, mass: 1, density: 500}\n",
     "25:", "one of 'density' and 'mass'"},
    {"massless", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    rest: {position: [0.2, 0.2, 0.2]}\n    motion: {kind: free, mass: 0}\n", "25:", "mass"},
    {"density_of_a_script", "      kind: script\n", "      kind: script\n      density: 500\n",
     "19:", "no meaning for a motion of kind script"},
    {"free_without_rest", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: free, mass: 1}\n", "22:", "rest"},
    {"free_sole", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    rest: {position: [0.2, 0.2, 0.2]}\n    motion: {kind: free, mass: 1}\n",
     "23:", "curved sole"},
    {"missing_file", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: csv, file: nowhere.csv}\n", "24:", "there is no file"},
    {"long_file_name", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: csv, file: " + std::string(300, 'x') + "}\n",
     "24:", "cannot be read: File name too long"},
    {"folder_of_no_folder", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: csv, file: /dev/null/a.csv}\n", "24:", "there is no file"},
    {"csv_without_file", "    rest: {position: [0.2, 0.2, 0.2]}\n", "    motion: {kind: csv}\n",
     "24:", "needs one"},
    {"two_markers", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: trc, markers: [a, b]}\n", "24:", "three or more (got 2)"},
    {"marker_twice", "    rest: {position: [0.2, 0.2, 0.2]}\n",
     "    motion: {kind: trc, markers: [a, b, a]}\n", "24:", "twice"},
    {"empty_range", "radius_max: 0.02", "radius_max: 0.0002",
     "26:", "radius_max is 0.0002, not above radius_min"},
};

INSTANTIATE_TEST_SUITE_P(All, SceneMistake, ::testing::ValuesIn(kMistakes),
                         [](const auto& mistake) { return mistake.param.name; });

TEST(SceneReference, StandsInTheReadme) {
  EXPECT_THAT(tests::text_of(SPLASH_SOURCE_DIR "/configs/README.md"),
              HasSubstr("<!-- begin: scene-reference -->\n" + scene_reference() +
                        "<!-- end: scene-reference -->\n"))
      << "build and run scene-reference and put its output between the markers";
}

TEST(SceneReference, GivesDefaultsAndSaysWhatIsRequired) {
  const std::string text = scene_reference();
  EXPECT_THAT(text, HasSubstr("| `density` | kg/m3 | 998 |"));
  EXPECT_THAT(text, HasSubstr("| `spacing` | m |  | 0.001"));
  EXPECT_THAT(text, HasSubstr("| `size` | m | required |"));
}

}  // namespace
}  // namespace splash::sim
