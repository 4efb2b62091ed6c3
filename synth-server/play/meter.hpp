// SPDX-License-Identifier: MIT
// What each channel last sent to the device: peaks of the last quarter to half second, written by
// the audio thread and read by any other.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

namespace splash::synth {

class Meter {
 public:
  /// `sample_rate` [Hz].
  Meter(int channels, double sample_rate)
      : peaks_(static_cast<std::size_t>(channels)), span_(static_cast<int>(kSpan * sample_rate)) {}

  /// From the audio thread.
  void note(const float* const* channels, int frames) noexcept {
    if (noted_ >= span_) begin();
    noted_ += frames;
    for (std::size_t c = 0; c < peaks_.size(); ++c) {
      float peak = peaks_[c].now.load(std::memory_order_relaxed);
      for (int i = 0; i < frames; ++i) peak = std::max(peak, std::abs(channels[c][i]));
      peaks_[c].now.store(peak, std::memory_order_relaxed);
    }
  }

  /// Peak of a channel [full scale].
  [[nodiscard]] float level(std::size_t channel) const noexcept {
    const Peak& peak = peaks_[channel];
    return std::max(peak.now.load(std::memory_order_relaxed),
                    peak.before.load(std::memory_order_relaxed));
  }
  [[nodiscard]] std::size_t channels() const noexcept { return peaks_.size(); }

  struct Loudest {
    std::size_t channel = 0;
    float level = 0.0F;  ///< [full scale]
  };
  [[nodiscard]] Loudest loudest() const noexcept {
    Loudest loudest;
    for (std::size_t c = 0; c < peaks_.size(); ++c) {
      if (level(c) > loudest.level) loudest = {c, level(c)};
    }
    return loudest;
  }

 private:
  static constexpr double kSpan = 0.25;  ///< [s]
  struct Peak {
    std::atomic<float> now{0.0F};     ///< in this span
    std::atomic<float> before{0.0F};  ///< in the one before
  };
  void begin() noexcept {
    noted_ = 0;
    for (Peak& peak : peaks_) {
      peak.before.store(peak.now.load(std::memory_order_relaxed), std::memory_order_relaxed);
      peak.now.store(0.0F, std::memory_order_relaxed);
    }
  }

  std::vector<Peak> peaks_;
  int span_;       ///< samples
  int noted_ = 0;  ///< of this span
};

}  // namespace splash::synth
