// SPDX-License-Identifier: MIT
#include "sim-server/fluid/free_bodies/body_reach.hpp"

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

BodyReach::BodyReach(Device& device, const cl::Program& program, const FluidParams& params,
                     std::size_t bodies)
    : count(bodies),
      groups(device.vectors_of(params.count)),
      reach(device, bodies * SPLASH_REACH_FIELDS * static_cast<std::size_t>(params.capacity)),
      reached(device, bodies * groups),
      parts(device, bodies * SPLASH_PUSH_PARTS * SPLASH_PUSH_ENTRIES),
      reach_bodies(program, "reach_bodies", device.profile().group),
      weigh_water(program, "weigh_water", device.profile().team) {}

void BodyReach::find(Fluid& fluid, const Step& step, const Buffer<FreeBody>& bodies) {
  const Boundary& boundary = fluid.boundary();
  reach_bodies.run(fluid.device().queue(), count * groups,
                   {{"p", fluid.params_buffer()},
                    {"dt", as_float(step.dt)},
                    {"free_count", static_cast<int>(count)},
                    {"frees", bodies},
                    {"cell_start", fluid.grid().cell_start()},
                    {"position", fluid.particles().position},
                    {"velocity", fluid.particles().velocity},
                    {"density", fluid.density()},
                    {"images", fluid.body_images()},
                    {"pressure_term", fluid.pressure_term()},
                    {"body_velocity", boundary.points().velocity},
                    {"body_id", boundary.points().id},
                    {"owner", boundary.owner()},
                    {"reach", reach},
                    {"reached", reached}},
                   boundary.matter(), boundary.steps_at(step));
}

void BodyReach::weigh(Fluid& fluid, const Step& step, const Buffer<FreeBody>& bodies,
                      const Buffer<float>& pressure, double pushing, double rubbing) {
  weigh_water.run_teams(fluid.device().queue(), count * SPLASH_PUSH_PARTS,
                        {{"p", fluid.params_buffer()},
                         {"pushing", as_float(pushing)},
                         {"rubbing", as_float(rubbing)},
                         {"frees", bodies},
                         {"position", fluid.particles().position},
                         {"pressure", pressure},
                         {"reach", reach},
                         {"reached", reached},
                         {"parts", parts}},
                        fluid.boundary().steps_at(step));
}

}  // namespace splash::sim
