// SPDX-License-Identifier: MIT
#include "tests/pd-patches/float_wav.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace splash::pd {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class Number>
Number at(const std::string& bytes, std::size_t offset) {
  Number number{};
  if (offset + sizeof number > bytes.size()) throw std::runtime_error("WAV file is cut short");
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

Channels split(const std::string& bytes, std::size_t offset, std::size_t size, std::size_t count) {
  const std::size_t frames = size / (sizeof(float) * count);
  Channels channels(count, std::vector<float>(frames));
  for (std::size_t i = 0; i < frames * count; ++i) {
    channels[i % count][i / count] = at<float>(bytes, offset + i * sizeof(float));
  }
  return channels;
}

}  // namespace

FloatWav read_float_wav(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("no WAV file '" + path.string() + "'");
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!bytes.starts_with("RIFF") || bytes.compare(8, 4, "WAVE") != 0) {
    throw std::runtime_error("'" + path.string() + "' is no WAV file");
  }
  FloatWav wav;
  std::size_t count = 0;
  for (std::size_t chunk = 12; chunk + 8 <= bytes.size();) {
    const std::string name = bytes.substr(chunk, 4);
    const std::size_t size = at<std::uint32_t>(bytes, chunk + 4);
    if (name == "fmt ") {
      count = at<std::uint16_t>(bytes, chunk + 10);
      wav.sample_rate = at<std::int32_t>(bytes, chunk + 12);
      if (at<std::uint16_t>(bytes, chunk + 22) != 32) throw std::runtime_error("not 32-bit floats");
    }
    if (name == "data" && count > 0) {
      wav.channels = split(bytes, chunk + 8, size, count);
      return wav;
    }
    chunk += 8 + size + size % 2;
  }
  throw std::runtime_error("'" + path.string() + "' has no samples");
}

}  // namespace splash::pd
