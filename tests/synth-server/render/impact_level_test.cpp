// SPDX-License-Identifier: MIT
// The impact's amplitude by what is felt; that it is felt so is measured in sound/calibration_test.
#include "synth-server/render/impact_level.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "synth-server/voices/impact_voice.hpp"

namespace splash::synth {
namespace {

Output output(Sense sense, double level_db) {
  Output output;
  output.name = sense == Sense::touch ? "hand" : "ear";
  output.threshold = {sense, level_db};
  return output;
}

Rig rig_of(std::vector<Output> outputs) {
  Rig rig;
  rig.outputs = std::move(outputs);
  return rig;
}

TEST(WantedLevel, IsALineInTheLogarithmOfTheSpeed) {
  const ImpactSound sound;
  EXPECT_NEAR(wanted_level_db(sound, 0.05), 6.0, 1e-12);
  EXPECT_NEAR(wanted_level_db(sound, 0.5), 21.0, 1e-12);
  EXPECT_NEAR(wanted_level_db(sound, 5.0), 36.0, 1e-12);
  EXPECT_NEAR(wanted_level_db(sound, 50.0), 51.0, 1e-12) << "it goes on";
}

TEST(ImpactLevel, IsThePowerLawsToTheBitUnlessSensationIsAskedFor) {
  ImpactLevel level(rig_of({output(Sense::touch, -52.0)}));
  const auto at = level.at({}, 1.7);
  EXPECT_EQ(at.most, impact_amplitude({}, 1.7));
  EXPECT_TRUE(at.parts.empty());
}

TEST(ImpactLevel, GivesEachOutputWhatItsThresholdAsksFor) {
  Output strong = output(Sense::touch, -72.0);
  strong.name = "floor";
  ImpactLevel level(rig_of({output(Sense::touch, -52.0), strong, output(Sense::hearing, -107.0)}));
  const ImpactSound sound{.sensation = 1.0};
  const auto at = level.at(sound, 0.5);
  ASSERT_EQ(at.parts.size(), 3U);
  EXPECT_DOUBLE_EQ(at.parts[0], 1.0);
  EXPECT_NEAR(at.parts[1], 0.1, 1e-12) << "20 dB more sensitive";
  EXPECT_NEAR(at.parts[2], 1.0, 1e-12) << "loudspeakers play what a hand would feel";
  const double hand = felt_level_db(sound, output(Sense::touch, -52.0));
  EXPECT_NEAR(20.0 * std::log10(at.most / 0.01) + hand, 21.0, 1e-9);
  EXPECT_NEAR(level.at(sound, 5.0).most / level.at(sound, 0.05).most, std::pow(10.0, 1.5), 1e-9);
}

TEST(ImpactLevel, MixesInDecibelsAndIsNilWithoutSpeed) {
  ImpactLevel level(rig_of({output(Sense::touch, -52.0)}));
  const double power = level.at({}, 2.0).most;
  const double felt = level.at({.sensation = 1.0}, 2.0).most;
  EXPECT_NEAR(level.at({.sensation = 0.5}, 2.0).most, std::sqrt(power * felt), 1e-12);
  EXPECT_EQ(level.at({.sensation = 1.0}, 0.0).most, 0.0);
  EXPECT_EQ(level.at({.sensation = 0.5}, -1.0).most, 0.0);
}

TEST(ImpactLevel, FollowsAChangedBurst) {
  ImpactLevel level(rig_of({output(Sense::touch, -52.0)}));
  const double before = level.at({.sensation = 1.0}, 1.0).most;
  const double dull = level.at({.frequency = 160.0, .sensation = 1.0}, 1.0).most;
  EXPECT_LT(20.0 * std::log10(dull / before), -15.0)
      << "less of it is needed where it is felt well";
  EXPECT_EQ(level.at({.sensation = 1.0}, 1.0).most, before);
}

}  // namespace
}  // namespace splash::synth
