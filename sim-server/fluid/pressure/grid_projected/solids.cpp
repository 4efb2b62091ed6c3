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
      gains_(device, any ? 3 * fields.room : 1),
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
      open_areas_(program, "open_areas", std::min<std::size_t>(device.profile().group, 16)) {}

void GridSolids::place(Fluid& fluid, const Step& step) {
  if (!any_) return;
  cl::CommandQueue& queue = fluid.device().queue();
  const Boundary& boundary = fluid.boundary();
  cut_cells_.run(queue, fields_.vectors,
                 {{"piston", as_float(step.piston)},
                  {"lower", volume_},
                  {"upper", upper_},
                  {"room", space_},
                  {"owner", owner_}},
                 boundary.outlines(), boundary.bodies_at(step), fields_.args(fluid));
  see_room_.run(queue, fields_.vectors,
                {{"g", fields_.on_device},
                 {"lower", volume_},
                 {"upper", upper_},
                 {"room", space_},
                 {"owner", owner_},
                 {"seen", seen_space_}});
  find_clear_.run(queue, fields_.vectors,
                  {{"cell_start", fluid.grid().cell_start()},
                   {"position", fluid.particles().position},
                   {"seen", seen_space_},
                   {"owner", owner_},
                   {"clear", clear_}},
                  boundary.outlines(), boundary.bodies_at(step), fields_.args(fluid));
  open_faces_.run(queue, fields_.vectors, {{"upper", upper_}, {"volume", volume_}},
                  fields_.args(fluid));
  fill_beside_solids_.run(queue, fields_.vectors,
                          {{"g", fields_.on_device},
                           {"volume", volume_},
                           {"room", space_},
                           {"seen", seen_space_},
                           {"clear", clear_},
                           {"fill", fields_.fill},
                           {"filled", filled_}});
  open_areas_.run(queue, fields_.vectors,
                  {{"piston", as_float(step.piston)},
                   {"owner", owner_},
                   {"fill", filled_},
                   {"volume", volume_},
                   {"gap", gap_},
                   {"held", upper_},
                   {"excess", excess_}},
                  boundary.outlines(), boundary.bodies_at(step), fields_.args(fluid));
  params_ = fluid.params();
  dt_ = step.dt;
}

// As coupling.h does it for those that the water moves, - p V K; and what gravity and the step do
// to the excess, whose water the pressures' areas have as the body's, or, where it is negative, the
// other way round.
std::vector<Press> GridSolids::press(Device& device, std::size_t bodies) const {
  std::vector<Press> all(bodies);
  if (!any_ || dt_ <= 0.0) return all;
  const MacGrid& g = fields_.grid;
  const MacLevel& l = g.level[0];
  const auto cells = static_cast<std::size_t>(l.cells);
  const std::vector<float> gap = gap_.read(device, 3 * cells);
  const std::vector<float> excess = excess_.read(device, 3 * cells);
  const std::vector<float> gains = gains_.read(device, 3 * cells);
  const std::vector<float> pressure = fields_.pressure.read(device, cells);
  const std::vector<int> owner = owner_.read(device, cells);
  const std::array<std::size_t, 3> step = {1, static_cast<std::size_t>(l.row),
                                           static_cast<std::size_t>(l.layer)};
  const Vector3 lower = vector(g.x, g.y, g.z);
  const Vector3 edge = vector(g.hx, g.hy, g.hz);
  const Vector3 gravity = vector(params_.gravity_x, params_.gravity_y, params_.gravity_z);
  const Vector3 pull = vector(params_.pull_x, params_.pull_y, params_.pull_z);
  const Vector3 centre = vector(params_.centre_x, params_.centre_y, params_.centre_z);
  const double volume = edge[0] * edge[1] * edge[2];
  const auto middle_of = [&](std::size_t c, std::size_t axis, std::size_t side) {
    const std::array<std::size_t, 3> at = {c % step[2] % step[1], c % step[2] / step[1],
                                           c / step[2]};
    Vector3 place;
    for (std::size_t k = 0; k < 3; ++k) {
      const double off = k == axis ? static_cast<double>(side) : 0.5;
      place[k] = lower[k] + (static_cast<double>(at[k]) - 1.0 + off) * edge[k];
    }
    return place;
  };
  const auto add = [&](int whose, std::size_t axis, double along, const Vector3& place) {
    if (whose < 0 || static_cast<std::size_t>(whose) >= bodies) return;
    Vector3 force = {0.0, 0.0, 0.0};
    force[axis] = along;
    Press& press = all[static_cast<std::size_t>(whose)];
    press.force = press.force + force;
    press.torque = press.torque + cross(place, force);
  };
  for (std::size_t c = step[2]; c + step[2] < cells; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t face = axis * cells + c;
      const bool presses = owner[c] >= 0 && pressure[c] != 0.0F;
      if (!presses && excess[face] == 0.0F) continue;
      const Vector3 place = middle_of(c, axis, 0);
      if (excess[face] != 0.0F) {
        const double fall = gravity[axis] - pull[axis] * (place[axis] - centre[axis]);
        const double rate = fall - static_cast<double>(gains[face]) / dt_;
        add(owner[c] >= 0 ? owner[c] : owner[c - step[axis]], axis,
            static_cast<double>(params_.rest_density) * volume * static_cast<double>(excess[face]) *
                rate,
            place);
      }
      if (!presses) continue;
      const double force = volume / edge[axis] * static_cast<double>(pressure[c]);
      add(owner[c], axis, force * static_cast<double>(gap[face]), place);
      add(owner[c], axis, -force * static_cast<double>(gap[face + step[axis]]),
          middle_of(c, axis, 1));
    }
  }
  return all;
}

}  // namespace splash::sim
