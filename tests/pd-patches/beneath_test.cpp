// SPDX-License-Identifier: MIT
// What is no voice, in Pd as in the synth: fine water and force under a foot are noises of other
// seeds, alike in the energy of their bands.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <utility>

#include "synth-server/output/biquad.hpp"
#include "tests/pd-patches/rendering.hpp"

namespace splash::pd {
namespace {

using Band = std::pair<double, double>;  ///< [Hz]

/// Of all channels between the edges, a fourth-order Butterworth each.
double energy(const Channels& channels, const Band& band) {
  double sum = 0.0;
  for (const auto& channel : channels) {
    std::array filters = {synth::high_pass(band.first, 0.5411961, kRate),
                          synth::high_pass(band.first, 1.3065630, kRate),
                          synth::low_pass(band.second, 0.5411961, kRate),
                          synth::low_pass(band.second, 1.3065630, kRate)};
    for (const float sample : channel) {
      auto out = static_cast<double>(sample);
      for (synth::Biquad& filter : filters) out = filter.process(out);
      sum += out * out;
    }
  }
  return sum;
}

void compare(const std::vector<protocol::LogEntry>& log, const RigPair& rig, std::int64_t frames,
             const synth::Sound& sound, const std::vector<std::string>& messages,
             const std::vector<Band>& bands, double tolerance) {
  const Channels pd = render_with_pd(log, rig, frames, messages);
  const Channels synth = render_with_synth(log, rig, frames, sound);
  synth::Sound without = sound;
  without.fine.amount = without.foot.texture = without.foot.wash = 0.0;
  const Channels bare = render_with_synth(log, rig, frames, without);
  for (const Band& band : bands) {
    const double wanted = energy(synth, band);
    const double ratio = 10.0 * std::log10(energy(pd, band) / wanted);
    std::cout << band.first << " to " << band.second << " Hz: Pd - synth " << ratio << " dB\n";
    EXPECT_NEAR(ratio, 0.0, tolerance) << band.first << " Hz";
    EXPECT_LT(energy(bare, band), 0.1 * wanted) << "what is compared is the noise";
  }
}

TEST(Beneath, FineWaterHasTheSameBands) {
  std::vector<EventAt> events;
  for (int i = 0; i < 300; ++i) {
    const protocol::Vec3 place{0.1F * static_cast<float>(i % 13) - 0.6F, 0.0F, 0.1F};
    const float radius = 0.003F + 0.0001F * static_cast<float>(i % 50);
    events.push_back({0.01 * i, protocol::Bubble{i, 0, radius, 0.03F, place, 0.0F}});
  }
  synth::Sound sound;
  sound.fine.amount = 2.0;
  sound.bubble.excitation = 0.8;
  sound.bubble.damping = 1.5;
  sound.bubble.gain_db = -6.0;
  compare(make_log(events), kStereo, 153600, sound,
          {"splash-set-fine_amount 2", "splash-set-bubble_excitation 0.8",
           "splash-set-bubble_damping 1.5", "splash-set-bubble_gain_db -6"},
          {{3000.0, 5000.0}, {5000.0, 9000.0}, {9000.0, 15000.0}}, 0.3);
}

TEST(Beneath, AFootFeelsTheSameBands) {
  std::vector<EventAt> events;
  for (int i = 0; i < 120; ++i) {
    const protocol::Vec3 place{0.305F * (static_cast<float>(i % 6) + 0.5F),
                               0.305F * (static_cast<float>(i / 6 % 6) + 0.5F), 0.0F};
    protocol::Impact impact{i, 0, 1.2F, 0.4F + 0.01F * static_cast<float>(i), place, 0.0F};
    if (i % 2 == 0) {  // told by the simulator
      impact.momentum = 5.0F;
      impact.rise = 0.01F;
    }
    events.push_back({0.05 * i, impact});
    events.push_back({0.05 * i + 0.02, protocol::Bubble{i, 0, 0.01F, 0.01F, place, 0.0F}});
  }
  synth::Sound sound;
  sound.impact.amplitude = 1e-6;
  sound.impact.gain_db = 3.0;
  sound.bubble.gain_db = -60.0;
  sound.foot.texture = 2e-4;
  sound.foot.wash = 1e-3;
  sound.foot.q = 4.0;
  sound.foot.wash_frequency = 40.0;
  compare(
      make_log(events), kTiles, 320000, sound,
      {"splash-set-impact_amplitude 0.000001", "splash-set-impact_gain_db 3",
       "splash-set-bubble_gain_db -60", "splash-set-foot_texture 0.0002",
       "splash-set-foot_wash 0.001", "splash-set-foot_q 4", "splash-set-foot_wash_frequency 40"},
      {{20.0, 45.0}, {100.0, 145.0}, {150.0, 400.0}}, 0.7);
}

}  // namespace
}  // namespace splash::pd
