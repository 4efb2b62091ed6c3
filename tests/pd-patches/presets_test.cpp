// SPDX-License-Identifier: MIT
// Pd plays another sound as the synth does: a preset by its name, one number by its own. The
// generated patches are those of the rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "synth-server/pd_sound/pd_sound.hpp"
#include "synth-server/sound/sound_rows.hpp"
#include "tests/pd-patches/rendering.hpp"
#include "tests/support/text_of.hpp"

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

std::vector<protocol::LogEntry> some_tones() {
  const protocol::Vec3 place{0.7F, 1.1F, 0.2F};
  return make_log({{0.1, protocol::Bubble{1, 0, 0.008F, 0.05F, place, 0.0F}},
                   {0.5, protocol::Bubble{2, 0, 0.02F, 0.02F, place, 0.0F}},
                   {1.0, protocol::Cavity{3, 0, 0.06F, 0.1F, place, 0.0F}}});
}

/// Sixty bubbles within 80 ms in a cupful of water, and some more later.
std::vector<protocol::LogEntry> some_cloud() {
  std::vector<EventAt> events;
  for (int i = 0; i < 70; ++i) {
    const auto part = [&](int step) { return static_cast<float>(i * step % 61) / 61.0F; };
    const protocol::Vec3 place{0.9F + 0.04F * part(7), 0.9F + 0.04F * part(11), 0.1F * part(23)};
    const double at = i < 60 ? 0.1 + 0.08 * static_cast<double>(part(17)) : 0.5 + 0.03 * (i - 60);
    events.push_back({at, protocol::Bubble{i, 0, 0.004F + 0.012F * part(29), 0.05F, place, 0.0F}});
  }
  std::sort(events.begin(), events.end(),
            [](const EventAt& a, const EventAt& b) { return a.seconds < b.seconds; });
  return make_log(events);
}

void compare(const std::vector<protocol::LogEntry>& log, const synth::EngineSettings& settings,
             const std::vector<std::string>& messages) {
  const Both both = render_both(log, kTiles, kFrames, settings, messages);
  const double peak = loudest(both.synth);
  ASSERT_GT(peak, 0.01);
  const double level = both.apart(peak);
  std::cout << messages.front() << ": " << level << " dB re the peak\n";
  EXPECT_LT(level, kTolerance);
}

void compare(const synth::Sound& sound, const std::vector<std::string>& messages) {
  synth::EngineSettings settings;
  settings.sound = sound;
  compare(some_tones(), settings, messages);
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

TEST(Presets, LowerBubblesAmongOthersAsTheSynthDoes) {
  synth::EngineSettings settings;
  settings.sound = synth::read_sound(kSource / "configs/sounds/calibrated.yaml").sound;
  ASSERT_EQ(settings.sound.cloud.coupling, 1.0);
  compare(some_cloud(), settings, {"splash-preset calibrated"});
  settings.sound.cloud.coupling = 0.5;
  settings.sound.cloud.company = 0.02;
  compare(some_cloud(), settings,
          {"splash-preset calibrated", "splash-set-cloud_coupling 0.5",
           "splash-set-cloud_company 0.02"});
}

/// Near the surface, in the middle, and over the floor.
TEST(Presets, RaiseAndLowerPitchByPlaceAsTheSynthDoes) {
  const auto log = make_log({{0.1, protocol::Bubble{1, 0, 0.01F, 0.05F, {0.7F, 1.1F, 0.29F}, 0.0F}},
                             {0.5, protocol::Bubble{2, 0, 0.01F, 0.05F, {0.7F, 1.1F, 0.15F}, 0.0F}},
                             {0.9, protocol::Bubble{3, 0, 0.02F, 0.05F, {0.7F, 1.1F, 0.01F}, 0.0F}},
                             {1.3, protocol::Cavity{4, 0, 0.06F, 0.1F, {0.7F, 1.1F, 0.2F}, 0.0F}}});
  synth::EngineSettings settings;
  settings.sound.bubble.place = 1.0;
  settings.sound.cavity.place = 0.5;
  settings.water_level = 0.3;
  settings.floor_level = 0.0;
  compare(log, settings,
          {"splash-set-bubble_place 1", "splash-set-cavity_place 0.5", "splash-set-water_level 0.3",
           "splash-set-floor_level 0"});
}

struct Strength {
  const char* sound;
  const RigPair& rig;
  float speed = 0.0F;  ///< into the water [m/s]
};

/// By what is felt, and of a hand that slides a little as it comes down.
TEST(Presets, MakeImpactsAsStrongAsTheSynthDoes) {
  for (const auto& [name, rig, speed] :
       {Strength{"calibrated", kTiles, 1.5F}, Strength{"shore", kStereo, 0.2F}}) {
    std::vector<EventAt> events;
    for (int i = 0; i < 480; ++i) {
      const protocol::Vec3 place{0.305F * (static_cast<float>(i % 6) + 0.5F), 0.9F, 0.0F};
      events.push_back({0.025 * i, protocol::Impact{i, 0, 1.2F * speed, speed, place, 0.0F}});
    }
    constexpr std::int64_t kLong = 620000;
    const std::string preset = name;
    auto sound = synth::read_sound(kSource / "configs/sounds" / (preset + ".yaml")).sound;
    sound.foot.texture = sound.foot.wash = 0.0;
    double synths = 0.0;
    constexpr int kSeeds = 4;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      synth::EngineSettings settings;
      settings.sound = sound;
      settings.seed = static_cast<std::uint64_t>(seed);
      synths += energy(render_with_synth(make_log(events), rig, kLong, settings)) / kSeeds;
    }
    const std::vector<std::string> messages = {
        "splash-preset " + preset, "splash-set-foot_texture 0", "splash-set-foot_wash 0"};
    const double ratio = energy(render_with_pd(make_log(events), rig, kLong, messages)) / synths;
    std::cout << name << ", " << rig.rig << ": " << 10.0 * std::log10(ratio) << " dB\n";
    // Noise 50 Hz wide for 12 s: Pd's mean has a standard deviation of 0.18 dB, theirs of 0.09 dB.
    EXPECT_NEAR(10.0 * std::log10(ratio), 0.0, 0.5);
  }
}

TEST(Presets, ThePatchesAreThoseOfTheRows) {
  for (const auto& [name, text] : synth::pd_sound(kSource / "configs")) {
    EXPECT_EQ(tests::text_of(kSource / "pd-patches" / name), text)
        << "ninja pd-sound && bin/pd-sound configs pd-patches";
  }
}

}  // namespace
}  // namespace splash::pd
