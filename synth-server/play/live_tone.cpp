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

TestTone::TestTone(const Rig& rig, double sample_rate)
    : sample_rate_(sample_rate), fade_(Fade::kSeconds, sample_rate) {
  const std::vector<Tone> tones = tones_of(rig, sample_rate);
  for (const Output& output : rig.outputs) {
    for (int c = 0; c < channel_count(output); ++c) {
      voices_.push_back({tones[voices_.size()], OutputGuard(output, sample_rate, c)});
    }
  }
}

double TestTone::frequency(int channel) const {
  const Tone& tone = voices_[static_cast<std::size_t>(channel)].tone;
  return tone.step * sample_rate_ / (2.0 * std::numbers::pi);
}

double TestTone::next(double gain) noexcept {
  if (playing_ == kNone) return 0.0;
  const Tone& tone = voices_[static_cast<std::size_t>(playing_)].tone;
  phase_ = std::fmod(phase_ + tone.step, 2.0 * std::numbers::pi);
  return gain * tone.amplitude * std::sin(phase_);
}

void TestTone::render(const AudioBlock& block) noexcept {
  for (int i = 0; i < block.frames; ++i) {
    const int chosen = chosen_;
    const double gain = fade_.next(chosen == playing_ && playing_ != kNone);
    if (chosen != playing_ && fade_.closed()) {
      playing_ = chosen;
      phase_ = 0.0;
    }
    const double tone = next(gain);
    constexpr double kOpen = 1.0;
    for (std::size_t c = 0; c < voices_.size(); ++c) {
      const double in = static_cast<int>(c) == playing_ ? tone : 0.0;
      voices_[c].guard.process(&in, &kOpen, block.channels[c] + i, 1);
    }
  }
}

}  // namespace splash::synth
