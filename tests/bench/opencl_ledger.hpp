// SPDX-License-Identifier: MIT
// Keeps account of what this program asks of OpenCL, by standing in for three of its calls: memory
// that buffers hold, kernels launched, and the time each took on the device. The product's code is
// measured as it is, without a line in it for this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace splash::bench {

/// All launches of a kernel.
struct Launches {
  std::int64_t count = 0;
  double seconds = 0.0;   ///< on the device, from its own clock
  std::size_t least = 0;  ///< work-items of the smallest
};

/// What all buffers of the program hold now [B].
[[nodiscard]] std::size_t buffer_bytes();

/// From now on launches are noted; of queues with profiling alone, with their times.
void begin_ledger();
/// By kernel's name, since begin_ledger. The queue must be finished.
[[nodiscard]] std::map<std::string, Launches> end_ledger();

}  // namespace splash::bench
