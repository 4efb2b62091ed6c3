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
      gap_(device, any ? 3 * fields.room : 1),
      upper_(device, any ? 3 * fields.room : 1),
      space_(device, any ? fields.room : 1),
      owner_(device, any ? fields.room : 1),
      seen_space_(device, any ? fields.room : 1),
      clear_(device, any ? fields.room : 1),
      filled_(device, any ? fields.room : 1),
      cut_cells_(program, "cut_cells", std::min<std::size_t>(device.profile().group, 16)),
      see_room_(program, "see_room", std::min<std::size_t>(device.profile().group, 16)),
      open_faces_(program, "open_faces", device.profile().group),
      find_clear_(program, "find_clear", std::min<std::size_t>(device.profile().group, 16)),
      fill_beside_solids_(program, "fill_beside_solids", device.profile().group),
      cover_surface_(program, "cover_surface", std::min<std::size_t>(device.profile().group, 16)) {}

void GridSolids::place(Fluid& fluid, const Step& step) {
  if (!any_) return;
  cl::CommandQueue& queue = fluid.device().queue();
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const Boundary& boundary = fluid.boundary();
  cut_cells_.run(queue, fields_.vectors,
                 {{"p", params},
                  {"g", fields_.on_device},
                  {"piston", as_float(step.piston)},
                  {"lower", gap_},
                  {"upper", upper_},
                  {"room", space_},
                  {"owner", owner_}},
                 boundary.outlines(), boundary.bodies_at(step));
  see_room_.run(queue, fields_.vectors,
                {{"g", fields_.on_device},
                 {"lower", gap_},
                 {"upper", upper_},
                 {"room", space_},
                 {"owner", owner_},
                 {"seen", seen_space_}});
  find_clear_.run(queue, fields_.vectors,
                  {{"p", params},
                   {"g", fields_.on_device},
                   {"cell_start", fluid.grid().cell_start()},
                   {"position", fluid.particles().position},
                   {"seen", seen_space_},
                   {"owner", owner_},
                   {"clear", clear_}},
                  boundary.outlines(), boundary.bodies_at(step));
  open_faces_.run(queue, fields_.vectors,
                  {{"p", params}, {"g", fields_.on_device}, {"upper", upper_}, {"gap", gap_}});
  fill_beside_solids_.run(queue, fields_.vectors,
                          {{"g", fields_.on_device},
                           {"gap", gap_},
                           {"room", space_},
                           {"seen", seen_space_},
                           {"clear", clear_},
                           {"fill", fields_.fill},
                           {"filled", filled_}});
  cover_surface_.run(queue, fields_.vectors,
                     {{"p", params},
                      {"g", fields_.on_device},
                      {"piston", as_float(step.piston)},
                      {"owner", owner_},
                      {"fill", filled_},
                      {"gap", gap_},
                      {"free", upper_}},
                     boundary.outlines(), boundary.bodies_at(step));
}

// As coupling.h does it for those that the water moves: - p V K.
std::vector<Press> GridSolids::press(Device& device, std::size_t bodies) const {
  std::vector<Press> all(bodies);
  if (!any_) return all;
  const MacLevel& l = fields_.grid.level[0];
  const auto cells = static_cast<std::size_t>(l.cells);
  const std::vector<float> gap = gap_.read(device, 3 * cells);
  const std::vector<float> pressure = fields_.pressure.read(device, cells);
  const std::vector<int> owner = owner_.read(device, cells);
  const std::array<std::size_t, 3> step = {1, static_cast<std::size_t>(l.row),
                                           static_cast<std::size_t>(l.layer)};
  const Vector3 lower = {static_cast<double>(fields_.grid.x), static_cast<double>(fields_.grid.y),
                         static_cast<double>(fields_.grid.z)};
  const Vector3 edge = {static_cast<double>(fields_.grid.hx), static_cast<double>(fields_.grid.hy),
                        static_cast<double>(fields_.grid.hz)};
  for (std::size_t c = step[2]; c + step[2] < cells; ++c) {
    if (owner[c] < 0 || static_cast<std::size_t>(owner[c]) >= bodies || pressure[c] == 0.0F) {
      continue;
    }
    Press& press = all[static_cast<std::size_t>(owner[c])];
    const std::array<std::size_t, 3> at = {c % step[2] % step[1], c % step[2] / step[1],
                                           c / step[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double area = edge[0] * edge[1] * edge[2] / edge[axis];
      const std::size_t face = axis * cells + c;
      for (const std::size_t side : {0U, 1U}) {
        Vector3 place;
        for (std::size_t k = 0; k < 3; ++k) {
          const double off = k == axis ? static_cast<double>(side) : 0.5;
          place[k] = lower[k] + (static_cast<double>(at[k]) - 1.0 + off) * edge[k];
        }
        Vector3 force = {0.0, 0.0, 0.0};
        force[axis] = (side == 0U ? 1.0 : -1.0) * area * static_cast<double>(pressure[c]) *
                      static_cast<double>(gap[face + side * step[axis]]);
        press.force = press.force + force;
        press.torque = press.torque + cross(place, force);
      }
    }
  }
  return all;
}

}  // namespace splash::sim
