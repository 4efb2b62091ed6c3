// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/crowding.hpp"

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {
namespace {

/// Iterations of its solve, at most: what is left is the next step's.
constexpr int kIterations = 6;

}  // namespace

Crowding::Crowding(Device& device, const cl::Program& program, const MacFields& fields,
                   const GridSolids& solids, PressureSystem& system)
    : fields_(fields),
      solids_(solids),
      system_(system),
      found_(device, fields.room),
      shift_(device, 3 * fields.room),
      state_(device, 1),
      ask_for_room_(program, "ask_for_room", device.profile().group),
      find_shift_(program, "find_shift", device.profile().group) {}

void Crowding::find(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  ask_for_room_.run(queue, fields_.vectors,
                    {{"g", fields_.on_device},
                     {"dt", as_float(step.dt)},
                     {"seen", solids_.seen()},
                     {"fill", solids_.fill()},
                     {"wet", fields_.wet},
                     {"start", found_}},
                    system_.unknowns());
  system_.solve_again(fluid, step, kIterations, false, found_, state_);
  find_shift_.run(queue, fields_.vectors,
                  {{"g", fields_.on_device},
                   {"gap", solids_.gap()},
                   {"fill", solids_.fill()},
                   {"wet", fields_.wet},
                   {"air", fields_.air},
                   {"found", found_},
                   {"shift", shift_}});
}

}  // namespace splash::sim
