// SPDX-License-Identifier: MIT
// The last thing between the mix and a transducer, one per channel, in this order: finite check
// before any state, DC block and band (the high-pass has its zeros at 0 Hz), equaliser, limiter
// (whose limit a heat budget may lower), slew limit, fade, hard clamp at the ceiling. Whatever
// comes in, what goes out is finite and within it.
#pragma once

#include <cstdint>

#include "synth-server/output/band_filter.hpp"
#include "synth-server/output/equaliser.hpp"
#include "synth-server/output/heat_budget.hpp"
#include "synth-server/output/limiter.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

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
