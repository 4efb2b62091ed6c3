// SPDX-License-Identifier: MIT
// Short-time Fourier transform of a signal, read off at logarithmically spaced frequencies.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace splash::synth {

struct SpectrogramSettings {
  double window = 0.12;     ///< length of the Hann window [s]: tells lines 17 Hz apart
  double lowest = 10.0;     ///< frequency of the first row [Hz]
  double highest = 1000.0;  ///< frequency of the last row [Hz]
  double from = 0.0;        ///< the columns share what lies between here [s]
  double to = std::numeric_limits<double>::infinity();  ///< and here, or the signal's end [s]
  std::size_t rows = 480;
  std::size_t columns = 1200;
  double floor_db = -200.0;  ///< what silence reads [dB]
};

struct Spectrogram {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> frequency;  ///< of each row [Hz]
  std::vector<double> time;       ///< of each column's middle, from the first sample [s]
  std::vector<float> level_db;    ///< row after row; a sine of amplitude 1 reads 0 [dB]

  float at(std::size_t row, std::size_t column) const { return level_db[row * columns + column]; }
};

/// The signal is continued by silence at both ends. Throws std::invalid_argument when the settings
/// make no sense: fewer than two rows, a highest frequency below the lowest or above the half of
/// the sample rate, an end before the start.
Spectrogram spectrogram(std::span<const float> signal, double sample_rate,
                        const SpectrogramSettings& settings);

}  // namespace splash::synth
