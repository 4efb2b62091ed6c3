// SPDX-License-Identifier: MIT
// Keeps a transducer from burning. Its coil is taken for a body that one number heats and cools:
// the mean square h of what it got, forgotten with its thermal time constant. While h is under half
// of what it bears for ever, nothing happens; from there on the limit of the limiter sinks, from
// the ceiling down to the RMS value that it bears, which it reaches when h does. No sample is
// beyond the limit, so h never gets past the budget, whatever comes in: at the budget the limit
// squared is the budget. A gain computed from the loudness of the input alone could not promise it.
#pragma once

#include <algorithm>

#include "synth-server/output/rig.hpp"

namespace splash::synth {

class HeatBudget {
 public:
  HeatBudget() = default;
  /// `ceiling` [full scale], `sample_rate` [Hz].
  HeatBudget(const Heat& heat, double ceiling, double sample_rate) noexcept
      : ceiling_(ceiling), limit_(ceiling) {
    if (heat.rms <= 0.0 || heat.rms >= ceiling) return;  // none, or the ceiling is stricter
    rms_ = heat.rms;
    forget_ = 1.0 / (heat.seconds * sample_rate);
    begin_ = 0.5 * rms_ * rms_;
    slope_ = (ceiling_ - rms_) / begin_;
  }

  /// The most that the next sample may be [full scale].
  [[nodiscard]] double limit() const noexcept { return limit_; }

  /// `played`: what the transducer got [full scale].
  void note(double played) noexcept {
    if (forget_ <= 0.0) return;
    heat_ += forget_ * (played * played - heat_);
    limit_ = std::clamp(ceiling_ - slope_ * (heat_ - begin_), rms_, ceiling_);
  }

  /// Whether it has cooled down to `limit`, mean square.
  [[nodiscard]] bool at_rest(double limit) const noexcept { return heat_ <= limit; }
  void cool() noexcept { heat_ = 0.0; }

 private:
  double ceiling_ = 1.0;
  double limit_ = 1.0;
  double rms_ = 0.0;
  double forget_ = 0.0;  ///< share of the past that a sample replaces; 0: no budget
  double begin_ = 0.0;   ///< heat from which on the limit sinks [full scale^2]
  double slope_ = 0.0;   ///< how steeply [1 / full scale]
  double heat_ = 0.0;    ///< [full scale^2]
};

}  // namespace splash::synth
