// SPDX-License-Identifier: MIT
// Recorded channels and what tests ask of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace splash::tests {

struct Recording {
  int sample_rate = 0;
  std::vector<std::vector<float>> channels;
};

/// Reads a float WAV. Throws std::runtime_error when it is none.
[[nodiscard]] Recording read_recording(const std::string& path);

/// First sample at or after `from` whose magnitude passes `threshold`; -1: none.
[[nodiscard]] std::int64_t onset(const std::vector<float>& samples, float threshold,
                                 std::int64_t from = 0);
/// Largest magnitude in [from, to); `to` -1: the end.
[[nodiscard]] float peak(const std::vector<float>& samples, std::int64_t from = 0,
                         std::int64_t to = -1);

}  // namespace splash::tests
