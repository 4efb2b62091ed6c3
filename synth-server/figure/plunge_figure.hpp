// SPDX-License-Identifier: MIT
// The paper's Figure 3: a plunge's signal in its three components, and its spectrogram under it.
#pragma once

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "synth-server/figure/components.hpp"

namespace splash::synth {

struct FigureSettings {
  std::string title = "Plunge: vibrotactile signal";
  double from = 0.0;                                    ///< first moment drawn [s]
  double to = std::numeric_limits<double>::infinity();  ///< last one, or the signal's end [s]
  double range_db = 60.0;   ///< colours reach this far below the loudest point [dB]
  double lowest = 10.0;     ///< of the spectrogram [Hz]
  double highest = 1000.0;  ///< of the spectrogram [Hz]
};

/// Draws a PNG. Throws GnuplotError, or std::runtime_error when the picture cannot be written.
void draw_plunge(const Components& components, const FigureSettings& settings,
                 const std::filesystem::path& png);

// A long signal as narrow as a picture: the lowest and highest sample of each column.

struct Extent {
  double time = 0.0;  ///< of the column's middle, from the first sample [s]
  float lowest = 0.0F;
  float highest = 0.0F;
};

/// At most `columns` extents of equal width; one per sample when there are fewer samples.
std::vector<Extent> envelope(std::span<const float> signal, double sample_rate,
                             std::size_t columns);

}  // namespace splash::synth
