// SPDX-License-Identifier: MIT
// Reads float WAV files chunk by chunk, knowing nothing of the writer.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace splash::synth {

struct WavContent {
  int format = 0;
  int subformat = 0;  ///< of the extensible format; else 0
  int channels = 0;
  int sample_rate = 0;
  std::uint32_t riff_size = 0;
  std::vector<float> samples;  ///< interleaved
};

inline WavContent read_wav(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    if (at + size > bytes.size()) throw std::runtime_error("WAV: truncated");
    std::memcpy(&value, bytes.data() + at, size);
    return value;
  };
  if (bytes.substr(0, 4) != "RIFF" || bytes.substr(8, 4) != "WAVE") {
    throw std::runtime_error("WAV: no RIFF/WAVE");
  }
  WavContent content;
  content.riff_size = number(4, 4);
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::string id = bytes.substr(at, 4);
    const std::size_t size = number(at + 4, 4);
    if (at + 8 + size > bytes.size()) throw std::runtime_error("WAV: chunk passes the end");
    if (id == "fmt ") {
      content.format = static_cast<int>(number(at + 8, 2));
      content.channels = static_cast<int>(number(at + 10, 2));
      content.sample_rate = static_cast<int>(number(at + 12, 4));
      if (size >= 40) content.subformat = static_cast<int>(number(at + 32, 2));
    }
    if (id == "data") {
      content.samples.resize(size / sizeof(float));
      std::memcpy(content.samples.data(), bytes.data() + at + 8, size);
      break;
    }
    at += 8 + size + size % 2;
  }
  return content;
}

}  // namespace splash::synth
