// SPDX-License-Identifier: MIT
// Every way tried to compute a bubble: how many sound at once on one core, how wrong they are.
#pragma once

#include <string>
#include <vector>

namespace splash::bench {

struct Algorithm {
  std::string name;
  std::string instructions;
  double voices = 0.0;  ///< in real time on one core at 44.1 kHz, mixed to one channel
  double error_db =
      0.0;  ///< largest, of radii from 1 mm to 0.3 m over their lives to -90 dB [re A0]
};

/// Arithmetic's limit: as many voices as the vector unit could turn if it did nothing else.
struct Limit {
  std::string instructions;
  double operations = 0.0;  ///< of whole vectors per second
  double voices = 0.0;      ///< in single precision at 44.1 kHz
};

[[nodiscard]] std::vector<Algorithm> measure_algorithms();
[[nodiscard]] std::vector<Limit> measure_limits();

}  // namespace splash::bench
