// SPDX-License-Identifier: MIT
// Which of many bubbles sound one by one. The number of births a second is averaged over a tenth of
// a second; once it is more than a tenth over the limit, as many of them as the limit says remain
// single, evenly chosen among all.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace splash::synth {

class BirthRate {
 public:
  /// `sample_rate` [Hz]
  explicit BirthRate(double sample_rate) noexcept : span_(kSpan * sample_rate) {}

  /// Whether the bubble that is born at `sample`, not before the last one, is one of `most` [1/s].
  [[nodiscard]] bool is_single(double most, std::int64_t sample) noexcept {
    rate_ = rate_ * std::exp(static_cast<double>(last_ - sample) / span_) + 1.0 / kSpan;
    last_ = sample;
    due_ += rate_ > kMargin * most ? most / rate_ : 1.0;
    if (due_ < 1.0) return false;
    due_ -= 1.0;
    return true;
  }

 private:
  static constexpr double kSpan = 0.1;    ///< the number is averaged over this [s]
  static constexpr double kMargin = 1.1;  ///< chance alone gives 1.02 of 10,000 a second [1]

  double span_;        ///< samples
  double rate_ = 0.0;  ///< births a second
  std::int64_t last_ = 0;
  double due_ = 0.0;  ///< the part of a single one that is due
};

}  // namespace splash::synth
