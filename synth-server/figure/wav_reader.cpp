// SPDX-License-Identifier: MIT
#include "synth-server/figure/wav_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace splash::synth {
namespace {

using Bytes = std::span<const unsigned char>;

constexpr std::uint32_t kPcm = 1;
constexpr std::uint32_t kFloat = 3;
constexpr std::uint32_t kExtensible = 0xFFFE;  // the true format stands in the sub-format

struct Format {
  std::uint32_t code = 0;
  std::uint32_t channels = 0;
  std::uint32_t sample_rate = 0;  ///< [Hz]
  std::uint32_t bits = 0;         ///< of one sample
};

/// WAV files are little-endian.
std::uint32_t read_unsigned(Bytes bytes, std::size_t at, std::size_t width) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < width; ++i) {
    value |= static_cast<std::uint32_t>(bytes[at + i]) << (8 * i);
  }
  return value;
}

bool has_tag(Bytes bytes, std::size_t at, std::string_view tag) {
  return std::equal(tag.begin(), tag.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

std::vector<unsigned char> read_all(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path.string() + ": cannot be opened for reading");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

Format read_format(Bytes chunk) {
  if (chunk.size() < 16) throw std::runtime_error("its fmt chunk is shorter than 16 bytes");
  Format format{read_unsigned(chunk, 0, 2), read_unsigned(chunk, 2, 2), read_unsigned(chunk, 4, 4),
                read_unsigned(chunk, 14, 2)};
  if (format.code == kExtensible && chunk.size() >= 26) format.code = read_unsigned(chunk, 24, 2);
  const bool pcm =
      format.code == kPcm && (format.bits == 16 || format.bits == 24 || format.bits == 32);
  const bool floating = format.code == kFloat && format.bits == 32;
  if (!pcm && !floating) {
    throw std::runtime_error("format " + std::to_string(format.code) + " with " +
                             std::to_string(format.bits) +
                             " bits is not read: use PCM of 16, 24 or 32 bits or float of 32");
  }
  if (format.channels == 0 || format.sample_rate == 0) {
    throw std::runtime_error("it has no channels or no sample rate");
  }
  return format;
}

float read_sample(Bytes data, std::size_t at, const Format& format) {
  const std::uint32_t raw = read_unsigned(data, at, format.bits / 8);
  if (format.code == kFloat) return std::bit_cast<float>(raw);
  const auto shifted = static_cast<std::int32_t>(raw << (32U - format.bits));
  return static_cast<float>(static_cast<double>(shifted) / 2147483648.0);
}

WavSignal read_samples(Bytes data, const Format& format) {
  const std::size_t width = format.bits / 8;
  const std::size_t frames = data.size() / (width * format.channels);
  WavSignal signal;
  signal.sample_rate = format.sample_rate;
  signal.channels.assign(format.channels, std::vector<float>(frames));
  for (std::size_t i = 0; i < frames; ++i) {
    for (std::size_t c = 0; c < format.channels; ++c) {
      signal.channels[c][i] = read_sample(data, (i * format.channels + c) * width, format);
    }
  }
  return signal;
}

WavSignal parse(Bytes bytes) {
  const bool riff = bytes.size() >= 12 && (has_tag(bytes, 0, "RIFF") || has_tag(bytes, 0, "RF64"));
  if (!riff || !has_tag(bytes, 8, "WAVE")) {
    throw std::runtime_error("it does not begin like a WAV file (RIFF ... WAVE)");
  }
  Format format;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    // A recorder that was killed leaves a size of 0 or too large a one: take what is there.
    const std::size_t rest = bytes.size() - at - 8;
    const std::size_t size = std::min<std::size_t>(read_unsigned(bytes, at + 4, 4), rest);
    const Bytes chunk = bytes.subspan(at + 8, size);
    if (has_tag(bytes, at, "fmt ")) format = read_format(chunk);
    if (has_tag(bytes, at, "data")) {
      if (format.channels == 0) throw std::runtime_error("its samples come before their format");
      return read_samples(chunk, format);
    }
    at += 8 + size + size % 2;
  }
  throw std::runtime_error("it has no data chunk");
}

}  // namespace

WavSignal read_wav(const std::filesystem::path& path) {
  const std::vector<unsigned char> bytes = read_all(path);
  try {
    return parse(bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace splash::synth
