// SPDX-License-Identifier: MIT
#include "synth-server/play/test_tone.hpp"

#include <cmath>
#include <numbers>

#include "synth-server/play/live_tone.hpp"

namespace splash::synth {

TestTone::TestTone(const Rig& rig, double sample_rate)
    : sample_rate_(sample_rate), fade_(Fade::kSeconds, sample_rate) {
  const std::vector<Tone> tones = tones_of(rig, sample_rate);
  for (const Output& output : rig.outputs) {
    for (int c = 0; c < channel_count(output); ++c) {
      const Tone& tone = tones[voices_.size()];
      voices_.push_back({tone.step, tone.amplitude, OutputGuard(output, sample_rate, c)});
    }
  }
}

double TestTone::frequency(int channel) const {
  return voices_[static_cast<std::size_t>(channel)].step * sample_rate_ / (2.0 * std::numbers::pi);
}

double TestTone::next(double gain) noexcept {
  if (playing_ == kNone) return 0.0;
  const Voice& voice = voices_[static_cast<std::size_t>(playing_)];
  phase_ = std::fmod(phase_ + voice.step, 2.0 * std::numbers::pi);
  return gain * voice.amplitude * std::sin(phase_);
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
