// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/air_pockets.hpp"

#include <iterator>

#include "sim-server/device/device_error.hpp"
#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

ShutInAir::ShutInAir(Device& device, const cl::Program& program, const MacFields& fields,
                     const GridSolids& solids, bool looks)
    : fields_(fields),
      solids_(solids),
      looks_(looks),
      compliance_(device, fields.room),
      pockets_(device, 1),
      list_(device, looks ? fields.room : 1),
      label_(device, looks ? fields.room : 1),
      was_(device, looks ? fields.room : 1),
      counted_(device, std::vector<float>(looks ? fields.room : 1, -1.0F)),
      find_pockets_(program, "find_pockets", 1) {
  if (!looks || fields.team == 1) return;
  throw DeviceError(
      "air_pockets needs a device that solves with one work-item, a CPU; leave the key out, or "
      "choose another device with --device");
}

void ShutInAir::find(Fluid& fluid, const Step& step) {
  if (!looks_) return;
  find_pockets_.run(fluid.device().queue(), 1,
                    {{"dt", as_float(step.dt)},
                     {"gap", solids_.gap()},
                     {"space", solids_.space()},
                     {"fill", solids_.fill()},
                     {"label", label_},
                     {"counted", counted_},
                     {"was", was_},
                     {"list", list_},
                     {"pockets", pockets_},
                     {"air", fields_.air},
                     {"compliance", compliance_},
                     {"pressure", fields_.pressure}},
                    fields_.args(fluid));
}

void ShutInAir::forget(Device& device) {
  was_.enqueue_clear(device);
  pockets_.enqueue_clear(device);
}

std::vector<AirPocket> ShutInAir::read(Device& device) const {
  const std::vector<AirPockets> all = pockets_.read(device, 1);
  return {std::begin(all[0].pocket), std::begin(all[0].pocket) + all[0].count};
}

}  // namespace splash::sim
