// SPDX-License-Identifier: MIT
// A recorded walk against the force plates recorded with it: every contact of a foot with the floor
// is found by the calibrated sole alone, within two tracker frames; a foot that swings makes none.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/bodies/motion/marker_file.hpp"
#include "sim-server/bodies/motion/marker_motion.hpp"
#include "sim-server/bodies/motion/sole_calibration.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/sim-server/bodies/motion/motion_checks.hpp"

namespace splash::sim {
namespace {

const std::filesystem::path kSource = SPLASH_SOURCE_DIR;
const std::filesystem::path kWalk = kSource / "configs" / "scenes" / "walk.trc";
constexpr double kTwoFrames = 2.0 / 60.0;  // s
constexpr double kEnd = 2.5;               // of the recording [s]

std::map<std::string, std::vector<double>> plate_contacts() {
  std::map<std::string, std::vector<double>> contacts;
  std::ifstream file(kSource / "tests" / "data" / "walk_contacts.csv");
  std::string line;
  while (std::getline(file, line)) {
    const auto comma = line.find(',');
    if (line.starts_with('#') || line.starts_with("foot") || comma == std::string::npos) continue;
    contacts["foot_" + line.substr(0, comma)].push_back(std::stod(line.substr(comma + 1)));
  }
  return contacts;
}

double height(const BodySettings& foot, const BodyState& state) {
  return sole_height(foot.shape, {}, {state.rotation, state.position});
}

/// Times at which the sole reaches the floor after it was clear of it by 6 mm; at the start the
/// foot counts as clear. With `offset` the floor is taken to be that much higher.
std::vector<double> sole_contacts(const BodySettings& foot, const Motion& motion,
                                  double offset = 0.0) {
  constexpr double kRelease = 0.006;
  std::vector<double> times;
  bool clear = true;
  for (double t = 0.0; t < kEnd; t += 0.0005) {
    const double gap = height(foot, motion.at(t)) - offset;
    if (clear && gap <= 0.0) {
      times.push_back(t);
      clear = false;
    }
    clear = clear || gap > kRelease;
  }
  return times;
}

class Walk : public ::testing::TestWithParam<std::string> {
 protected:
  Scene scene_ = read_scene(kSource / "configs" / "scenes" / "walk.yaml");
  const BodySettings& foot_ = scene_.bodies.at(GetParam() == "foot_left" ? 0 : 1);
  std::unique_ptr<Motion> motion_ = make_motion(foot_, kWalk);
  const std::vector<double> contacts_ = plate_contacts().at(GetParam());
};

TEST_P(Walk, EachContactOfThePlatesIsOneContactOfTheSole) {
  ASSERT_EQ(foot_.name, GetParam());
  const auto& wanted = contacts_;
  auto found = sole_contacts(foot_, *motion_);
  // A foot may stand already when the recording begins.
  if (found.size() > wanted.size() && found.front() < kTwoFrames) found.erase(found.begin());
  ASSERT_EQ(found.size(), wanted.size()) << ::testing::PrintToString(found);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    RecordProperty("late_ms_" + std::to_string(i), std::to_string(1e3 * (found[i] - wanted[i])));
    EXPECT_NEAR(found[i], wanted[i], kTwoFrames);
  }
}

TEST_P(Walk, ASwingingFootIsClearOfTheFloor) {
  // From 0.15 s to 0.3 s before each contact the foot swings past the standing leg, its toes
  // lowest.
  for (const double contact : contacts_) {
    for (double before = 0.15; before < 0.3 && before < contact; before += 0.002) {
      EXPECT_GT(height(foot_, motion_->at(contact - before)), 0.006) << contact - before;
    }
  }
}

TEST_P(Walk, AStandingFootStaysOnTheFloor) {
  for (const double contact : contacts_) {
    for (double after = 0.15; after < 0.45 && contact + after < kEnd; after += 0.01) {
      const double gap = height(foot_, motion_->at(contact + after));
      EXPECT_LT(gap, 0.0) << contact + after;
      EXPECT_GT(gap, -0.015) << contact + after;
    }
  }
}

TEST_P(Walk, EveryFrameGivesAPose) {
  const auto recording = read_markers(kWalk);
  const auto poses = marker_poses(recording, foot_.motion.markers, foot_.shape, true);
  EXPECT_EQ(poses.size(), recording.frames.size());
}

TEST_P(Walk, VelocitiesAreTheDerivatives) {
  for (double t = 0.011; t < kEnd; t += 0.0437) expect_consistent(*motion_, t, 2e-3);
}

TEST_P(Walk, AHiddenMarkerChangesLittleAndALostFootIsBridged) {
  auto recording = read_markers(kWalk);
  const auto whole = marker_poses(recording, foot_.motion.markers, foot_.shape, true);
  const std::string side = GetParam() == "foot_left" ? "L." : "R.";
  for (std::size_t k = 0; k < recording.names.size(); ++k) {
    if (!recording.names[k].starts_with(side)) continue;
    recording.frames[30][k].reset();
    if (recording.names[k] == side + "Toe.Tip") recording.frames[32][k].reset();
  }
  const auto gappy = marker_poses(recording, foot_.motion.markers, foot_.shape, true);
  ASSERT_EQ(gappy.size() + 1, whole.size());
  EXPECT_LT(length(gappy[31].position - whole[32].position), 0.01);
}

TEST_P(Walk, TheCalibrationIsNotOnAKnifesEdge) {
  // Millimetres of floor height must not lose, double or far displace a contact.
  const auto& wanted = contacts_;
  for (const double offset : {-0.001, 0.001}) {
    auto found = sole_contacts(foot_, *motion_, offset);
    if (found.size() > wanted.size() && found.front() < kTwoFrames) found.erase(found.begin());
    ASSERT_EQ(found.size(), wanted.size()) << offset;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      EXPECT_NEAR(found[i], wanted[i], 1.5 * kTwoFrames) << offset;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothFeet, Walk, ::testing::Values("foot_left", "foot_right"),
                         [](const auto& foot) { return foot.param; });

}  // namespace
}  // namespace splash::sim
