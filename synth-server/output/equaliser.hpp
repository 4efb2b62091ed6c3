// SPDX-License-Identifier: MIT
// Evens out one channel's transducer: the sections its rig lists, and the inverse of its measured
// response. Every section is stable and the whole never louder than the rig allows.
#pragma once

#include <vector>

#include "synth-server/output/biquad.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

class Equaliser {
 public:
  Equaliser() = default;
  /// Of channel `channel` of `output`, in the order of channel_names(). Sections at or above 0.45
  /// of `sample_rate` [Hz] are left out.
  Equaliser(const Output& output, int channel, double sample_rate);

  [[nodiscard]] double process(double in) noexcept {
    in *= gain_;
    for (Biquad& section : sections_) in = section.process(in);
    return in;
  }

  void reset() noexcept;
  /// Whether no state exceeds `limit`.
  [[nodiscard]] bool at_rest(double limit) const noexcept;
  /// Its gain at `frequency` [Hz], in dB.
  [[nodiscard]] double gain_db(double frequency, double sample_rate) const;

 private:
  double gain_ = 1.0;
  std::vector<Biquad> sections_;
};

/// The cascade whose gain is -level_db at the response's frequencies, held within -most_cut_db and
/// `most_boost_db`: shelves at the ends, peaks between them, their gains found by iterating on what
/// neighbours add to each other (J. S. Abel, D. P. Berners 2004, "Filter design using second-order
/// peaking and shelving sections", solve this as a linear system).
[[nodiscard]] std::vector<Biquad> inverse_of(const MeasuredResponse& response, double most_boost_db,
                                             double sample_rate);

}  // namespace splash::synth
