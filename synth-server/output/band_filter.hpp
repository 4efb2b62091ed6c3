// SPDX-License-Identifier: MIT
// Keeps a channel within its transducer's band: fourth-order Butterworth high-pass and low-pass,
// 24 dB per octave, -3 dB at both ends. Four biquads in double precision.
#pragma once

#include <array>

#include "synth-server/output/biquad.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

class BandFilter {
 public:
  BandFilter() = default;
  /// A low-pass at or above 0.45 of `sample_rate` [Hz] is left out: nothing would be cut.
  BandFilter(const Band& band, double sample_rate);

  [[nodiscard]] double process(double in) noexcept {
    in = sections_[1].process(sections_[0].process(in));
    return low_pass_ ? sections_[3].process(sections_[2].process(in)) : in;
  }

  void reset() noexcept {
    for (Biquad& section : sections_) section.reset();
  }
  /// Whether no state exceeds `limit`.
  [[nodiscard]] bool at_rest(double limit) const noexcept;

 private:
  std::array<Biquad, 4> sections_{};  ///< two of the high-pass, two of the low-pass
  bool low_pass_ = false;
};

}  // namespace splash::synth
