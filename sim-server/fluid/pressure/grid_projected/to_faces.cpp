// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/to_faces.hpp"

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {
namespace {

/// Work-items that scatter, the same on every CPU, so that sums are found in the same order. More
/// would have too many grids to add up.
constexpr std::size_t kItems = 4;

/// Numbers in the grid of an item (scatter.cl).
std::size_t numbers_in(const MacLevel& level) {
  return 8 * (static_cast<std::size_t>(level.cells) + 2 * static_cast<std::size_t>(level.layer));
}

}  // namespace

ToFaces::ToFaces(Device& device, const cl::Program& program, const MacFields& fields)
    : fields_(fields),
      items_(device.profile().sort_chunks > 0 ? kItems : 0),
      grids_(device, items_ * numbers_in(fields.grid.level[0])),
      layers_(device, 2 * items_),
      gather_(program, "gather_faces"),
      scatter_(program, "scatter_to_faces", 1),
      add_up_(program, "add_up_faces", device.profile().group) {}

void ToFaces::find(Fluid& fluid, const Buffer<float>& value, const Buffer<float>& mean) {
  cl::CommandQueue& queue = fluid.device().queue();
  if (items_ == 0) {
    gather_.run(queue, fields_.cells,
                {{"cell_start", fluid.grid().cell_start()},
                 {"position", fluid.particles().position},
                 {"value", value},
                 {"mean", mean},
                 {"weight", fields_.weight},
                 {"fill", fields_.fill}},
                fields_.args(fluid));
    return;
  }
  scatter_.run(queue, items_,
               {{"items", static_cast<int>(items_)},
                {"position", fluid.particles().position},
                {"value", value},
                {"grids", grids_},
                {"layers", layers_}},
               fields_.args(fluid));
  add_up_.run(queue, fields_.vectors,
              {{"g", fields_.on_device},
               {"items", static_cast<int>(items_)},
               {"grids", grids_},
               {"layers", layers_},
               {"mean", mean},
               {"weight", fields_.weight},
               {"fill", fields_.fill}});
}

}  // namespace splash::sim
