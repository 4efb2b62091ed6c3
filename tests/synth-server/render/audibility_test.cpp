// SPDX-License-Identifier: MIT
// How quiet is too quiet: the threshold curves, and the floor that follows for an output.
#include "synth-server/render/audibility.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "program/config.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

double db(double amplitude) {
  return 20.0 * std::log10(amplitude);
}

TEST(TouchThreshold, IsBolanowskisInAcceleration) {
  EXPECT_DOUBLE_EQ(touch_threshold_db(250.0), 0.0);
  // 20 Hz: 11 dB re 1 um against -20 dB at 250 Hz, less 40 dB per decade.
  EXPECT_NEAR(touch_threshold_db(20.0), 31.0 - 40.0 * std::log10(12.5), 1e-9);
  EXPECT_NEAR(touch_threshold_db(500.0), 11.0 + 40.0 * std::log10(2.0), 1e-9);
  EXPECT_DOUBLE_EQ(touch_threshold_db(3000.0), touch_threshold_db(500.0));
  EXPECT_NEAR(touch_threshold_db(28.284271),
              0.5 * (touch_threshold_db(20.0) + touch_threshold_db(40.0)), 1e-4);
}

TEST(HearingThreshold, IsTerhardts) {
  EXPECT_DOUBLE_EQ(hearing_threshold_db(1000.0), 0.0);
  const double at_1k = 3.64 - 6.5 * std::exp(-0.6 * 2.3 * 2.3) + 0.001;
  // 100 Hz: 22.97 dB SPL, the formula's best known value; 3.3 kHz: -4.98.
  EXPECT_NEAR(hearing_threshold_db(100.0) + at_1k, 22.95, 0.05);
  EXPECT_NEAR(hearing_threshold_db(3300.0) + at_1k, -4.98, 0.01);
}

TEST(Audibility, Is120DecibelsBelowFullScaleWhereNothingIsKnown) {
  const Audibility plain(open_rig().outputs[0], true);
  for (const double f : {0.0, 5.0, 100.0, 7000.0, 1e5})
    EXPECT_NEAR(db(plain.floor(f)), -120.0, 1e-9);
}

TEST(Audibility, FollowsTheThresholdFromTheVoicesPitchUpwards) {
  Output output = floor_rig().outputs[0];
  output.threshold = {Sense::touch, -50.0};
  const Audibility felt(output, true);
  // 250 Hz rises to 942 Hz, where touch is duller: the start decides, 20 dB of margin below.
  EXPECT_NEAR(db(felt.floor(250.0)), -70.0, 1.5);
  // 20 Hz rises through 75 Hz, where the band cuts less and touch is as keen.
  EXPECT_LT(db(felt.floor(20.0)), -70.0 + touch_threshold_db(75.0) + 2.0);
  EXPECT_LE(felt.floor(0.0), felt.floor(20.0)) << "a noise has all pitches";
  EXPECT_NEAR(db(Audibility(output, false).floor(250.0)), -120.0, 1e-9) << "the switch";
  output.threshold.level_db = -130.0;
  EXPECT_NEAR(db(Audibility(output, true).floor(250.0)), -120.0, 1e-9) << "never below that";
}

TEST(Audibility, IsToldByTheRigFile) {
  const auto rig = [](const std::string& threshold) {
    return parse_rig(
        "name: r\noutputs:\n  - name: hand\n    kind: single\n"
        "    band: {low: 20, high: 750}\n    threshold: " +
            threshold + "\n",
        "r.yaml");
  };
  const Threshold touch = rig("{sense: touch, level_db: -62}").outputs[0].threshold;
  EXPECT_EQ(touch.sense, Sense::touch);
  EXPECT_DOUBLE_EQ(touch.level_db, -62.0);
  EXPECT_EQ(rig("{sense: hearing, level_db: -90}").outputs[0].threshold.sense, Sense::hearing);
  EXPECT_THROW(rig("{sense: smell, level_db: -90}"), program::ConfigError);
  EXPECT_THROW(rig("{sense: touch}"), program::ConfigError);
  EXPECT_THROW(rig("{sense: touch, level_db: 3}"), program::ConfigError);
}

}  // namespace
}  // namespace splash::synth
