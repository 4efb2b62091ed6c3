// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/given.hpp"

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

GivenMomentum::GivenMomentum(Device& device, const cl::Program& program, const MacFields& fields,
                             const GridSolids& solids, PressureSystem& system)
    : fields_(fields),
      solids_(solids),
      system_(system),
      jolt_(device, 1),
      change_(device, 1),
      given_(device, 1),
      taken_(device, 1),
      whose_(device, 1),
      parts_(device, 1),
      mark_faces_(program, "mark_faces"),
      weigh_faces_(program, "weigh_faces", fields.team),
      weigh_given_(program, "weigh_given", device.profile().team),
      sum_given_(program, "sum_given", 1) {}

void GivenMomentum::make_room(Device& device) {
  jolt_ = Buffer<float>(device, fields_.carried.size());
  change_ = Buffer<float>(device, 3 * fields_.room);
  given_ = Buffer<float>(device, 3 * fields_.room);
  taken_ = Buffer<float>(device, 3 * fields_.room);
  whose_ = Buffer<float>(device, 3 * fields_.room);
}

void GivenMomentum::weigh(Fluid& fluid, const Step& step, const FeltBodies& felt,
                          const Buffer<float>& found, int only, int part) {
  cl::CommandQueue& queue = fluid.device().queue();
  const std::size_t count = felt.list.size();
  const std::size_t entries = count * 6 * (SPLASH_PUSH_PARTS + 1);
  if (parts_.size() != entries) parts_ = Buffer<float>(fluid.device(), entries);
  const KernelArg bodies = {"felt", felt.on_device};
  const KernelArg body_count = {"felt_count", static_cast<int>(count)};
  mark_faces_.run(queue, fields_.cells,
                  {{"falls", only < 0 ? as_float(step.dt) : 0.0F},
                   {"only", only},
                   {"part", part},
                   body_count,
                   bodies,
                   {"owner", solids_.owner()},
                   {"gap", solids_.gap()},
                   {"held", solids_.held()},
                   {"excess", solids_.excess()},
                   {"fill", solids_.fill()},
                   {"wet", fields_.wet},
                   {"found", found},
                   {"change", fields_.change},
                   {"given", change_},
                   {"taken", taken_},
                   {"whose", whose_}},
                  fluid.boundary().steps_at(step), fields_.args(fluid));
  if (only >= 0) system_.share_at_surface(fluid.device(), change_);
  system_.sharpen(fluid.device(), change_, given_, &whose_);
  weigh_faces_.run_teams(queue, 1,
                         {{"g", fields_.on_device},
                          body_count,
                          {"only", only},
                          {"part", part},
                          bodies,
                          {"taken", taken_},
                          {"whose", whose_},
                          {"parts", parts_}},
                         fluid.boundary().steps_at(step));
  weigh_given_.run_teams(queue, count * SPLASH_PUSH_PARTS,
                         {{"dt", as_float(step.dt)},
                          {"only", only},
                          {"part_of_speed", part},
                          {"counts", static_cast<int>(only < 0)},
                          bodies,
                          {"change", fields_.change},
                          {"given", given_},
                          {"whose", whose_},
                          {"position", fluid.particles().position},
                          {"carried", fields_.carried},
                          {"jolt", jolt_},
                          {"parts", parts_}},
                         fluid.boundary().outlines(), fluid.boundary().bodies_at(step),
                         fields_.args(fluid));
  sum_given_.run(
      queue, count,
      {body_count, {"only", only}, {"part", part}, bodies, {"parts", parts_}, {"sums", felt.sums}});
}

}  // namespace splash::sim
