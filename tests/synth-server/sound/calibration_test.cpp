// SPDX-License-Identifier: MIT
// What is felt of a sound: of impacts by their speed, and of the three components in recorded
// scenes, measured on the samples that a rig gets.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <span>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "protocol/event_log.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/render/audibility.hpp"
#include "synth-server/render/engine.hpp"
#include "synth-server/replay/replay.hpp"
#include "synth-server/sound/sound_rows.hpp"

namespace splash::synth {
namespace {

// How strongly a signal is felt: its third-octave levels in windows of 125 ms over the threshold of
// touch, measured on its samples. The level of a band is its effective value re full scale; a
// sine's amplitude, by which rigs state the threshold, is 3 dB more.

constexpr double kSensationWindow = 0.125;  ///< [s]
constexpr std::size_t kThirds = 18;         ///< of octaves, from 20 Hz to 1 kHz
using ThirdPowers = std::array<double, kThirds>;

double middle_of(std::size_t third) {
  return 1000.0 * std::exp2((static_cast<double>(third) - 17.0) / 3.0);
}

/// Mean square of the sine of `turns` turns in the window (Goertzel 1958).
double bin_power(std::span<const float> window, int turns) {
  const auto count = static_cast<double>(window.size());
  const double w = 2.0 * std::numbers::pi * turns / count;
  const double twice = 2.0 * std::cos(w);
  double last = 0.0;
  double before = 0.0;
  for (const float sample : window) {
    const double now = static_cast<double>(sample) + twice * last - before;
    before = last;
    last = now;
  }
  return 2.0 * (last * last + before * before - twice * last * before) / (count * count);
}

/// Mean square of each third of an octave [full scale^2], of one window of samples.
ThirdPowers third_powers(std::span<const float> window, double sample_rate) {
  ThirdPowers powers{};
  const double width = sample_rate / static_cast<double>(window.size());  // of a bin [Hz]
  const double edge = std::exp2(1.0 / 6.0);
  const int last = static_cast<int>(middle_of(kThirds - 1) * edge / width) + 1;
  for (int turns = 1; turns <= last; ++turns) {
    const double power = bin_power(window, turns);
    const double low = (turns - 0.5) * width;
    for (std::size_t third = 0; third < kThirds; ++third) {
      const double from = std::max(low, middle_of(third) / edge);
      const double to = std::min(low + width, middle_of(third) * edge);
      powers[third] += power * std::max(0.0, to - from) / width;
    }
  }
  return powers;
}

/// The loudest of them over the threshold [dB]; `level_db`: the rig's threshold at 250 Hz.
double sensation_level_db(const ThirdPowers& powers, double level_db) {
  double loudest = -300.0;
  for (std::size_t third = 0; third < kThirds; ++third) {
    const double level = 10.0 * std::log10(powers[third] + 1e-30);
    loudest = std::max(loudest, level - level_db - touch_threshold_db(middle_of(third)));
  }
  return loudest;
}

/// Of each half window of a signal.
std::vector<double> sensation_levels(std::span<const float> signal, double sample_rate,
                                     double level_db) {
  const auto count = static_cast<std::size_t>(kSensationWindow * sample_rate);
  std::vector<double> levels;
  for (std::size_t at = 0; at + count <= signal.size(); at += count / 2) {
    levels.push_back(
        sensation_level_db(third_powers(signal.subspan(at, count), sample_rate), level_db));
  }
  return levels;
}

constexpr int kRate = 48000;
constexpr double kThreshold = -52.0;  ///< of handheld.yaml [dB]
const std::filesystem::path kRoot = SPLASH_SOURCE_DIR;

Sound shipped(const std::string& name) {
  return read_sound(kRoot / "configs/sounds" / (name + ".yaml")).sound;
}

Rig handheld() {
  return read_rig(kRoot / "configs/rigs/handheld.yaml");
}

/// What a hand gets of bursts at one speed.
struct Felt {
  double rms_db = 0.0;        ///< of the first 125 ms [dB re full scale]
  double level_db = 0.0;      ///< over the threshold
  std::uint64_t limited = 0;  ///< samples that the limiter turned down
};

Felt bursts(const Sound& sound, double speed, const Rig& rig = handheld(), int count = 24) {
  constexpr int kApart = kRate;  // each has died away
  EngineSettings settings;
  settings.sample_rate = kRate;
  settings.start_ramp = 0.0;
  settings.sound = sound;
  Engine engine(rig, settings);
  std::vector<float> out(kApart);
  float* channel = out.data();
  ThirdPowers mean{};
  double power = 0.0;
  constexpr auto kCount = static_cast<std::size_t>(kSensationWindow * kRate);
  for (int burst = 0; burst < count; ++burst) {
    protocol::Impact impact;
    impact.id = burst;
    impact.speed = impact.approach = static_cast<float>(speed);
    engine.schedule({impact, engine.clock()});
    for (int done = 0; done < kApart; done += 4000) {
      float* piece = channel + done;
      engine.render(&piece, 4000);
    }
    const auto window = std::span<const float>(out).first(kCount);
    const ThirdPowers powers = third_powers(window, kRate);
    for (std::size_t third = 0; third < kThirds; ++third) mean[third] += powers[third] / count;
    for (const float s : window) power += static_cast<double>(s) * static_cast<double>(s);
  }
  return {10.0 * std::log10(power / count / static_cast<double>(kCount) + 1e-30),
          sensation_level_db(mean, rig.outputs[0].threshold.level_db), engine.counters().limited};
}

void print_row(double speed, const Felt& felt) {
  std::printf("| %.2f | %.0f | %.1f | %llu |\n", speed, felt.rms_db, felt.level_db,
              static_cast<unsigned long long>(felt.limited));
}

// The measure, and what the paper's cube of the speed makes of it.
TEST(Calibration, Cirio2013IsFeltInOneDecadeOfSpeed) {
  const Sound sound = shipped("cirio2013");
  std::printf("| speed [m/s] | rms of 125 ms [dB] | over the threshold [dB] | limited |\n");
  const auto at = [&](double speed) {
    const Felt felt = bursts(sound, speed);
    print_row(speed, felt);
    return felt;
  };
  EXPECT_LT(at(0.2).level_db, -30.0);
  EXPECT_LT(at(0.5).level_db, -10.0) << "a gentle step is not felt";
  EXPECT_NEAR(at(1.0).level_db, 4.0, 1.5);
  EXPECT_NEAR(at(2.0).level_db, 22.0, 1.5);
  const Felt brisk = at(3.0);
  const Felt fast = at(5.0);
  EXPECT_LT(fast.level_db, brisk.level_db + 1.0) << "saturated";
  EXPECT_GT(fast.limited, 100U);
}

TEST(Calibration, CalibratedIsFeltEvenlyFromAGentleStepToABlow) {
  const Sound sound = shipped("calibrated");
  double before = 0.0;
  double last = 0.0;
  std::printf("| speed [m/s] | rms of 125 ms [dB] | over the threshold [dB] | limited |\n");
  for (const double speed :
       {0.05, 0.1, 0.2, 0.3, 0.5, 0.65, 0.8, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0}) {
    const Felt felt = bursts(sound, speed);
    print_row(speed, felt);
    const double wanted = 6.0 + 30.0 * std::log(speed / 0.05) / std::log(100.0);
    EXPECT_NEAR(felt.level_db, wanted, 1.0) << speed << " m/s";
    EXPECT_EQ(felt.limited, 0U) << speed << " m/s: nothing is cut at the ceiling";
    if (before > 0.0) {  // equal ratios of speed, equal steps
      EXPECT_GT(felt.level_db, last);
      EXPECT_NEAR((felt.level_db - last) / std::log(speed / before), 30.0 / std::log(100.0), 0.7);
    }
    before = speed;
    last = felt.level_db;
  }
}

// One burst of noise 32 Hz wide has a standard deviation of some 3 dB, the mean of 400 of 0.15 dB.
TEST(Calibration, CalibratedGoesFromJustFeltToStrongByTheMeanOfManyBursts) {
  const Sound sound = shipped("calibrated");
  const Felt slowest = bursts(sound, 0.05, handheld(), 400);
  const Felt fastest = bursts(sound, 5.0, handheld(), 400);
  print_row(0.05, slowest);
  print_row(5.0, fastest);
  EXPECT_NEAR(slowest.level_db, 6.0, 0.5);
  EXPECT_NEAR(fastest.level_db, 36.0, 0.5);
  EXPECT_EQ(fastest.limited, 0U);
}

// The level is found for whatever burst and transducer, not for the shipped ones alone.
TEST(Calibration, HoldsForOtherBurstsAndTransducers) {
  Rig rig = handheld();
  rig.outputs[0].threshold.level_db = -70.0;
  rig.outputs[0].full_scale = 0.002;
  rig.outputs[0].band = {50.0, 500.0};
  ImpactSound dull{.attack = 0.02, .release = 0.15, .frequency = 90.0, .q = 1.5};
  ImpactSound ringing{.release = 2.0, .frequency = 270.0, .q = 20.0};
  for (ImpactSound* impact : {&dull, &ringing}) {
    impact->sensation = 1.0;
    EXPECT_NEAR(bursts({*impact, {}, {}, {}, {}, {}}, 0.5, rig).level_db, 21.0, 1.5) << impact->q;
  }
}

/// What the channels of a rig get of a scene's recorded log.
std::vector<std::vector<float>> played(const std::string& scene, const std::string& rig_name,
                                       const Sound& sound, unsigned components = kAllComponents) {
  const Rig rig = read_rig(kRoot / "configs/rigs" / (rig_name + ".yaml"));
  ReplaySettings settings;
  settings.engine.sample_rate = kRate;
  settings.engine.sound = sound;
  settings.engine.components = components;
  std::vector<std::vector<float>> out(static_cast<std::size_t>(channel_count(rig)));
  static_cast<void>(replay(protocol::read_log(kRoot / "tests/data" / (scene + ".osc")), rig,
                           settings, [&](const float* const* channels, int frames) {
                             for (std::size_t c = 0; c < out.size(); ++c) {
                               out[c].insert(out[c].end(), channels[c], channels[c] + frames);
                             }
                           }));
  return out;
}

/// Of the half windows in which anything is felt, the part in which one component is more than
/// 20 dB over both others; what is under the threshold counts as at it.
double lopsided(const std::array<std::vector<double>, 3>& levels) {
  int felt = 0;
  int over = 0;
  for (std::size_t i = 0; i < levels[0].size(); ++i) {
    std::array<double, 3> now{};
    for (std::size_t c = 0; c < 3; ++c) now[c] = std::max(0.0, levels[c][i]);
    std::sort(now.begin(), now.end());
    if (now[2] > 0.0) ++felt;
    if (now[2] - now[1] > 20.0) ++over;
  }
  return felt > 0 ? static_cast<double>(over) / felt : 1.0;
}

struct Heard {
  const char* scene;
  const char* sound;
};

class CalibrationOf : public testing::TestWithParam<Heard> {};
INSTANTIATE_TEST_SUITE_P(Scenes, CalibrationOf,
                         testing::Values(Heard{"basin", "calibrated"}, Heard{"pool", "calibrated"},
                                         Heard{"beach", "calibrated"}, Heard{"pool", "deep"},
                                         Heard{"pool", "drops"}));

TEST_P(CalibrationOf, EachComponentIsFeltAndNoneCoversTheOthersMostOfTheTime) {
  std::array<std::vector<double>, 3> levels;
  for (std::size_t c = 0; c < 3; ++c) {
    const unsigned component = 1U << c;
    const auto hand = played(GetParam().scene, "handheld", shipped(GetParam().sound), component)[0];
    levels[c] = sensation_levels(hand, kRate, kThreshold);
    const double most = *std::max_element(levels[c].begin(), levels[c].end());
    std::printf("%s, %s, component %u: %.0f dB over the threshold at most\n", GetParam().scene,
                GetParam().sound, component, most);
    if (component == kCavities && most < -200.0) continue;  // waves close none
    EXPECT_GT(most, 10.0) << component;
    EXPECT_LT(most, 40.0) << component;
  }
  EXPECT_LT(lopsided(levels), 0.5);
}

/// Root of the mean square of the frequencies that the right loudspeaker plays of the pool [Hz].
double mean_pitch(const std::string& name) {
  double power = 0.0;
  double steps = 0.0;
  double last = 0.0;
  double peak = 0.0;
  const auto speakers = played("pool", "stereo", shipped(name));
  for (const float sample : speakers[1]) {
    const auto now = static_cast<double>(sample);
    power += now * now;
    steps += (now - last) * (now - last);
    peak = std::max(peak, std::abs(now));
    last = now;
  }
  const double pitch = kRate / std::numbers::pi * std::asin(0.5 * std::sqrt(steps / power));
  std::printf("%s: %.0f Hz, peak %.2f\n", name.c_str(), pitch, peak);
  EXPECT_GT(peak, 0.02) << name;
  EXPECT_LT(peak, 0.6) << name << " is too near the ceiling";
  return pitch;
}

TEST(Sounds, AreHigherOrLowerAsTheySay) {
  const double calibrated = mean_pitch("calibrated");
  EXPECT_GT(mean_pitch("loudspeaker"), 1.4 * calibrated);
  EXPECT_LT(mean_pitch("deep"), 0.8 * calibrated);
}

/// Energy of a scene's bubbles in the loudspeakers: all, and above 2 kHz.
std::array<double, 2> energies(const std::string& scene, const Sound& sound) {
  std::array<double, 2> sums{};
  for (const auto& channel : played(scene, "stereo", sound, kBubbles)) {
    std::vector<double> side(channel.begin(), channel.end());
    side.resize(std::bit_ceil(side.size()));
    std::vector<std::complex<double>> spectrum;
    Eigen::FFT<double>().fwd(spectrum, side);
    for (std::size_t k = 1; k < side.size() / 2; ++k) {
      const double power = std::norm(spectrum[k]);
      sums[0] += power;
      if (static_cast<double>(k) * kRate / static_cast<double>(side.size()) > 2000.0) {
        sums[1] += power;
      }
    }
  }
  return sums;
}

TEST(Sounds, LetLoudspeakersHearFineWater) {
  for (const char* scene : {"pool", "plunge", "basin", "beach"}) {
    Sound sound = shipped("loudspeaker");
    const auto [all, high] = energies(scene, sound);
    sound.fine.amount = 0.0;
    const auto [boom, least] = energies(scene, sound);
    const double with_db = 10.0 * std::log10(high / all);
    std::printf("%s: above 2 kHz %.1f dB of the bubbles' energy, %.1f dB without fine water\n",
                scene, with_db, 10.0 * std::log10(least / boom));
    EXPECT_GT(with_db, -20.0) << scene;
    EXPECT_LT(with_db, -10.0) << scene;
  }
}

}  // namespace
}  // namespace splash::synth
