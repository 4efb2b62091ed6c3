// SPDX-License-Identifier: MIT
// Reads the WAV files that Pd's soundfiler writes with -bytes 4: 32-bit float, any channels.
#pragma once

#include <filesystem>
#include <vector>

namespace splash::pd {

/// Planar samples, one vector per channel.
using Channels = std::vector<std::vector<float>>;

struct FloatWav {
  int sample_rate = 0;  ///< [Hz]
  Channels channels;
};

/// Throws std::runtime_error when the file is missing or no such WAV.
[[nodiscard]] FloatWav read_float_wav(const std::filesystem::path& path);

}  // namespace splash::pd
