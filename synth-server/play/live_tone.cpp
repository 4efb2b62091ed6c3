// SPDX-License-Identifier: MIT
#include "synth-server/play/live_tone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace splash::synth {
namespace {

constexpr double kLevel = 0.1;    ///< of the channel's ceiling [1]
constexpr double kHighest = 0.4;  ///< of the sample rate, for bands that reach higher [1]
constexpr double kSeconds = 1.0;

}  // namespace

std::vector<Tone> tones_of(const Rig& rig, double sample_rate) {
  std::vector<Tone> tones;
  for (const Output& output : rig.outputs) {
    const double high = std::min(output.band.high, kHighest * sample_rate);
    const double middle = std::sqrt(output.band.low * high);
    const Tone tone{2.0 * std::numbers::pi * middle / sample_rate, kLevel * output.ceiling};
    tones.insert(tones.end(), static_cast<std::size_t>(channel_count(output)), tone);
  }
  return tones;
}

LiveTone::LiveTone(std::vector<Tone> tones, double sample_rate)
    : tones_(std::move(tones)),
      second_(static_cast<int>(kSeconds * sample_rate)),
      fade_(Fade::kSeconds, sample_rate) {}

void LiveTone::process(float* const* channels, int frames) noexcept {
  for (int i = 0; i < frames; ++i) {
    if (playing_ == kNone && chosen_ == kNone) return;
    if (playing_ != kNone && playing_ == chosen_ && --left_ < 0) chosen_ = kNone;
    const double gain = fade_.next(playing_ != kNone && playing_ == chosen_);
    if (playing_ != kNone) {
      const auto c = static_cast<std::size_t>(playing_);
      phase_ = std::fmod(phase_ + tones_[c].step, 2.0 * std::numbers::pi);
      const double water = static_cast<double>(channels[c][i]);
      const double tone = share_ * tones_[c].amplitude * std::sin(phase_);
      channels[c][i] = static_cast<float>(water + gain * (tone - water));
    }
    if (playing_ != chosen_ && fade_.closed()) {
      playing_ = chosen_ < static_cast<int>(tones_.size()) ? chosen_ : kNone;
      chosen_ = playing_;
      share_ = chosen_share_;
      left_ = second_;
      phase_ = 0.0;
    }
  }
}

}  // namespace splash::synth
