// SPDX-License-Identifier: MIT
// From which sample to which a voice sounds, and how it is faded out when it has to go early.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace splash::synth {

/// Length of every fade-out of a voice [s].
inline constexpr double kVoiceFade = 0.005;

struct VoiceSpan {
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  std::int64_t start = 0;      ///< first sample
  std::int64_t end = 0;        ///< behind the last one
  std::int64_t fade = kNever;  ///< first sample of the fade-out

  void fade_out(std::int64_t sample, std::int64_t length) noexcept {
    fade = std::min(fade, sample);
    end = std::min(end, fade + length);
  }

  /// Makes nil of what lies outside, and fades. `samples`: from sample `from` of the clock on.
  template <class Real>
  void shape(std::int64_t from, int count, Real* samples) const noexcept {
    const auto at = [&](std::int64_t sample) {
      return static_cast<int>(std::clamp<std::int64_t>(sample - from, 0, count));
    };
    std::fill(samples, samples + at(start), Real{0});
    std::fill(samples + at(end), samples + count, Real{0});
    if (fade >= end) return;
    const auto length = static_cast<double>(end - fade);
    for (int i = at(std::max(fade, start)); i < at(end); ++i) {
      const double left = 1.0 - static_cast<double>(from + i - fade) / length;
      samples[i] *= static_cast<Real>(left * left * (3.0 - 2.0 * left));
    }
  }
};

}  // namespace splash::synth
