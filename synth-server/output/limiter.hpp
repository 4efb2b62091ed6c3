// SPDX-License-Identifier: MIT
// A peak limiter without delay: turns down at once, holds for the longest half-wave of the tactile
// band, comes back slowly. Below its limit it does nothing at all. It does not look ahead: the
// first half-wave over the limit is cut flat while it rises. To see that coming at 20 Hz it would
// have to wait a quarter of a period, 12 ms, four times the latency of everything else.
#pragma once

#include <algorithm>
#include <cmath>

namespace splash::synth {

class Limiter {
 public:
  Limiter() = default;
  /// `limit` [full scale], `sample_rate` [Hz].
  Limiter(double limit, double sample_rate) noexcept
      : limit_(limit),
        hold_(static_cast<int>(kHold * sample_rate)),
        release_(std::exp(-1.0 / (kRelease * sample_rate))) {}

  [[nodiscard]] double process(double in) noexcept {
    const double size = std::abs(in);
    if (size >= peak_) {
      peak_ = size;
      held_ = hold_;
    } else if (held_ > 0) {
      --held_;
    } else {
      peak_ *= release_;
    }
    return limiting() ? in * (limit_ / peak_) : in;
  }

  [[nodiscard]] bool limiting() const noexcept { return peak_ > limit_; }
  void reset() noexcept {
    peak_ = 0.0;
    held_ = 0;
  }

 private:
  static constexpr double kHold = 0.025;    ///< half a period of 20 Hz [s]
  static constexpr double kRelease = 0.25;  ///< time constant [s]
  double limit_ = 1.0;
  int hold_ = 0;  ///< samples
  double release_ = 0.0;
  double peak_ = 0.0;
  int held_ = 0;  ///< samples for which the peak still holds
};

}  // namespace splash::synth
