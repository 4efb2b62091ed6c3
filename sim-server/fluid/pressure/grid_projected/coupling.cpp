// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/coupling.hpp"

#include <algorithm>

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

CoupledBodies::CoupledBodies(Device& device, const cl::Program& program, const MacFields& fields,
                             const GridSolids& solids)
    : fields_(fields),
      solids_(solids),
      no_body_(device, 1),
      grip_(device, 1),
      entrained_(device, 1),
      kept_(device, 1),
      tied_(device, 1),
      tuggings_(device, 1),
      let_fall_(program, "let_fall", 1),
      entrain_water_(program, "entrain_water", fields.team),
      grip_water_(program, "grip_water"),
      push_bodies_(program, "push_bodies", fields.team),
      tie_bodies_(program, "tie_bodies", 1),
      tell_tugs_(program, "tell_tugs", 1) {}

void CoupledBodies::release(Device& device, std::size_t count) {
  released_ = true;
  grip_ = Buffer<float>(device, 6 * fields_.room);
  entrained_ = Buffer<float>(device, SPLASH_ENTRAINED_FLOATS * count);
  kept_ = Buffer<float>(device, SPLASH_KEPT_FLOATS * count);
  tied_ = Buffer<FreeBody>(device, count);
  tuggings_ = Buffer<float>(device, SPLASH_TUG_FLOATS * count);
}

int CoupledBodies::count(Fluid& fluid) const {
  const FreeBodies* bodies = fluid.free_bodies();
  return bodies == nullptr ? 0 : static_cast<int>(bodies->bodies().size());
}

const Buffer<FreeBody>& CoupledBodies::frees(Fluid& fluid) const {
  const FreeBodies* bodies = fluid.free_bodies();
  return bodies == nullptr ? no_body_ : bodies->on_device();
}

bool CoupledBodies::any_hung(Fluid& fluid) const {
  const FreeBodies* bodies = fluid.free_bodies();
  return bodies != nullptr && std::any_of(bodies->bodies().begin(), bodies->bodies().end(),
                                          [](const FreeBody& body) { return body.spring > 0.0F; });
}

const Buffer<FreeBody>& CoupledBodies::solved(Fluid& fluid) const {
  return any_hung(fluid) ? tied_ : frees(fluid);
}

void CoupledBodies::let_fall(Fluid& fluid, const Step& step) {
  const int count = this->count(fluid);
  if (count == 0) return;
  let_fall_.run(fluid.device().queue(), static_cast<std::size_t>(count),
                {{"p", fluid.params_buffer()},
                 {"dt", as_float(step.dt)},
                 {"free_count", count},
                 {"frees", frees(fluid)},
                 {"kept", kept_}},
                fluid.boundary().steps_at(step));
  if (any_hung(fluid)) tie(fluid, step);
  entrain_water_.run_teams(fluid.device().queue(), 1,
                           {{"dt", as_float(step.dt)},
                            {"free_count", count},
                            {"frees", solved(fluid)},
                            {"shapes", fluid.boundary().shapes()},
                            {"owner", solids_.owner()},
                            {"excess", solids_.excess()},
                            {"carries", fields_.carries},
                            {"entrained", entrained_}},
                           fluid.boundary().steps_at(step), fields_.args(fluid));
}

void CoupledBodies::tie(Fluid& fluid, const Step& step) {
  const int count = this->count(fluid);
  const int first_anchor = step.first_body / fluid.boundary().body_count() * count;
  tie_bodies_.run(fluid.device().queue(), static_cast<std::size_t>(count),
                  {{"p", fluid.params_buffer()},
                   {"dt", as_float(step.dt)},
                   {"free_count", count},
                   {"frees", frees(fluid)},
                   {"kept", kept_},
                   {"anchors", fluid.free_bodies()->anchors()},
                   {"first_anchor", first_anchor},
                   {"tied", tied_},
                   {"tuggings", tuggings_}},
                  fluid.boundary().steps_at(step));
}

void CoupledBodies::find_grip(Fluid& fluid, const Step& step) {
  if (count(fluid) > 0) find_grip(fluid, step, count(fluid), frees(fluid), grip_);
}

void CoupledBodies::find_grip(Fluid& fluid, const Step& step, int count,
                              const Buffer<FreeBody>& bodies, const Buffer<float>& grip) {
  grip_water_.run(fluid.device().queue(), fields_.cells,
                  {{"g", fields_.on_device},
                   {"free_count", count},
                   {"frees", bodies},
                   {"shapes", fluid.boundary().shapes()},
                   {"gap", solids_.gap()},
                   {"owner", solids_.owner()},
                   {"wet", fields_.wet},
                   {"air", fields_.air},
                   {"grip", grip}},
                  fluid.boundary().steps_at(step));
}

void CoupledBodies::push(Fluid& fluid, const Step& step, const Buffer<float>& found) {
  const int count = this->count(fluid);
  if (count == 0) return;
  push_bodies_.run_teams(fluid.device().queue(), 1,
                         {{"free_count", count},
                          {"frees", solved(fluid)},
                          {"owner", solids_.owner()},
                          {"grip", grip_},
                          {"found", found},
                          {"entrained", entrained_},
                          {"kept", kept_},
                          {"felt", fluid.free_bodies()->felt()}},
                         fluid.boundary().steps_at(step), fields_.args(fluid));
  if (!any_hung(fluid)) return;
  tell_tugs_.run(fluid.device().queue(), static_cast<std::size_t>(count),
                 {{"free_count", count},
                  {"frees", frees(fluid)},
                  {"tuggings", tuggings_},
                  {"tugs", fluid.free_bodies()->tugs()}},
                 fluid.boundary().steps_at(step));
}

}  // namespace splash::sim
