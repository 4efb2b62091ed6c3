// SPDX-License-Identifier: MIT
// A recorded walk against the force plates recorded with it: every contact of a foot with the floor
// is found by the calibrated sole alone, within two tracker frames; a foot that swings makes none.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/bodies/motion/marker_file.hpp"
#include "sim-server/bodies/motion/marker_motion.hpp"
#include "sim-server/bodies/motion/sole_calibration.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/sim-server/bodies/motion/motion_checks.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::sim {
namespace {

const std::filesystem::path kWalk = tests::scene_folder() / "walk.trc";
constexpr double kTwoFrames = 2.0 / 60.0;  // s
constexpr double kEnd = 2.5;               // of the recording [s]

std::map<std::string, std::vector<double>> plate_contacts() {
  std::map<std::string, std::vector<double>> contacts;
  std::ifstream file(tests::source_folder() / "tests/data/walk_contacts.csv");
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
/// foot counts as clear. The floor is taken to be `offset` higher.
std::vector<double> sole_contacts(const BodySettings& foot, const Motion& motion, double offset) {
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
  Scene scene_ = read_scene(tests::scene_file("walk"));
  const BodySettings& foot_ = scene_.bodies.at(GetParam() == "foot_left" ? 0 : 1);
  std::unique_ptr<Motion> motion_ = make_motion(foot_, kWalk);
  const std::vector<double> contacts_ = plate_contacts().at(GetParam());

  void expect_contacts(double offset, double within) const {
    auto found = sole_contacts(foot_, *motion_, offset);
    // A foot may stand already when the recording begins.
    if (found.size() > contacts_.size() && found.front() < kTwoFrames) found.erase(found.begin());
    ASSERT_EQ(found.size(), contacts_.size()) << offset << ": " << ::testing::PrintToString(found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], contacts_[i], within) << offset;
    }
  }
};

TEST_P(Walk, EachContactOfThePlatesIsOneContactOfTheSole) {
  ASSERT_EQ(foot_.name, GetParam());
  expect_contacts(0.0, kTwoFrames);
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
  for (const double offset : {-0.001, 0.001}) expect_contacts(offset, 1.5 * kTwoFrames);
}

INSTANTIATE_TEST_SUITE_P(BothFeet, Walk, ::testing::Values("foot_left", "foot_right"),
                         [](const auto& foot) { return foot.param; });

}  // namespace
}  // namespace splash::sim
