// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/system.hpp"

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

PressureSystem::PressureSystem(Device& device, const cl::Program& program, const MacFields& fields,
                               const GridSolids& solids, const CoupledBodies& bodies,
                               const ShutInAir& air)
    : fields_(fields),
      solids_(solids),
      bodies_(bodies),
      air_(air),
      most_(device, 1),
      link_(device, 3 * fields.room),
      open_(device, fields.room),
      damped_(device, fields.room),
      x_(device, fields.room),
      b_(device, fields.room),
      r_(device, fields.room),
      found_(device, fields.room),
      way_(device, fields.room),
      along_(device, fields.room),
      state_(device, 1),
      push_faces_(program, "push_faces", device.profile().group),
      lay_system_(program, "lay_system", device.profile().group),
      solve_pressure_(program, "solve_pressure", fields.team),
      project_faces_(program, "project_faces", device.profile().group),
      share_at_surface_(program, "share_at_surface", device.profile().group),
      sharpen_faces_(program, "sharpen_faces", device.profile().group) {}

void PressureSystem::push_faces(Fluid& fluid, const Step& step) {
  push_faces_.run(fluid.device().queue(), fields_.vectors,
                  {{"dt", as_float(step.dt)},
                   {"owner", solids_.owner()},
                   {"fill", solids_.fill()},
                   {"mean", fields_.mean},
                   {"weight", fields_.weight},
                   {"carries", fields_.carries},
                   {"pushed", fields_.change},
                   {"most", most_}},
                  fields_.args(fluid));
}

void PressureSystem::lay(Fluid& fluid, const Step& step) {
  lay_system_.run(fluid.device().queue(), fields_.vectors,
                  {{"dt", as_float(step.dt)},
                   {"piston_speed", as_float(step.piston_speed)},
                   {"gap", solids_.gap()},
                   {"space", solids_.space()},
                   {"owner", solids_.owner()},
                   {"fill", solids_.fill()},
                   {"pushed", fields_.change},
                   {"pressure", fields_.pressure},
                   {"air", fields_.air},
                   {"compliance", air_.compliance()},
                   {"room", static_cast<int>(fields_.room)},
                   {"link", link_},
                   {"start", found_},
                   {"wet", fields_.wet},
                   {"most", most_}},
                  unknowns(), fluid.boundary().steps_at(step), fields_.args(fluid));
}

void PressureSystem::solve(Fluid& fluid, const Step& step, bool anew, int iterations, bool yielding,
                           const Buffer<float>& found, const Buffer<SolveState>& state) {
  solve_pressure_.run_teams(fluid.device().queue(), 1,
                            {{"anew", static_cast<int>(anew)},
                             {"iterations", iterations},
                             {"room", static_cast<int>(fields_.room)},
                             {"free_count", yielding ? bodies_.count(fluid) : 0},
                             {"frees", bodies_.solved(fluid)},
                             {"owner", solids_.owner()},
                             {"grip", bodies_.grip()},
                             {"entrained", bodies_.entrained()},
                             {"most", most_},
                             {"link", link_},
                             {"open", open_},
                             {"damped", damped_},
                             {"x", x_},
                             {"b", b_},
                             {"r", r_},
                             {"found", found},
                             {"way", way_},
                             {"along", along_},
                             {"pockets", air_.pockets()},
                             {"list", air_.list()},
                             {"state", state}},
                            fluid.boundary().steps_at(step), fields_.args(fluid));
}

void PressureSystem::project(Fluid& fluid, const Step& step) {
  project_faces_.run(fluid.device().queue(), fields_.vectors,
                     {{"dt", as_float(step.dt)},
                      {"piston_speed", as_float(step.piston_speed)},
                      {"gap", solids_.gap()},
                      {"held", solids_.held()},
                      {"owner", solids_.owner()},
                      {"fill", solids_.fill()},
                      {"carries", fields_.carries},
                      {"weight", fields_.weight},
                      {"found", found_},
                      {"wet", fields_.wet},
                      {"air", fields_.air},
                      {"pushed", fields_.change},
                      {"pressure", fields_.pressure}},
                     fluid.boundary().steps_at(step), fields_.args(fluid));
  share_at_surface(fluid.device(), fields_.change);
  sharpen(fluid.device(), fields_.change, fields_.gain, nullptr);
}

void PressureSystem::share_at_surface(Device& device, const Buffer<float>& field) {
  share_at_surface_.run(device.queue(), fields_.vectors,
                        {{"g", fields_.on_device},
                         {"gap", solids_.gap()},
                         {"fill", solids_.fill()},
                         {"weight", fields_.weight},
                         {"wet", fields_.wet},
                         {"change", fields_.change},
                         {"field", field}});
}

void PressureSystem::sharpen(Device& device, const Buffer<float>& field, const Buffer<float>& sharp,
                             const Buffer<float>* parts) {
  sharpen_faces_.run(device.queue(), fields_.vectors,
                     {{"g", fields_.on_device},
                      {"owner", solids_.owner()},
                      {"fill", solids_.fill()},
                      {"weight", fields_.weight},
                      {"parted", static_cast<int>(parts != nullptr)},
                      {"parts", parts != nullptr ? *parts : fields_.weight},
                      {"field", field},
                      {"sharp", sharp}});
}

SolveWork PressureSystem::work() const {
  const SolveState& s = state_read_[0];
  return {s.solves, s.total, s.most, s.given_up, static_cast<double>(s.error)};
}

void PressureSystem::forget_work(Device& device) {
  state_.enqueue_clear(device);
  state_read_ = {};
}

void PressureSystem::forget(Device& device) {
  for (Buffer<float>* array : {&link_, &open_, &damped_, &x_, &b_, &r_, &found_, &way_, &along_}) {
    array->enqueue_clear(device);
  }
}

}  // namespace splash::sim
