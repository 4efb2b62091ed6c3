// SPDX-License-Identifier: MIT
// Keeps a channel within its transducer's band: fourth-order Butterworth high-pass and low-pass,
// 24 dB per octave, -3 dB at both ends. Four biquads in double precision.
#pragma once

#include <array>

#include "synth-server/output/rig.hpp"

namespace splash::synth {

class BandFilter {
 public:
  BandFilter() = default;
  /// A low-pass at or above 0.45 of `sample_rate` [Hz] is left out: nothing would be cut.
  BandFilter(const Band& band, double sample_rate);

  [[nodiscard]] double process(double in) noexcept {
    for (Section& s : sections_) {
      const double out = s.b0 * in + s.first;
      s.first = s.b1 * in - s.a1 * out + s.second;
      s.second = s.b2 * in - s.a2 * out;
      in = out;
    }
    return in;
  }

  void reset() noexcept;
  /// Whether no state exceeds `limit`.
  [[nodiscard]] bool at_rest(double limit) const noexcept;

 private:
  struct Section {
    double b0 = 1.0;
    double b1 = 0.0;
    double b2 = 0.0;
    double a1 = 0.0;
    double a2 = 0.0;
    double first = 0.0;   ///< state
    double second = 0.0;  ///< state
  };
  static Section high_pass(double frequency, double q, double sample_rate);
  static Section low_pass(double frequency, double q, double sample_rate);

  std::array<Section, 4> sections_{};
};

}  // namespace splash::synth
