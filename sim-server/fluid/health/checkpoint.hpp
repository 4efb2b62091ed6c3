// SPDX-License-Identifier: MIT
// The last sound state of the water, kept on the device: to keep it and to go back to it costs a
// copy, and nothing waits.
#pragma once

#include <vector>

#include "sim-server/device/device.hpp"

namespace splash::sim {

class Checkpoint {
 public:
  Checkpoint() = default;
  /// `state`: all that the next step depends on. The buffers may be others at each call, of the
  /// same sizes in the same order.
  void keep(Device& device, const std::vector<cl::Buffer>& state);
  void recall(Device& device, const std::vector<cl::Buffer>& state) const;

 private:
  std::vector<cl::Buffer> kept_;
};

}  // namespace splash::sim
