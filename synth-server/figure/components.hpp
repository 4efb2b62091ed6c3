// SPDX-License-Identifier: MIT
// The three components of a plunge's signal, as one transducer plays them, and what was played of
// them. Paper, Figure 3.
#pragma once

#include <filesystem>
#include <vector>

namespace splash::synth {

/// One channel's signal, component by component; all have the same length.
struct Components {
  double sample_rate = 0.0;  ///< [Hz]
  double start = 0.0;        ///< time of the first sample [s]
  int channel = 0;           ///< which channel of the files, from 1
  std::vector<float> impact;
  std::vector<float> bubble;
  std::vector<float> cavity;
  std::vector<float> played = {};  ///< what the transducer got; empty: not known

  double duration() const { return static_cast<double>(impact.size()) / sample_rate; }
  /// What was played, or else the sum of the components.
  std::vector<float> signal() const;
};

struct ComponentFiles {
  std::filesystem::path impact;
  std::filesystem::path bubble;
  std::filesystem::path cavity;
  std::filesystem::path played;  ///< what was played; empty: not known
};

/// Reads the files and keeps the channel with the most energy in the signal: on a floor of tiles
/// the tile that was hit. The signal that was played says how long all of it lasts, else the
/// longest component; what is shorter is continued by silence. Throws std::runtime_error when the
/// files differ in sample rate or number of channels.
Components read_components(const ComponentFiles& files);

/// The part from `from` to `to` [s]. Throws std::runtime_error when that holds no sample.
Components cut(const Components& whole, double from, double to);

}  // namespace splash::synth
