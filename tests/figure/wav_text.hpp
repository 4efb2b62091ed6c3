// SPDX-License-Identifier: MIT
// WAV files byte by byte, written independently of the reader that the tests look at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace splash::synth::testing {

/// A chunk of a RIFF file: tag, size, content, padded to an even length.
std::string chunk(const std::string& tag, const std::string& content);

std::string little_endian(std::uint32_t value, int bytes);

/// The fmt chunk's content for PCM (code 1) or float (code 3).
std::string format(int code, int channels, int sample_rate, int bits);

std::string riff(const std::string& chunks);

/// Interleaved float samples as bytes.
std::string floats(const std::vector<float>& samples);

/// A whole float file, of interleaved samples.
std::string float_file(int channels, int sample_rate, const std::vector<float>& samples);

}  // namespace splash::synth::testing
