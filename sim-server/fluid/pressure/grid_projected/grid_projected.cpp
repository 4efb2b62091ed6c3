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

float as_float(double value) {
  return static_cast<float>(value);
}

std::size_t cells_in(const MacGrid& grid) {
  const MacLevel& level = grid.level[0];
  return static_cast<std::size_t>(level.nx + 1) * static_cast<std::size_t>(level.ny + 1) *
         static_cast<std::size_t>(level.nz + 1);
}

/// Of two cells where vectors are, else of one (kernels/gather.cl).
std::size_t strips_in(const MacGrid& grid, const Device& device) {
  const MacLevel& level = grid.level[0];
  const int across = level.nx / (device.lanes() > 1 ? 2 : 1) + 1;
  return static_cast<std::size_t>(across) * static_cast<std::size_t>(level.ny + 1) *
         static_cast<std::size_t>(level.nz + 1);
}

/// Work-items of the work-group that solves.
std::size_t solvers(const Device& device) {
  return device.profile().team > 1 ? device.profile().judges : 1;
}

}  // namespace

double filter_rate(double spacing) {
  return 0.5 * std::sqrt(kGravity / spacing);
}

GridProjected::GridProjected(Device& device, const FluidParams& params,
                             const std::vector<std::string>& defines, bool bodies)
    : grid_(lay_mac_grid(params)),
      part_(static_cast<double>(params.way) / kGridWay),
      particles_(static_cast<std::size_t>(params.count)),
      cells_(cells_in(grid_)),
      strips_(strips_in(grid_, device)),
      room_(mac_room(grid_)),
      grid_buffer_(device, std::span<const MacGrid>(&grid_, 1)),
      mean_(device, 3 * room_),
      weight_(device, 3 * room_),
      fill_(device, room_),
      deviation_(device, 3 * static_cast<std::size_t>(params.capacity)),
      seen_(device, 3 * room_),
      change_(device, 3 * room_),
      carried_(device, 3 * static_cast<std::size_t>(params.capacity)),
      pressure_(device, room_),
      wet_(device, room_),
      most_(device, 1),
      bodies_(bodies),
      gap_(device, bodies ? 3 * room_ : 1),
      space_(device, bodies ? room_ : 1),
      owner_(device, bodies ? room_ : 1),
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
  gather_again_ = Kernel(program, "gather_again");
  find_deviation_ = Kernel(program, "find_deviation", group);
  cut_cells_ = Kernel(program, "cut_cells", 16);
  fill_beside_bodies_ = Kernel(program, "fill_beside_bodies");
  push_faces_ = Kernel(program, "push_faces");
  lay_system_ = Kernel(program, "lay_system");
  solve_pressure_ = Kernel(program, "solve_pressure", solvers(device));
  project_faces_ = Kernel(program, "project_faces");
  find_spacing_ = Kernel(program, "find_spacing", group);
  move_particles_ = Kernel(program, "move_particles", group);
  sample_pressure_ = Kernel(program, "sample_pressure", group);
}

void GridProjected::recall_pressure(Fluid& fluid, const Step& step) {
  if (step.dt > 0.0) return;
  sample_pressure_.run(fluid.device().queue(), fluid.groups(), fluid.params_buffer().memory(),
                       grid_buffer_.memory(), fluid.particles().position.memory(),
                       fluid.density().memory(), wet_.memory(), pressure_.memory(),
                       fluid.pressure_term().memory());
}

void GridProjected::accelerate(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const PointArrays& particles = fluid.particles();
  const Boundary& boundary = fluid.boundary();
  const cl::Buffer& cells = fluid.grid().cell_start().memory();
  const cl::Buffer& places = particles.position.memory();
  gather_faces_.run(queue, strips_, params, grid_buffer_.memory(), cells, places,
                    particles.velocity.memory(), mean_.memory(), weight_.memory(), fill_.memory());
  find_deviation_.run(queue, fluid.groups(), params, grid_buffer_.memory(),
                      particles.position.memory(), particles.velocity.memory(), mean_.memory(),
                      deviation_.memory());
  gather_again_.run(queue, strips_, params, grid_buffer_.memory(), cells, places,
                    deviation_.memory(), weight_.memory(), seen_.memory());
  if (bodies_) place_bodies(fluid, step);
  solve(fluid, step);
  const double sound = kSpacingWay * static_cast<double>(fluid.params().support) / step.dt;
  const double slower = sound / static_cast<double>(fluid.params().sound_speed);
  find_spacing_.run(queue, fluid.groups(), params, as_float(part_ * slower * slower),
                    fluid.grid().cell_start().memory(), particles.position.memory(),
                    fluid.pressure_term().memory(), fluid.body_images().memory(),
                    boundary.grid().cell_start().memory(), boundary.points().position.memory(),
                    boundary.volume().memory(), boundary.points().stride, boundary.steps().memory(),
                    step.first_body, boundary.body_count(), as_float(step.piston),
                    fluid.acceleration().memory(), fluid.moving().memory());
}

void GridProjected::place_bodies(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const Boundary& boundary = fluid.boundary();
  cut_cells_.run(queue, cells_, params, grid_buffer_.memory(), boundary.shapes().memory(),
                 boundary.meshes().memory(), boundary.steps().memory(), step.first_body,
                 boundary.body_count(), gap_.memory(), space_.memory(), owner_.memory());
  fill_beside_bodies_.run(queue, cells_, params, grid_buffer_.memory(), boundary.steps().memory(),
                          step.first_body, boundary.body_count(), space_.memory(), fill_.memory());
}

void GridProjected::solve(Fluid& fluid, const Step& step) {
  const float dt = as_float(step.dt);
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const auto room = static_cast<int>(room_);
  push_faces_.run(queue, cells_, params, grid_buffer_.memory(), dt, mean_.memory(),
                  weight_.memory(), change_.memory());
  most_.enqueue_clear(fluid.device());
  lay_system_.run(
      queue, cells_, params, grid_buffer_.memory(), dt, fluid.boundary().steps().memory(),
      step.first_body, gap_.memory(), space_.memory(), owner_.memory(), fill_.memory(),
      change_.memory(), pressure_.memory(), room, link_.memory(), open_.memory(), x_.memory(),
      b_.memory(), r_.memory(), found_.memory(), way_.memory(), wet_.memory(), most_.memory());
  solve_pressure_.run_teams(queue, 1, grid_buffer_.memory(), kIterations, room, most_.memory(),
                            link_.memory(), open_.memory(), damped_.memory(), x_.memory(),
                            b_.memory(), r_.memory(), found_.memory(), way_.memory(),
                            along_.memory(), state_.memory());
  project_faces_.run(queue, cells_, params, grid_buffer_.memory(), dt, gap_.memory(),
                     space_.memory(), fill_.memory(), mean_.memory(), weight_.memory(),
                     found_.memory(), wet_.memory(), change_.memory(), pressure_.memory());
}

void GridProjected::move(Fluid& fluid, const Step& step) {
  const double rate = filter_rate(static_cast<double>(fluid.params().spacing));
  move_particles_.run(
      fluid.device().queue(), fluid.groups(), fluid.params_buffer().memory(), grid_buffer_.memory(),
      as_float(step.dt), as_float(-std::expm1(-rate * step.dt)), as_float(part_ * kSpacingKick),
      as_float(step.piston), as_float(step.piston_speed), fluid.boundary().shapes().memory(),
      fluid.boundary().meshes().memory(), fluid.boundary().steps().memory(), step.first_body,
      fluid.boundary().body_count(), change_.memory(), seen_.memory(), deviation_.memory(),
      fluid.acceleration().memory(), fluid.particles().position.memory(),
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
  wet_.enqueue_clear(device);
  note_recalled(device);
}

// What a step that went wrong left in its own arrays would go on from one to the next.
void GridProjected::note_recalled(Device& device) {
  for (Buffer<float>* array : {&link_, &open_, &damped_, &x_, &b_, &r_, &found_, &way_, &along_}) {
    array->enqueue_clear(device);
  }
}

}  // namespace splash::sim
