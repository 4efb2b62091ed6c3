// SPDX-License-Identifier: MIT
// Keeps account of what this program asks of OpenCL, by standing in for some of its calls: memory
// that buffers hold, kernels launched, the time each took on the device, and other commands. The
// product's code is measured as it is, without a line in it for this.
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

/// Commands that are no kernels.
struct Commands {
  std::int64_t writes = 0;
  std::int64_t fills = 0;
  std::int64_t copies = 0;
  std::int64_t reads = 0;
  std::int64_t late_kernels = 0;  ///< launched after the first read

  [[nodiscard]] std::int64_t all() const noexcept { return writes + fills + copies + reads; }
  friend bool operator==(const Commands&, const Commands&) = default;
};

/// What all buffers of the program hold now [B].
[[nodiscard]] std::size_t buffer_bytes();

/// From now on launches are noted; of queues with profiling alone, with their times.
void begin_ledger();
/// Since begin_ledger.
[[nodiscard]] Commands noted_commands();
/// By kernel's name, since begin_ledger. The queue must be finished.
[[nodiscard]] std::map<std::string, Launches> end_ledger();

}  // namespace splash::bench
