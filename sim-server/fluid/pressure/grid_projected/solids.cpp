// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"

#include <algorithm>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

GridSolids::GridSolids(Device& device, const cl::Program& program, const MacFields& fields,
                       bool any)
    : fields_(fields),
      any_(any),
      volume_(device, any ? 3 * fields.room : 1),
      upper_(device, any ? 3 * fields.room : 1),
      gap_(device, any ? 3 * fields.room : 1),
      excess_(device, any ? 3 * fields.room : 1),
      depth_(device, any ? fields.room : 1),
      airless_(device, any ? fields.room : 1),
      space_(device, any ? fields.room : 1),
      owner_(device, any ? fields.room : 1),
      seen_space_(device, any ? fields.room : 1),
      clear_(device, any ? fields.room : 1),
      filled_(device, any ? fields.room : 1),
      cut_cells_(program, "cut_cells", std::min<std::size_t>(device.profile().group, 16)),
      see_space_(program, "see_space", std::min<std::size_t>(device.profile().group, 16)),
      fill_beside_solids_(program, "fill_beside_solids", device.profile().group),
      open_areas_(program, "open_areas", std::min<std::size_t>(device.profile().group, 16)) {}

void GridSolids::place(Fluid& fluid, const Step& step) {
  if (!any_) return;
  cl::CommandQueue& queue = fluid.device().queue();
  const Boundary& boundary = fluid.boundary();
  cut_cells_.run(queue, fields_.vectors,
                 {{"piston", as_float(step.piston)},
                  {"lower", gap_},
                  {"upper", upper_},
                  {"room", space_},
                  {"excess", excess_},
                  {"depth", depth_},
                  {"owner", owner_}},
                 boundary.outlines(), boundary.bodies_at(step), fields_.args(fluid));
  see_space_.run(queue, fields_.vectors,
                 {{"cell_start", fluid.grid().cell_start()},
                  {"position", fluid.particles().position},
                  {"lower", gap_},
                  {"upper", upper_},
                  {"room", space_},
                  {"owner", owner_},
                  {"volume", volume_},
                  {"seen", seen_space_},
                  {"clear", clear_}},
                 boundary.outlines(), boundary.bodies_at(step), fields_.args(fluid));
  fill_beside_solids_.run(queue, fields_.vectors,
                          {{"g", fields_.on_device},
                           {"volume", volume_},
                           {"room", space_},
                           {"seen", seen_space_},
                           {"clear", clear_},
                           {"airless", airless_},
                           {"fill", fields_.fill},
                           {"filled", filled_}});
  open_areas_.run(queue, fields_.vectors,
                  {{"piston", as_float(step.piston)},
                   {"owner", owner_},
                   {"fill", filled_},
                   {"volume", volume_},
                   {"gap", gap_},
                   {"depth", depth_},
                   {"room", space_},
                   {"airless", airless_},
                   {"held", upper_},
                   {"excess", excess_}},
                  boundary.outlines(), boundary.bodies_at(step), fields_.args(fluid));
}

}  // namespace splash::sim
