// SPDX-License-Identifier: MIT
// Reads WAV files: PCM of 16, 24 or 32 bits and float of 32 bits, any number of channels.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace splash::synth {

struct WavSignal {
  double sample_rate = 0.0;                  ///< [Hz]
  std::vector<std::vector<float>> channels;  ///< full scale is 1 [1]

  std::size_t frames() const { return channels.empty() ? 0 : channels.front().size(); }
};

/// Throws std::runtime_error naming the file and what is wrong with it.
WavSignal read_wav(const std::filesystem::path& path);

}  // namespace splash::synth
