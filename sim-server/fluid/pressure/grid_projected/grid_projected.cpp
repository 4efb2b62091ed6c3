// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"

#include <cmath>

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {
namespace {

constexpr double kGravity = 9.81;  ///< [m/s2]

}  // namespace

double filter_rate(double spacing) {
  return 0.5 * std::sqrt(kGravity / spacing);
}

GridProjected::GridProjected(Device& device, const FluidParams& params,
                             const std::vector<std::string>& defines, bool solids)
    : GridProjected(device, params, build_program(device, kernels::grid_projected(), defines),
                    solids) {}

GridProjected::GridProjected(Device& device, const FluidParams& params, const cl::Program& program,
                             bool solids)
    : part_(static_cast<double>(params.advective_cfl) / kGridAdvectiveCfl),
      fields_(device, params),
      solids_(device, program, fields_, solids),
      air_(device, program, fields_, solids_, params.pockets != 0),
      bodies_(device, program, fields_, solids_),
      system_(device, program, fields_, solids_, bodies_, air_),
      felt_(device, program, fields_, solids_, bodies_, system_),
      crowding_(device, program, fields_, solids_, system_),
      to_faces_(device, program, fields_),
      deviation_(device, fields_.carried.size()),
      seen_(device, 3 * fields_.room),
      find_deviation_(program, "find_deviation", device.profile().group),
      find_spacing_(program, "find_spacing", device.profile().group),
      move_particles_(program, "move_particles", device.profile().group),
      sample_pressure_(program, "sample_pressure", device.profile().group) {}

void GridProjected::recall_pressure(Fluid& fluid, const Step& step) {
  if (step.dt > 0.0) return;
  sample_pressure_.run(fluid.device().queue(), fluid.groups(),
                       {{"position", fluid.particles().position},
                        {"density", fluid.density()},
                        {"wet", fields_.wet},
                        {"pressure", fields_.pressure},
                        {"term", fluid.pressure_term()}},
                       fields_.args(fluid));
}

void GridProjected::accelerate(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const PointArrays& particles = fluid.particles();
  const Boundary& boundary = fluid.boundary();
  to_faces_.find(fluid, particles.velocity, fields_.mean);
  find_deviation_.run(queue, fluid.groups(),
                      {{"position", particles.position},
                       {"velocity", particles.velocity},
                       {"mean", fields_.mean},
                       {"deviation", deviation_}},
                      fields_.args(fluid));
  to_faces_.find(fluid, deviation_, seen_);
  solids_.place(fluid, step);
  air_.find(fluid, step);
  system_.push_faces(fluid, step);
  bodies_.let_fall(fluid, step);
  system_.lay(fluid, step);
  bodies_.find_grip(fluid, step);
  system_.solve(fluid, step);
  bodies_.push(fluid, step, system_.found());
  system_.project(fluid, step);
  crowding_.find(fluid, step);
  const double sound = kSpacingWay * static_cast<double>(fluid.params().support) / step.dt;
  const double slower = sound / static_cast<double>(fluid.params().sound_speed);
  find_spacing_.run(queue, fluid.groups(),
                    {{"p", fluid.params_buffer()},
                     {"slower", as_float(part_ * slower * slower)},
                     {"everywhere", static_cast<int>(spaces())},
                     {"steps", static_cast<float>(kSpacingSteps)},
                     {"cell_start", fluid.grid().cell_start()},
                     {"position", particles.position},
                     {"term", fluid.pressure_term()},
                     {"images", fluid.body_images()},
                     {"piston", as_float(step.piston)},
                     {"acceleration", fluid.acceleration()},
                     {"feels", static_cast<int>(felt_.feels())},
                     {"by_bodies", felt_.jolt()}},
                    boundary.matter(), boundary.bodies_at(step));
}

void GridProjected::move(Fluid& fluid, const Step& step) {
  const double rate = filter_rate(static_cast<double>(fluid.params().spacing));
  move_particles_.run(fluid.device().queue(), fluid.groups(),
                      {{"dt", as_float(step.dt)},
                       {"filtered", as_float(-std::expm1(-rate * step.dt))},
                       {"kick", as_float(part_ * kSpacingKick)},
                       {"piston", as_float(step.piston)},
                       {"piston_speed", as_float(step.piston_speed)},
                       {"carries", fields_.carries},
                       {"change", fields_.change},
                       {"gain", fields_.gain},
                       {"seen", seen_},
                       {"shift", crowding_.shift()},
                       {"deviation", deviation_},
                       {"acceleration", fluid.acceleration()},
                       {"position", fluid.particles().position},
                       {"velocity", fluid.particles().velocity},
                       {"carried", fields_.carried},
                       {"moving", fluid.moving()},
                       {"feels", static_cast<int>(felt_.feels())},
                       {"jolt", felt_.jolt()}},
                      fluid.boundary().outlines(), fluid.boundary().bodies_at(step),
                      fields_.args(fluid));
  felt_.weigh(fluid, step);
  since_spacing_ = (since_spacing_ + 1) % kSpacingSteps;
}

const Buffer<float>& GridProjected::carried(const Fluid& /*fluid*/) const {
  return fields_.carried;
}

void GridProjected::forget_pressure(Device& device) {
  fields_.pressure.enqueue_clear(device);
  fields_.wet.enqueue_clear(device);
  solids_.forget(device);
  bodies_.forget(device);
  air_.forget(device);
  note_recalled(device);
}

void GridProjected::note_recalled(Device& device) {
  since_spacing_ = 0;
  system_.forget(device);
  felt_.forget(device);
}

}  // namespace splash::sim
