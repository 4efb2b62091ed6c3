// SPDX-License-Identifier: MIT
// A log's events over time, and how loud each channel was meanwhile: on a floor of tiles, which
// tile when.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "synth-server/figure/wav_reader.hpp"

namespace splash::synth {

/// Root mean square of each channel in each column of a picture [full scale, dB]: rows of columns,
/// the first channel first.
struct LevelMap {
  std::size_t columns = 0;
  std::size_t channels = 0;
  std::vector<float> level_db;
};
inline constexpr float kLowestLevel = -120.0F;  ///< silence [dB]

[[nodiscard]] LevelMap level_map(const WavSignal& signal, std::size_t columns);

struct EventFigure {
  std::filesystem::path events;  ///< a log
  std::filesystem::path levels;  ///< WAV of what was rendered of it
  std::string title;
  double range_db = 60.0;  ///< of the colours
};

/// Draws it as PNG. Throws std::runtime_error naming the file that is wrong, GnuplotError.
void draw_events(const EventFigure& figure, const std::filesystem::path& png);

}  // namespace splash::synth
