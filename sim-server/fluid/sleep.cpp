// SPDX-License-Identifier: MIT
#include "sim-server/fluid/sleep.hpp"

#include <algorithm>
#include <vector>

namespace splash::sim {

Sleep::Sleep(Device& device, const cl::Program& program, const FluidParams& params)
    : rows_(static_cast<std::size_t>(params.cells_y) * static_cast<std::size_t>(params.cells_z)),
      awake_(device, rows_ * (static_cast<std::size_t>(params.cells_x) + 1)),
      keep_awake_(program, "keep_awake", 4) {
  wake(device);
}

void Sleep::wake(Device& device) {
  awake_.write(device, std::vector<int>(awake_.size(), std::max(rule_.frames, 1) + 1));
}

void Sleep::update(cl::CommandQueue& queue, const FluidParams& params,
                   const Buffer<FluidParams>& params_buffer, const NeighbourGrid& grid,
                   const Buffer<float>& velocity, const Buffer<BodyStep>& bodies, int body_count,
                   bool piston_moves, double piston) {
  const double wall = static_cast<double>(params.walls[1].offset) + piston;
  const double cell =
      (wall - static_cast<double>(params.origin_x)) * static_cast<double>(params.inverse_cell);
  const int piston_reach = piston_moves ? static_cast<int>(cell) + 2 : 0;
  keep_awake_.run(queue, rows_, params_buffer.memory(), grid.cell_start(), velocity.memory(),
                  bodies.memory(), body_count, piston_reach, static_cast<float>(rule_.speed),
                  rule_.frames, awake_.memory());
}

}  // namespace splash::sim
