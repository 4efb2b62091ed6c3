// SPDX-License-Identifier: MIT
// How a foot comes and goes that is known only while it stands: from just above the water when it
// is touched, up when it is not, always continuously but for its way through the air.
#include "sim-server/bodies/motion/floor_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/sim-server/bodies/motion/motion_checks.hpp"

namespace splash::sim {
namespace {

constexpr double kFrame = 1.0 / 160.0;  // [s]
constexpr double kStands = 0.035;
constexpr double kWater = 0.2;  ///< it hovers so far above where it stands [m]

class Foot {
 public:
  Foot() : motion({0.0, {0.3, 0.4, kStands}, {0.0, 0.0, 0.0, 1.0}}, {.hover = kWater}) {}

  /// Frames until `until`; the place at each one's end continues in the next.
  void play(double until) {
    while (wall < until) {
      const BodyState before = motion.at(wall);
      motion.begin({wall, wall, kFrame});
      const BodyState after = motion.at(wall);
      const double jump = length(after.position - before.position);
      if (jump > 1.0e-9) {
        ++jumps;
        EXPECT_GE(after.position[2], kStands + kWater - 1.0e-9) << "only through the air";
      }
      expect_consistent(motion, wall + 0.5 * kFrame, 1.0e-4);
      wall += kFrame;
    }
  }
  [[nodiscard]] Vector3 place() const { return motion.at(wall).position; }

  FloorMotion motion;
  double wall = 10.0;
  int jumps = 0;
};

TEST(FloorMotion, WaitsAboveTheWaterAndComesDownWhenTouched) {
  Foot foot;
  foot.play(10.1);
  EXPECT_NEAR(foot.place()[2], kStands + kWater + 0.12, 1.0e-9);
  foot.motion.touch({1.0, 2.0, 0.0}, {}, foot.wall);
  const double touched = foot.wall;
  foot.play(touched + kFrame);
  EXPECT_LT(length(foot.place() - Vector3{1.0, 2.0, kStands + kWater - kFrame}), 1.0e-9);
  foot.play(touched + 0.3);
  EXPECT_LT(length(foot.place() - Vector3{1.0, 2.0, kStands}), 1.0e-9);
  EXPECT_EQ(foot.jumps, 1);
  foot.motion.touch({1.2, 2.0, 0.0}, {}, foot.wall);
  foot.play(foot.wall + 0.2);
  EXPECT_LT(length(foot.place() - Vector3{1.2, 2.0, kStands}), 1.0e-4);
  EXPECT_EQ(foot.jumps, 1) << "on the floor it slides";
}

/// Above where it stands, in water so deep there, the foot of a scene begins to fall [m].
double hover_in(const std::string& depth) {
  const Scene scene = parse_scene(R"(fluid: {spacing: 0.02}
tank: {lower: [0, 0, 0], upper: [1, 1, 1]}
water: [{lower: [0, 0, 0], upper: [1, 1, 0.2]}]
serve: {frame_rate: 100}
bodies:
  - name: foot
    shape: {size: [0.29, 0.1, 0.08]}
    motion: {kind: touch, fall: 2}
    rest: {position: [0.5, 0.5, )" + depth +
                                      R"(]}
tracking: {sources: [{preset: tuio, body: foot, floor: [1, 1]}]}
)",
                                  "floor.yaml");
  return scene.bodies[0].motion.hover;
}

TEST(FloorMotion, BeginsAsNearToTheWaterAsItFallsForAFrameAndDoesNotTouch) {
  EXPECT_NEAR(hover_in("0.10"), 0.14 + 0.002, 1.0e-9) << "a tenth of a spacing above 14 cm";
  EXPECT_NEAR(hover_in("0.235"), 0.02, 1.0e-9) << "5 mm of water, 2 m/s for 10 ms";
  EXPECT_NEAR(hover_in("0.24"), 0.02, 1.0e-9) << "none";
}

TEST(FloorMotion, RisesWithinFiftyMilliseconds) {
  Foot foot;
  foot.motion.touch({1.0, 2.0, 0.0}, {}, foot.wall);
  foot.play(10.5);
  foot.motion.lift(foot.wall);
  const double lifted = foot.wall;
  foot.play(lifted + 0.05);
  EXPECT_GT(foot.place()[2], kStands + 0.01);
  EXPECT_LT(foot.place()[2], kStands + 0.6 * 0.05);
  foot.play(lifted + 1.0);
  EXPECT_NEAR(foot.place()[2], kStands + kWater + 0.12, 1.0e-9);
}

TEST(FloorMotion, ATouchThatIsLostForAMomentIsTheSame) {
  Foot foot;
  foot.motion.touch({1.0, 2.0, 0.0}, {}, foot.wall);
  foot.play(10.5);
  foot.motion.lift(foot.wall);
  foot.play(foot.wall + 0.015);
  EXPECT_NEAR(foot.place()[2], kStands, 1.0e-9) << "not lifted yet";
  foot.motion.touch({1.0, 2.0, 0.0}, {}, foot.wall);
  foot.play(foot.wall + 0.1);
  EXPECT_EQ(foot.jumps, 1);
  EXPECT_NEAR(foot.place()[2], kStands, 1.0e-9);
}

TEST(FloorMotion, NobodyStandsOnAFloorThatIsSilent) {
  Foot foot;
  foot.motion.touch({1.0, 2.0, 0.0}, {}, foot.wall);
  foot.play(12.9);
  EXPECT_NEAR(foot.place()[2], kStands, 1.0e-9);
  foot.play(14.0);
  EXPECT_GT(foot.place()[2], kStands + kWater);
}

TEST(FloorMotion, TakesNoPosesAndNoPlaceOutOfTheRoom) {
  Foot foot;
  EXPECT_EQ(foot.motion.push({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {}), PoseRefusal::not_tracked);
  foot.motion.touch({1.0e30, 0.0, 0.0}, {}, foot.wall);
  foot.motion.touch({0.0, std::nan(""), 0.0}, {}, foot.wall);
  foot.play(10.2);
  EXPECT_EQ(foot.jumps, 0);
}

}  // namespace
}  // namespace splash::sim
