// SPDX-License-Identifier: MIT
#include "sim-server/fluid/sleep/sleep.hpp"

#include <algorithm>
#include <vector>

#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {
namespace {

/// Of a team that shares a row of cells, or of items that have one each.
std::size_t group_of(const Profile& profile) {
  return profile.team > 1 ? profile.team : profile.group;
}

}  // namespace

Sleep::Sleep(Device& device, const cl::Program& program, const FluidParams& params)
    : rows_(static_cast<std::size_t>(params.cells_y) * static_cast<std::size_t>(params.cells_z)),
      awake_(device, rows_ * (static_cast<std::size_t>(params.cells_x) + 1)),
      activity_(device, 2 * rows_ * static_cast<std::size_t>(params.cells_x)),
      resting_(device, device.vectors_of(params.count)),
      by_teams_(device.profile().team > 1),
      keep_awake_(program, "keep_awake", group_of(device.profile())),
      spread_activity_(program, "spread_activity", group_of(device.profile())) {
  wake(device);
}

void Sleep::wake(Device& device) {
  awake_.write(device, std::vector<int>(awake_.size(), std::max(rule_.frames, 1) + 1));
  activity_.write(device, std::vector<int>(activity_.size(), SPLASH_ACTIVITY_MOTION));
  resting_.write(device, std::vector<int>(resting_.size(), 0));
}

void Sleep::update(cl::CommandQueue& queue, const FluidParams& params,
                   const Buffer<FluidParams>& params_buffer, const NeighbourGrid& grid,
                   const Buffer<float>& velocity, const Buffer<BodyStep>& bodies, int body_count,
                   bool piston_moves, double piston) {
  const double wall = static_cast<double>(params.walls[1].offset) + piston;
  const double cell =
      (wall - static_cast<double>(params.origin_x)) * static_cast<double>(params.inverse_cell);
  const int piston_reach = piston_moves ? static_cast<int>(cell) + 2 : 0;
  over_rows(keep_awake_, queue,
            {{"p", params_buffer},
             {"cell_start", grid.cell_start()},
             {"velocity", velocity},
             {"bodies", bodies},
             {"body_count", body_count},
             {"piston_reach", piston_reach},
             {"speed", static_cast<float>(rule_.speed)},
             {"hold", rule_.frames},
             {"awake", awake_},
             {"activity", activity_}});
  over_rows(spread_activity_, queue,
            {{"p", params_buffer}, {"awake", awake_}, {"activity", activity_}});
}

}  // namespace splash::sim
