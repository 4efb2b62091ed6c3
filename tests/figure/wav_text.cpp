// SPDX-License-Identifier: MIT
#include "tests/figure/wav_text.hpp"

#include <bit>

namespace splash::synth::testing {

std::string little_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xFFU);
  return text;
}

std::string chunk(const std::string& tag, const std::string& content) {
  std::string text = tag + little_endian(static_cast<std::uint32_t>(content.size()), 4) + content;
  if (content.size() % 2 == 1) text += '\0';
  return text;
}

std::string format(int code, int channels, int sample_rate, int bits) {
  const auto number = [](int value, int bytes) {
    return little_endian(static_cast<std::uint32_t>(value), bytes);
  };
  const int frame = channels * bits / 8;
  return number(code, 2) + number(channels, 2) + number(sample_rate, 4) +
         number(sample_rate * frame, 4) + number(frame, 2) + number(bits, 2);
}

std::string riff(const std::string& chunks) {
  return "RIFF" + little_endian(static_cast<std::uint32_t>(chunks.size() + 4), 4) + "WAVE" + chunks;
}

std::string floats(const std::vector<float>& samples) {
  std::string text;
  for (const float sample : samples) text += little_endian(std::bit_cast<std::uint32_t>(sample), 4);
  return text;
}

std::string float_file(int channels, int sample_rate, const std::vector<float>& samples) {
  return riff(chunk("fmt ", format(3, channels, sample_rate, 32)) + chunk("data", floats(samples)));
}

}  // namespace splash::synth::testing
