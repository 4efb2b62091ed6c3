// SPDX-License-Identifier: MIT
#include "sim-server/fluid/health/checkpoint.hpp"

namespace splash::sim {
namespace {

std::size_t bytes_of(const cl::Buffer& buffer) {
  return buffer.getInfo<CL_MEM_SIZE>();
}

}  // namespace

void Checkpoint::keep(Device& device, const std::vector<cl::Buffer>& state) {
  for (std::size_t k = 0; k < state.size(); ++k) {
    const std::size_t bytes = bytes_of(state[k]);
    if (k == kept_.size()) kept_.emplace_back(device.context(), CL_MEM_READ_WRITE, bytes);
    device.queue().enqueueCopyBuffer(state[k], kept_[k], 0, 0, bytes);
  }
}

void Checkpoint::recall(Device& device, const std::vector<cl::Buffer>& state) const {
  for (std::size_t k = 0; k < state.size(); ++k) {
    device.queue().enqueueCopyBuffer(kept_[k], state[k], 0, 0, bytes_of(state[k]));
  }
}

}  // namespace splash::sim
