// SPDX-License-Identifier: MIT
// A peak limiter without delay: turns down at once, by the largest peak within the longest
// half-wave of the output's band, and comes back slowly. Each half-wave of a steady sound of the
// band lies within that window, so its gain stands still and nothing is distorted. Below its limit
// it does nothing at all. It does not look ahead: the first half-wave over the limit is cut flat
// while it rises. To see that coming at 20 Hz it would have to wait a quarter of a period, 12 ms,
// four times the latency of everything else.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace splash::synth {

class Limiter {
 public:
  Limiter() = default;
  /// `lowest`: the band's lower end [Hz]; `sample_rate` [Hz].
  Limiter(double lowest, double sample_rate) noexcept
      : part_(static_cast<int>(std::ceil(0.5 * sample_rate / lowest / kWhole))),
        release_(std::exp(-1.0 / (kRelease * sample_rate))) {}

  /// `limit` [full scale] may change from sample to sample, slowly.
  [[nodiscard]] double process(double in, double limit) noexcept {
    const double size = std::abs(in);
    if (peak_ == 0.0 && size == 0.0) return in;  // the window begins with the sound
    current_ = std::max(current_, size);
    peak_ = std::max({peak_ * release_, current_, before_});
    if (++done_ >= part_) begin_part();
    limiting_ = peak_ > limit;
    return limiting_ ? in * (limit / peak_) : in;
  }

  /// Whether the latest sample was turned down.
  [[nodiscard]] bool limiting() const noexcept { return limiting_; }
  void reset() noexcept {
    peaks_.fill(0.0);
    peak_ = current_ = before_ = 0.0;
    done_ = 0;
    limiting_ = false;
  }

 private:
  /// The window is a half-wave and up to an eighth: its whole parts and the one that is going on.
  static constexpr std::size_t kWhole = 8;
  static constexpr double kRelease = 0.25;  ///< time constant [s]

  void begin_part() noexcept {
    peaks_[oldest_] = current_;
    oldest_ = (oldest_ + 1) % kWhole;
    before_ = *std::max_element(peaks_.begin(), peaks_.end());
    current_ = 0.0;
    done_ = 0;
  }

  int part_ = 1;  ///< samples
  double release_ = 0.0;
  std::array<double, kWhole> peaks_{};  ///< of the whole parts
  std::size_t oldest_ = 0;
  double current_ = 0.0;  ///< peak of the part that is going on
  double before_ = 0.0;   ///< peak of the whole parts
  double peak_ = 0.0;
  int done_ = 0;  ///< samples of the part that is going on
  bool limiting_ = false;
};

}  // namespace splash::synth
