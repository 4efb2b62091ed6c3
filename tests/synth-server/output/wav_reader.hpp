// SPDX-License-Identifier: MIT
// Reads float WAV files chunk by chunk, knowing nothing of the writer.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/text_of.hpp"

namespace splash::synth {

struct WavContent {
  int format = 0;
  int subformat = 0;  ///< of the extensible format; else 0
  int channels = 0;
  int sample_rate = 0;
  std::uint32_t riff_size = 0;
  bool rf64 = false;
  std::uint64_t big_riff_size = 0;  ///< RF64: as its ds64 chunk has it
  std::uint64_t big_frames = 0;
  std::vector<float> samples;  ///< interleaved
};

inline WavContent read_wav(const std::filesystem::path& path) {
  const std::string bytes = tests::text_of(path);
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    if (at + size > bytes.size()) throw std::runtime_error("WAV: truncated");
    std::memcpy(&value, bytes.data() + at, size);
    return value;
  };
  const auto number64 = [&](std::size_t at) {
    return number(at, 4) | static_cast<std::uint64_t>(number(at + 4, 4)) << 32U;
  };
  WavContent content;
  content.rf64 = bytes.substr(0, 4) == "RF64";
  if ((bytes.substr(0, 4) != "RIFF" && !content.rf64) || bytes.substr(8, 4) != "WAVE") {
    throw std::runtime_error("WAV: no RIFF/WAVE");
  }
  std::uint64_t big_data_size = 0;
  content.riff_size = number(4, 4);
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::string id = bytes.substr(at, 4);
    const bool elsewhere = content.rf64 && id == "data" && number(at + 4, 4) == 0xFFFFFFFFU;
    const std::size_t size = elsewhere ? big_data_size : number(at + 4, 4);
    if (at + 8 + size > bytes.size()) throw std::runtime_error("WAV: chunk passes the end");
    if (id == "ds64") {
      content.big_riff_size = number64(at + 8);
      big_data_size = number64(at + 16);
      content.big_frames = number64(at + 24);
    }
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
