// SPDX-License-Identifier: MIT
// Each kind of body gets its motion; what cannot be made says which body and why.
#include "sim-server/bodies/motion/make_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "sim-server/bodies/motion/live_motion.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/scene_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kWalk = tests::scene_folder() / "walk.trc";

BodySettings body(MotionKind kind) {
  BodySettings settings;
  settings.name = "probe";
  settings.rest.position = {1.0, 2.0, 3.0};
  settings.motion.kind = kind;
  return settings;
}

std::string refusal(const BodySettings& settings, const std::filesystem::path& tracker = {}) {
  return tests::refusal([&] { return make_motion(settings, tracker); });
}

/// A TRC file of a body that stands: four markers 0.02 s apart, data from line 6 on. In the fourth
/// frame and after it all of them are `jump` metres higher.
class MarkerText {
 public:
  MarkerText(const std::string& names, int frames, double jump) {
    std::ostringstream text;
    text << "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n50\t"
         << frames << "\t4\tm\nFrame#\tTime\t" << names << "\n\t\tX1\tY1\tZ1\n";
    for (int k = 0; k < frames; ++k) {
      const double y = k < 3 ? 0.0 : jump;
      text << k + 1 << '\t' << 0.02 * k << "\t0\t" << y << "\t0\t0.2\t" << y << "\t0\t0.1\t" << y
           << "\t0.1\t0\t0\t0\n";
    }
    folder_.write("markers.trc", text.str());
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "markers.trc"; }

 private:
  tests::TemporaryFolder folder_;
};

TEST(MakeMotion, FixedBodiesStay) {
  const auto motion = make_motion(body(MotionKind::fixed), {});
  EXPECT_EQ(motion->at(7.0).position, (Vector3{1.0, 2.0, 3.0}));
}

TEST(MakeMotion, OscBodiesAreLive) {
  const auto motion = make_motion(body(MotionKind::osc), {});
  auto* live = dynamic_cast<LiveMotion*>(motion.get());
  ASSERT_NE(live, nullptr);
  EXPECT_EQ(live->at(0.0).position, (Vector3{1.0, 2.0, 3.0}));
}

TEST(MakeMotion, OscBodiesBridgeOrHoldGapsAsTheSceneSays) {
  // How far a body gets that was seen moving at 1 m/s, and then no more [m].
  const auto beyond = [](GapKind gap, double limit) {
    BodySettings settings = body(MotionKind::osc);
    settings.motion.gap = gap;
    settings.motion.gap_limit = limit;
    const auto motion = make_motion(settings, {});
    auto& live = dynamic_cast<LiveMotion&>(*motion);
    for (int i = 0; i < 30; ++i) {
      static_cast<void>(live.push({i / 60.0, 0.0, 1.0}, {0, 0, 0, 1}, {i / 60.0, {}}));
    }
    live.begin({9.0, 9.0, 0.01});
    return live.at(9.0).position[0] - 29 / 60.0;
  };
  EXPECT_NEAR(beyond(GapKind::bridge, 0.3), 0.325, 0.003);
  EXPECT_NEAR(beyond(GapKind::bridge, 0.025), 2.5 / 60.0 + 0.025, 0.003)
      << "two and a half times what is between two poses";
  EXPECT_NEAR(beyond(GapKind::hold, 0.3), 0.0, 1e-3);
}

TEST(MakeMotion, ScriptsAreSmoothOrStraight) {
  BodySettings settings = body(MotionKind::script);
  settings.motion.keyframes = {{0.0, {0, 0, 1}, {0, 0, 0, 1}}, {1.0, {0, 0, 0}, {0, 0, 0, 1}}};
  EXPECT_NEAR(make_motion(settings, {})->at(0.01).velocity[2], 0.0, 0.1) << "starts gently";
  settings.motion.smooth = false;
  EXPECT_NEAR(make_motion(settings, {})->at(0.01).velocity[2], -1.0, 1e-12);
  settings.motion.repeat = true;
  EXPECT_THAT(refusal(settings), HasSubstr("body 'probe': the motion cannot repeat"));
}

TEST(MakeMotion, MarkersComeFromTheTrackersFile) {
  BodySettings settings = body(MotionKind::trc);
  settings.motion.markers = {"R.Heel", "R.Toe.Tip", "R.Midfoot.Sup"};
  EXPECT_THAT(refusal(settings), HasSubstr("--tracker FILE.trc"));
  EXPECT_NE(make_motion(settings, kWalk), nullptr);
  settings.motion.markers[1] = "Nose";
  EXPECT_THAT(refusal(settings, kWalk), HasSubstr("no marker 'Nose'; it has R.Heel"));
  settings.motion.markers[1] = "R.Toe.Tip";
  settings.motion.start = 99.0;
  EXPECT_THAT(refusal(settings, kWalk), HasSubstr("the recording ends at 2.5"));
  EXPECT_THAT(refusal(settings, "/nowhere/walk.trc"), HasSubstr("/nowhere/walk.trc"));
}

TEST(MakeMotion, OfTwoMarkersOfOneNameNoneIsTaken) {
  const MarkerText text("Heel\t\t\tToe\t\t\tSide\t\t\tToe", 3, 0.3);
  BodySettings settings = body(MotionKind::trc);
  settings.motion.markers = {"Heel", "Toe", "Side"};
  EXPECT_THAT(refusal(settings, text.path()), HasSubstr("more than one marker 'Toe'"));
}

TEST(MakeMotion, MarkersThatNoBodyCanFollowAreToldByTheirLines) {
  BodySettings settings = body(MotionKind::trc);
  settings.motion.markers = {"Heel", "Toe", "Side"};
  const std::string names = "Heel\t\t\tToe\t\t\tSide\t\t\tSide.Mean";
  EXPECT_EQ(refusal(settings, MarkerText(names, 5, 0.3).path()), "");
  const MarkerText text(names, 5, 0.5);
  EXPECT_THAT(refusal(settings, text.path()),
              HasSubstr(text.path().string() + ":9:1: error: body 'probe': 0.5 m in 0.02 s is 25 "
                                               "m/s, beyond the limit of 20: its markers in one of "
                                               "the frames of lines 8 and 9"));
}

TEST(MakeMotion, StartSkipsTheRecording) {
  BodySettings settings = body(MotionKind::trc);
  settings.motion.markers = {"R.Heel", "R.Toe.Tip", "R.Midfoot.Sup", "R.Toe.Lat"};
  const auto whole = make_motion(settings, kWalk);
  settings.motion.start = 0.75;
  const auto cut = make_motion(settings, kWalk);
  EXPECT_LT(length(cut->at(0.2).position - whole->at(0.95).position), 1e-12);
}

}  // namespace
}  // namespace splash::sim
