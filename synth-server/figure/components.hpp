// SPDX-License-Identifier: MIT
// The three components of a plunge's signal, as one transducer plays them. Paper, Figure 3.
#pragma once

#include <filesystem>
#include <vector>

namespace splash::synth {

/// One channel's signal, component by component; all three have the same length.
struct Components {
  double sample_rate = 0.0;  ///< [Hz]
  double start = 0.0;        ///< time of the first sample [s]
  int channel = 0;           ///< which channel of the files, from 1
  std::vector<float> impact;
  std::vector<float> bubble;
  std::vector<float> cavity;

  double duration() const { return static_cast<double>(impact.size()) / sample_rate; }
  std::vector<float> sum() const;
};

/// Reads one file per component and keeps the channel with the most energy in the sum of the three:
/// on a floor of tiles the tile that was hit. Shorter files are continued by silence.
/// Throws std::runtime_error when the files differ in sample rate or number of channels.
Components read_components(const std::filesystem::path& impact, const std::filesystem::path& bubble,
                           const std::filesystem::path& cavity);

/// The part from `from` to `to` [s]. Throws std::runtime_error when that holds no sample.
Components cut(const Components& whole, double from, double to);

}  // namespace splash::synth
