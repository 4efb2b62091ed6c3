// SPDX-License-Identifier: MIT
// The last thing between the mix and a transducer, one per channel, in this order: finite check
// before any state, DC block and band (the high-pass has its zeros at 0 Hz), equaliser, limiter
// (whose limit a heat budget may lower), slew limit, fade, hard clamp at the ceiling. Whatever
// comes in, what goes out is finite and within it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "synth-server/output/biquad.hpp"
#include "synth-server/output/equaliser.hpp"
#include "synth-server/output/limiter.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// Keeps a transducer from burning. Its coil is taken for a body that one number heats and cools:
/// the mean square h of what it got, forgotten with its thermal time constant. While h is under
/// half of what it bears for ever, nothing happens; from there on the limit of the limiter sinks,
/// from the ceiling down to the RMS value that it bears, which it reaches when h does. No sample is
/// beyond the limit, so h never gets past the budget, whatever comes in: at the budget the limit
/// squared is the budget. A gain computed from the loudness of the input alone could not promise
/// it.
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

class OutputGuard {
 public:
  /// Louder input is cut before the filters: 24 dB over full scale, where only the limiter would
  /// be heard anyway. Else one sample of 1e30 would hold the limiter down for minutes.
  static constexpr double kMostInput = 16.0;
  /// What is louder still is no signal but an error, and treated like NaN: 1024 impacts at 100 m/s
  /// at once, with 60 dB of gain and the default full scale, stay 26 dB under it.
  static constexpr double kNonsense = 1.0e12;

  OutputGuard() = default;
  /// Of channel `channel` of `output`, in the order of channel_names(); `sample_rate` [Hz].
  OutputGuard(const Output& output, double sample_rate, int channel = 0);

  /// `in`: the mix [full scale]; `fade`: its gain, sample by sample; `out`: what the device gets.
  /// `ceilings`: where they are not null and under the output's own, they count [full scale].
  void process(const double* in, const double* fade, float* out, int count,
               const double* ceilings = nullptr) noexcept;

  /// To be called at rest points only (no input for a while): takes vanishing states for nil and
  /// says whether all are, so that silent input gives exactly silent output and can be skipped.
  bool settle() noexcept;

  [[nodiscard]] std::uint64_t resets() const noexcept { return resets_; }    ///< samples
  [[nodiscard]] std::uint64_t limited() const noexcept { return limited_; }  ///< samples

 private:
  void forget() noexcept;

  BandFilter band_;
  Equaliser equaliser_;
  HeatBudget heat_;
  Limiter limiter_;
  double slew_ = 1.0;  ///< largest change per sample [full scale]
  double last_ = 0.0;  ///< of the slew limit
  std::uint64_t resets_ = 0;
  std::uint64_t limited_ = 0;
};

}  // namespace splash::synth
