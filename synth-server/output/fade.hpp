// SPDX-License-Identifier: MIT
// The gain that opens and closes a rig without clicks: slowly at the start, in 20 ms afterwards.
#pragma once

#include <algorithm>

namespace splash::synth {

class Fade {
 public:
  static constexpr double kSeconds = 0.020;  ///< of every fade but the first one in [s]

  Fade() = default;
  /// Begins at nil and rises during `start` [s]; 0: open from the first sample on.
  Fade(double start, double sample_rate) noexcept
      : level_(start > 0.0 ? 0.0 : 1.0),
        up_(start > 0.0 ? 1.0 / (start * sample_rate) : 1.0),
        step_(1.0 / (kSeconds * sample_rate)) {}

  /// The next sample's gain, moving towards 1 or 0 with a smooth beginning and end.
  [[nodiscard]] double next(bool open) noexcept {
    const double gain = level_ * level_ * (3.0 - 2.0 * level_);
    level_ = open ? std::min(1.0, level_ + up_) : std::max(0.0, level_ - step_);
    if (level_ >= 1.0) up_ = step_;
    return gain;
  }

  [[nodiscard]] bool closed() const noexcept { return level_ <= 0.0; }
  [[nodiscard]] bool opened() const noexcept { return level_ >= 1.0; }

 private:
  double level_ = 1.0;  ///< [0, 1]
  double up_ = 1.0;     ///< per sample
  double step_ = 1.0;   ///< per sample
};

}  // namespace splash::synth
