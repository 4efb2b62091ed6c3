// SPDX-License-Identifier: MIT
// From which sample to which a voice sounds, and how it is faded out when it has to go early.
#pragma once

#include <algorithm>
#include <cstddef>
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

  /// Makes nil of what lies outside, and fades. `samples`: from sample `from` of the clock on,
  /// `stride` apart.
  void shape(std::int64_t from, int count, double* samples, int stride = 1) const noexcept {
    const auto length = static_cast<double>(end - fade);
    for (int i = 0; i < count; ++i) {
      double& sample = samples[static_cast<std::ptrdiff_t>(i) * stride];
      const std::int64_t now = from + i;
      if (now < start || now >= end) {
        sample = 0;
      } else if (now > fade) {
        const double left = 1.0 - static_cast<double>(now - fade) / length;
        sample *= left * left * (3.0 - 2.0 * left);
      }
    }
  }
};

}  // namespace splash::synth
