// SPDX-License-Identifier: MIT
// Pd plays another sound as the synth does: a preset by its name, one number by its own. The
// generated patches are those of the rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>

#include "synth-server/pd_sound.hpp"
#include "synth-server/sound/sound_reader.hpp"
#include "tests/pd-patches/rendering.hpp"

namespace splash::pd {
namespace {

constexpr double kTolerance = -75.0;  ///< largest difference re the peak [dB]
constexpr std::int64_t kFrames = 96000;

const std::filesystem::path kSource = SPLASH_SOURCE_DIR;

double energy(const Channels& channels) {
  double sum = 0.0;
  for (const auto& channel : channels) {
    for (const float s : channel) sum += static_cast<double>(s) * static_cast<double>(s);
  }
  return sum;
}

/// Far apart in time, so that none lowers another's pitch: Pd has no clouds.
std::vector<protocol::LogEntry> some_tones() {
  const protocol::Vec3 place{0.7F, 1.1F, 0.2F};
  return make_log({{0.1, protocol::Bubble{1, 0, 0.008F, 0.05F, place, 0.0F}},
                   {0.5, protocol::Bubble{2, 0, 0.02F, 0.02F, place, 0.0F}},
                   {1.0, protocol::Cavity{3, 0, 0.06F, 0.1F, place, 0.0F}}});
}

void compare(const synth::Sound& sound, const std::vector<std::string>& messages) {
  const Channels synth = render_with_synth(some_tones(), kTiles, kFrames, sound);
  const Channels pd = render_with_pd(some_tones(), kTiles, kFrames, messages);
  float peak = 0.0F;
  for (const auto& channel : synth) {
    for (const float s : channel) peak = std::max(peak, std::abs(s));
  }
  ASSERT_GT(peak, 0.01F);
  const double level =
      decibels(largest_difference(pd, synth, 0, kFrames) / static_cast<double>(peak));
  std::cout << messages.front() << ": " << level << " dB re the peak\n";
  EXPECT_LT(level, kTolerance);
}

TEST(Presets, ChangeBubblesAndCavitiesAsTheSynthHasThem) {
  for (const std::string name : {"deep", "drops", "calibrated"}) {
    const auto sound = synth::read_sound(kSource / "configs/sounds" / (name + ".yaml")).sound;
    compare(sound, {"splash-preset " + name});
  }
}

TEST(Presets, ANumberCanBeSetByItself) {
  synth::Sound sound;
  sound.bubble.pitch = 0.7;
  sound.bubble.gain_db = -6.0;
  sound.cavity.damping = 20.0;
  compare(sound, {"splash-set-bubble_pitch 0.7", "splash-set-bubble_gain_db -6",
                  "splash-set-cavity_damping 1000"});  // held to the row's largest, 20
}

/// By what is felt, and of a hand that slides a little as it comes down.
TEST(Presets, MakeImpactsAsStrongAsTheSynthDoes) {
  std::vector<EventAt> events;
  for (int i = 0; i < 60; ++i) {
    const protocol::Vec3 place{0.305F * (static_cast<float>(i % 6) + 0.5F), 0.9F, 0.0F};
    const float speed = i % 2 == 0 ? 0.2F : 1.5F;
    events.push_back({0.05 * i, protocol::Impact{i, 0, 1.2F * speed, speed, place, 0.0F}});
  }
  constexpr std::int64_t kLong = 192000;
  for (const std::string name : {"calibrated", "shore"}) {
    const auto sound = synth::read_sound(kSource / "configs/sounds" / (name + ".yaml")).sound;
    synth::Sound burst;
    burst.impact = sound.impact;  // Pd has nothing under the foot
    for (const RigPair& rig : {kTiles, kStereo}) {
      const double ratio =
          energy(render_with_pd(make_log(events), rig, kLong, {"splash-preset " + name})) /
          energy(render_with_synth(make_log(events), rig, kLong, burst));
      std::cout << name << ", " << rig.rig << ": " << 10.0 * std::log10(ratio) << " dB\n";
      // 30 strong bursts of noise 32 Hz wide: two means of them differ by 0.65 dB (sd).
      EXPECT_NEAR(10.0 * std::log10(ratio), 0.0, 1.2);
    }
  }
}

TEST(Presets, ThePatchesAreThoseOfTheRows) {
  for (const auto& [name, text] : synth::pd_sound(kSource / "configs")) {
    std::ifstream file(kSource / "pd-patches" / name);
    const std::string committed((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(committed, text) << "ninja pd-sound && bin/pd-sound configs pd-patches";
  }
}

}  // namespace
}  // namespace splash::pd
