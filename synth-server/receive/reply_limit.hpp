// SPDX-License-Identifier: MIT
// At most so many replies a second to one host: a forged sender address cannot make us flood it.
#pragma once

#include <cstdint>
#include <vector>

namespace splash::synth {

class ReplyLimit {
 public:
  /// As many at once as in a second, after a rest [1/s].
  explicit ReplyLimit(double per_second = 10.0) noexcept : per_second_(per_second) {}

  /// Whether `address` (IPv4) may get one more reply at `now` [s, monotonic].
  [[nodiscard]] bool allow(std::uint32_t address, double now);

 private:
  struct Host {
    std::uint32_t address = 0;
    double tokens = 0.0;  ///< replies it may get at once
    double time = 0.0;    ///< when they were counted [s, monotonic]
  };
  double per_second_;
  std::vector<Host> hosts_;
};

}  // namespace splash::synth
