// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"

#include <cmath>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/kernel_sources.hpp"

namespace splash::sim {
namespace {

static_assert(sizeof(SolveState) == 32);

constexpr double kGravity = 9.81;  ///< [m/s2]

/// Of a solve, at most.
constexpr int kIterations = 40;

/// How far spacing's sound goes in a step [supports].
constexpr double kSoundWay = 0.4;

float as_float(double value) {
  return static_cast<float>(value);
}

std::size_t cells_in(const MacGrid& grid) {
  const MacLevel& level = grid.level[0];
  return static_cast<std::size_t>(level.nx + 1) * static_cast<std::size_t>(level.ny + 1) *
         static_cast<std::size_t>(level.nz + 1);
}

/// Work-items of the work-group that solves.
std::size_t solvers(const Device& device) {
  return device.profile().team > 1 ? device.profile().judges : 1;
}

}  // namespace

double filter_rate(double spacing) {
  return std::sqrt(kGravity / spacing);
}

GridProjected::GridProjected(Device& device, const FluidParams& params,
                             const std::vector<std::string>& defines)
    : grid_(lay_mac_grid(params)),
      particles_(static_cast<std::size_t>(params.count)),
      cells_(cells_in(grid_)),
      room_(mac_room(grid_)),
      grid_buffer_(device, std::span<const MacGrid>(&grid_, 1)),
      mean_(device, 3 * room_),
      weight_(device, 3 * room_),
      fill_(device, room_),
      deviation_(device, 3 * static_cast<std::size_t>(params.capacity)),
      seen_(device, 3 * room_),
      change_(device, 3 * room_),
      spacing_term_(device, static_cast<std::size_t>(params.capacity) + kReadAhead),
      carried_(device, 3 * static_cast<std::size_t>(params.capacity)),
      pressure_(device, room_),
      flags_(device, room_),
      most_(device, 1),
      link_(device, 3 * room_),
      open_(device, room_),
      damped_(device, room_),
      x_(device, room_),
      b_(device, room_),
      r_(device, room_),
      found_(device, room_),
      way_(device, room_),
      along_(device, room_),
      state_(device, 1),
      state_read_{} {
  const cl::Program program = build_program(device, grid_projected_sources(), defines);
  const std::size_t group = device.profile().group;
  gather_faces_ = Kernel(program, "gather_faces");
  find_deviation_ = Kernel(program, "find_deviation");
  push_faces_ = Kernel(program, "push_faces");
  lay_system_ = Kernel(program, "lay_system");
  solve_pressure_ = Kernel(program, "solve_pressure", solvers(device));
  project_faces_ = Kernel(program, "project_faces");
  find_spacing_ = Kernel(program, "find_spacing", group);
  move_particles_ = Kernel(program, "move_particles", group);
  sample_pressure_ = Kernel(program, "sample_pressure");
}

void GridProjected::recall_pressure(Fluid& fluid) {
  sample_pressure_.run(fluid.device().queue(), particles_, fluid.params_buffer().memory(),
                       grid_buffer_.memory(), fluid.particles().position.memory(),
                       fluid.density().memory(), flags_.memory(), pressure_.memory(),
                       fluid.pressure_term().memory(), spacing_term_.memory());
}

void GridProjected::gather(Fluid& fluid, const Buffer<float>& value, const Buffer<float>& mean) {
  gather_faces_.run(fluid.device().queue(), cells_, fluid.params_buffer().memory(),
                    grid_buffer_.memory(), fluid.grid().cell_start(),
                    fluid.particles().position.memory(), value.memory(), mean.memory(),
                    weight_.memory(), fill_.memory());
}

void GridProjected::accelerate(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const PointArrays& particles = fluid.particles();
  gather(fluid, particles.velocity, mean_);
  find_deviation_.run(queue, particles_, params, grid_buffer_.memory(), particles.position.memory(),
                      particles.velocity.memory(), mean_.memory(), deviation_.memory());
  gather(fluid, deviation_, seen_);
  solve(fluid, as_float(step.dt));
  // Sound that goes so far in this step.
  const double slow = kSoundWay * static_cast<double>(fluid.params().support) / step.dt;
  const double slower = slow / static_cast<double>(fluid.params().sound_speed);
  find_spacing_.run(queue, fluid.groups(), params, as_float(slower * slower),
                    fluid.grid().cell_start(), particles.position.memory(), spacing_term_.memory(),
                    as_float(step.piston), fluid.acceleration().memory(), fluid.moving().memory());
}

void GridProjected::solve(Fluid& fluid, float dt) {
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const auto room = static_cast<int>(room_);
  push_faces_.run(queue, cells_, params, grid_buffer_.memory(), dt, mean_.memory(),
                  weight_.memory(), change_.memory());
  most_.enqueue_clear(fluid.device());
  lay_system_.run(queue, cells_, params, grid_buffer_.memory(), dt, fill_.memory(),
                  change_.memory(), pressure_.memory(), room, link_.memory(), open_.memory(),
                  x_.memory(), b_.memory(), r_.memory(), found_.memory(), way_.memory(),
                  flags_.memory(), most_.memory());
  solve_pressure_.run_teams(queue, 1, grid_buffer_.memory(), kIterations, room, most_.memory(),
                            link_.memory(), open_.memory(), damped_.memory(), x_.memory(),
                            b_.memory(), r_.memory(), found_.memory(), way_.memory(),
                            along_.memory(), state_.memory());
  project_faces_.run(queue, cells_, params, grid_buffer_.memory(), dt, fill_.memory(),
                     mean_.memory(), weight_.memory(), found_.memory(), change_.memory(),
                     flags_.memory(), pressure_.memory());
}

void GridProjected::move(Fluid& fluid, const Step& step) {
  const double rate = filter_rate(static_cast<double>(fluid.params().spacing));
  move_particles_.run(
      fluid.device().queue(), fluid.groups(), fluid.params_buffer().memory(), grid_buffer_.memory(),
      as_float(step.dt), as_float(-std::expm1(-rate * step.dt)), as_float(step.piston),
      as_float(step.piston_speed), change_.memory(), flags_.memory(), seen_.memory(),
      deviation_.memory(), fluid.acceleration().memory(), fluid.particles().position.memory(),
      fluid.particles().velocity.memory(), carried_.memory());
}

const Buffer<float>& GridProjected::carried(const Fluid& /*fluid*/) const {
  return carried_;
}

void GridProjected::enqueue_work(Device& device) {
  state_.enqueue_read(device, state_read_);
}

SolverWork GridProjected::work() const {
  const SolveState& s = state_read_[0];
  return {{}, {s.solves, s.total, s.most, s.given_up, static_cast<double>(s.error)}};
}

void GridProjected::forget_work(Device& device) {
  state_.enqueue_clear(device);
  state_read_ = {};
}

std::vector<float> GridProjected::pressure(Device& /*device*/) {
  return {};
}

void GridProjected::restore_pressure(Device& device, const std::vector<float>& /*pressure*/) {
  pressure_.enqueue_clear(device);
  flags_.enqueue_clear(device);
  note_recalled(device);
}

// What a step that went wrong left in its own arrays would go on from one to the next.
void GridProjected::note_recalled(Device& device) {
  for (Buffer<float>* array : {&link_, &open_, &damped_, &x_, &b_, &r_, &found_, &way_, &along_}) {
    array->enqueue_clear(device);
  }
}

}  // namespace splash::sim
