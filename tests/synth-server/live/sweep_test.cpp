// SPDX-License-Identifier: MIT
// The measuring sweep against transducers that are known: filters, with noise, distortion and a
// delay, in the file domain.
#include "synth-server/calibrate/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "synth-server/output/equaliser.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/output/wav_file.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/synth-server/live/transducer.hpp"

namespace splash::synth {
namespace {

constexpr double kRate = 8000.0;  // enough for a floor, and quick

/// A shaker with a resonance, a dip, and a second resonance.
Transducer transducer() {
  return {kRate,
          {peak(95.0, 14.0, 2.5, kRate), peak(220.0, -8.0, 1.5, kRate),
           high_shelf(450.0, 6.0, 0.7, kRate)}};
}

/// What it does, plus distortion, a room's noise, and the time until the recorder got it.
std::vector<float> heard_of(const std::vector<float>& sent, double noise, double square) {
  Transducer shaker = transducer();
  std::mt19937_64 random(11);
  std::normal_distribution<double> draw(0.0, noise);
  std::vector<float> heard;
  for (int n = 0; n < 5237; ++n) heard.push_back(static_cast<float>(draw(random)));
  for (const float sample : sent) {
    double out = shaker.process(static_cast<double>(sample));
    out += square * out * out;
    heard.push_back(static_cast<float>(0.3 * out + draw(random)));
  }
  return heard;
}

/// Of what is heard of the sweep of tile 07.
void expect_measured(double noise, double square, double tolerance) {
  const Rig rig = read_rig(tests::rig_path("tiles36.yaml"));
  const auto sent = sweep_of(rig, 7, kRate);
  EXPECT_LE(*std::max_element(sent.begin(), sent.end()), 0.26 * rig.outputs[0].ceiling);
  const auto heard = heard_of(sent, noise, square);
  transducer().expect_measured(response_of(heard, sent, rig.outputs[0].band, kRate), tolerance);
}

TEST(Sweep, FindsAKnownFilterInsideTheBand) {
  expect_measured(0.0, 0.0, 0.2);
}

TEST(Sweep, BearsNoiseAndDistortion) {
  // 30 dB under the sweep, and half as much of the second harmonic where it is loudest.
  expect_measured(0.0015, 1.0, 1.0);
}

TEST(Sweep, RefusesARecordingWithoutIt) {
  const Rig rig = read_rig(tests::rig_path("tiles36.yaml"));
  const auto sent = sweep_of(rig, 0, kRate);
  std::vector<float> noise(sent.size());
  std::mt19937_64 random(3);
  std::normal_distribution<float> draw(0.0F, 0.1F);
  for (float& sample : noise) sample = draw(random);
  EXPECT_THROW((void)response_of(noise, sent, rig.outputs[0].band, kRate), std::runtime_error);
  EXPECT_THROW((void)response_of({}, sent, rig.outputs[0].band, kRate), std::runtime_error);
}

/// From the programs's lines to a transducer that is even.
TEST(Sweep, PrintsAnEqualiserThatEvensTheTransducerOut) {
  const tests::TemporaryFolder folder;
  const std::string recording = folder / "heard.wav";
  const Rig tiles = read_rig(tests::rig_path("tiles36.yaml"));
  const auto heard = heard_of(sweep_of(tiles, 7, kRate), 0.0002, 0.0);
  {
    WavFile file(recording, 1, static_cast<int>(kRate));
    const float* planar = heard.data();
    file.write(&planar, static_cast<int>(heard.size()));
    file.close();
  }
  const auto [code, text] = tests::run_program(
      "synth-server",
      {"--rig", tests::rig_path("tiles36.yaml"), "--sweep", "8", "--response", recording});
  ASSERT_EQ(code, 0) << text;
  EXPECT_THAT(text, testing::HasSubstr("channels: [tile/07]"));
  const std::string lines = text.substr(text.find("    equalisers:"));
  const Rig rig = parse_rig(
      "name: r\noutputs:\n  - name: floor\n    kind: tiles\n    band: {low: 20, high: 750}\n" +
          lines,
      "r.yaml");
  const Equaliser equaliser(rig.outputs[0], 7, kRate);
  double least = 1e9;
  double most = -1e9;
  for (double f = 25.0; f < 600.0; f *= 1.1) {
    const double level = equaliser.gain_db(f, kRate) + 20.0 * std::log10(transducer().gain(f));
    least = std::min(least, level);
    most = std::max(most, level);
  }
  EXPECT_LT(most - least, 6.0) << "22 dB without it; a fit overshoots by 2 dB between its points";
}

TEST(Sweep, OfAChannelThatIsNotThereIsRefused) {
  const auto [code, text] = tests::run_program(
      "synth-server", {"--rig", tests::rig_path("handheld+stereo.yaml"), "--sweep", "4"});
  EXPECT_EQ(code, 64) << text;
  EXPECT_THAT(text, testing::HasSubstr("the rig has 3 channels"));
}

}  // namespace
}  // namespace splash::synth
