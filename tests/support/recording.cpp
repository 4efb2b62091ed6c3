// SPDX-License-Identifier: MIT
#include "tests/support/recording.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

std::uint32_t number(const std::string& bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int i = size - 1; i >= 0; --i) {
    value = value << 8U | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
  }
  return value;
}

}  // namespace

Recording read_recording(const std::string& path) {
  const std::string bytes = text_of(path);
  const std::size_t format = bytes.find("fmt ");
  const std::size_t data = bytes.find("data");
  if (format == std::string::npos || data == std::string::npos) {
    throw std::runtime_error(path + " is no WAV file");
  }
  Recording recording;
  const std::size_t channels = number(bytes, format + 10, 2);
  recording.sample_rate = static_cast<int>(number(bytes, format + 12, 4));
  const std::size_t frames = (bytes.size() - data - 8) / (sizeof(float) * channels);
  recording.channels.assign(channels, std::vector<float>(frames));
  const char* sample = bytes.data() + data + 8;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::size_t c = 0; c < channels; ++c, sample += sizeof(float)) {
      std::memcpy(&recording.channels[c][frame], sample, sizeof(float));
    }
  }
  return recording;
}

std::int64_t onset(const std::vector<float>& samples, float threshold, std::int64_t from) {
  for (auto i = static_cast<std::size_t>(from); i < samples.size(); ++i) {
    if (std::abs(samples[i]) > threshold) return static_cast<std::int64_t>(i);
  }
  return -1;
}

float peak(const std::vector<float>& samples, std::int64_t from, std::int64_t to) {
  const auto end = to < 0 ? static_cast<std::int64_t>(samples.size()) : to;
  float largest = 0.0F;
  for (std::int64_t i = from; i < end; ++i) {
    largest = std::max(largest, std::abs(samples.at(static_cast<std::size_t>(i))));
  }
  return largest;
}

}  // namespace splash::tests
