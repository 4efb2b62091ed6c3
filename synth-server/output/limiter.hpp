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
  /// `sample_rate` [Hz]
  explicit Limiter(double sample_rate) noexcept
      : hold_(static_cast<int>(kHold * sample_rate)),
        release_(std::exp(-1.0 / (kRelease * sample_rate))) {}

  /// `limit` [full scale] may change from sample to sample, slowly.
  [[nodiscard]] double process(double in, double limit) noexcept {
    const double size = std::abs(in);
    if (size >= peak_) {
      peak_ = size;
      held_ = hold_;
    } else if (held_ > 0) {
      --held_;
    } else {
      peak_ *= release_;
    }
    limiting_ = peak_ > limit;
    return limiting_ ? in * (limit / peak_) : in;
  }

  /// Whether the latest sample was turned down.
  [[nodiscard]] bool limiting() const noexcept { return limiting_; }
  void reset() noexcept {
    peak_ = 0.0;
    held_ = 0;
    limiting_ = false;
  }

 private:
  static constexpr double kHold = 0.025;    ///< half a period of 20 Hz [s]
  static constexpr double kRelease = 0.25;  ///< time constant [s]
  int hold_ = 0;                            ///< samples
  double release_ = 0.0;
  double peak_ = 0.0;
  int held_ = 0;  ///< samples for which the peak still holds
  bool limiting_ = false;
};

}  // namespace splash::synth
