// SPDX-License-Identifier: MIT
// How strong an impact is made: by a power of its speed, in metres, as the paper has it, or by how
// strongly it is felt. The sensation level of a burst is its loudest third-octave band, averaged
// over the first 125 ms, over the threshold of touch there. It grows evenly with the logarithm of
// the speed,
//   SL(v) = slow_db + (fast_db - slow_db) ln(v / slow) / ln(fast / slow),
// so that equal ratios of speed are equal steps in decibels, which are felt as equal steps (S. S.
// Stevens 1968: sensation is a power of the amplitude; R. T. Verrillo 1970). What amplitude gives
// it follows from the burst's envelope and resonance and from the output's band and threshold.
#pragma once

#include <span>
#include <vector>

#include "synth-server/output/rig.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

/// SL(v) [dB]; `speed` [m/s], positive.
[[nodiscard]] double wanted_level_db(const ImpactSound& sound, double speed) noexcept;

/// Sensation level of an impact on `output` whose amplitude drives it to full scale [dB].
[[nodiscard]] double felt_level_db(const ImpactSound& sound, const Output& output) noexcept;

class ImpactLevel {
 public:
  explicit ImpactLevel(const Rig& rig);

  struct Amplitude {
    double most = 0.0;              ///< on the output where it is largest [m]
    std::span<const double> parts;  ///< of it, on each output [1]; empty: the same on all
  };
  /// Of an impact at `speed` [m/s]; holds until the next call.
  [[nodiscard]] Amplitude at(const ImpactSound& sound, double speed) noexcept;

 private:
  std::vector<Output> outputs_;
  std::vector<double> unit_;   ///< amplitude of level 0 on each output [ln m]
  std::vector<double> parts_;  ///< as above
  ImpactSound known_;          ///< what unit_ was computed for
  bool fresh_ = false;         ///< whether it was
};

}  // namespace splash::synth
