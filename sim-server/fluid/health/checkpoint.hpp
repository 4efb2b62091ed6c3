// SPDX-License-Identifier: MIT
// Keeps the last good state of the water on the device. Keeping and recalling it each cost a copy
// on the device and do not wait.
#pragma once

#include <vector>

#include "sim-server/device/device.hpp"

namespace splash::sim {

class Checkpoint {
 public:
  Checkpoint() = default;
  /// `state`: all buffers that the next step depends on. They may be other buffers at each call, of
  /// the same sizes in the same order.
  void keep(Device& device, const std::vector<cl::Buffer>& state);
  void recall(Device& device, const std::vector<cl::Buffer>& state) const;

 private:
  std::vector<cl::Buffer> kept_;
};

}  // namespace splash::sim
