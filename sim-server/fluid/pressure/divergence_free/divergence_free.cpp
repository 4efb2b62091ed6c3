// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/divergence_free/divergence_free.hpp"

#include <cmath>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/kernel_sources.hpp"

namespace splash::sim {
namespace {

static_assert(sizeof(SolveState) == 32);

/// Iterations of the two solves, at least and at most. A fresh lattice would want a hundred; it is
/// given several steps for it.
struct Iterations {
  int least;
  int most;
};
constexpr std::array<Iterations, 2> kIterations = {{{1, 10}, {1, 20}}};

/// How much of a step's pressures goes into what the next density solve starts from. A solve that
/// starts from all of the last one's overshoots, step by step more where its few iterations do not
/// reach: 14 layers of still water exploded. A mean over some hundred steps holds the weight of the
/// water, for which a solve would need many iterations, and leaves to it what is new.
constexpr float kFollow = 0.01F;

}  // namespace

DivergenceFree::DivergenceFree(Device& device, const FluidParams& params,
                               const std::vector<std::string>& defines)
    : particles_(static_cast<std::size_t>(params.count)),
      groups_(device.vectors_of(params.count)),
      stride_(static_cast<std::size_t>(params.capacity)),
      gradient_(device, 3 * stride_),
      response_(device, stride_),
      boundary_rate_(device, stride_),
      guess_(device, 3 * stride_),
      offset_(device, stride_),
      divergence_pressure_(device, stride_),
      jacobi_(device, stride_),
      change_(device, stride_),
      warm_(device, stride_),
      all_(device, stride_),
      error_part_(device, 2 * groups_),
      state_{Buffer<SolveState>(device, 1), Buffer<SolveState>(device, 1)},
      state_read_{} {
  const cl::Program program = build_program(device, divergence_free_sources(), defines);
  const std::size_t group = device.profile().group;
  recall_pressure_ = Kernel(program, "recall_pressure");
  measure_response_ = Kernel(program, "measure_response", group);
  begin_divergence_solve_ = Kernel(program, "begin_divergence_solve");
  begin_density_solve_ = Kernel(program, "begin_density_solve");
  correct_pressure_ = Kernel(program, "correct_pressure", group);
  judge_solve_ = Kernel(program, "judge_solve", device.profile().judges);
  error_parts_ = device.profile().team > 1 ? correct_pressure_.groups_of(groups_) : groups_;
  push_by_pressure_ = Kernel(program, "push_by_pressure", group);
  end_solves_ = Kernel(program, "end_solves");
}

void DivergenceFree::recall_pressure(Fluid& fluid, const Step& /*step*/) {
  recall_pressure_.run(fluid.device().queue(), particles_, fluid.params_buffer().memory(),
                       fluid.particles().id.memory(), all_.memory(),
                       fluid.pressure_term().memory());
}

void DivergenceFree::accelerate(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const PointArrays& particles = fluid.particles();
  const auto dt = static_cast<float>(step.dt);
  measure_response(fluid, step);
  FreeBodies* bodies = fluid.free_bodies();
  if (bodies != nullptr) bodies->reach(fluid, step, particles.velocity, response_);
  begin_divergence_solve_.run(queue, particles_, params, fluid.density().memory(),
                              particles.velocity.memory(), guess_.memory(), offset_.memory(),
                              divergence_pressure_.memory());
  solve(fluid, step, kDivergence, divergence_pressure_);
  recall_pressure_.run(queue, particles_, params, particles.id.memory(), warm_.memory(),
                       fluid.pressure_term().memory());
  fluid.compute_acceleration(step, guess_);
  if (bodies != nullptr) bodies->reach(fluid, step, guess_, response_);
  begin_density_solve_.run(queue, particles_, params, dt, fluid.density().memory(),
                           fluid.acceleration().memory(), guess_.memory(), offset_.memory());
  if (bodies != nullptr) answer_of_bodies(fluid, step);
  solve(fluid, step, kDensity, fluid.pressure_term());
  end_solves_.run(queue, particles_, params, dt, kFollow, particles.id.memory(),
                  particles.velocity.memory(), guess_.memory(), divergence_pressure_.memory(),
                  fluid.pressure_term().memory(), warm_.memory(), all_.memory(),
                  fluid.acceleration().memory());
}

void DivergenceFree::measure_response(Fluid& fluid, const Step& step) {
  measure_response_.run(
      fluid.device().queue(), fluid.groups(), fluid.params_buffer().memory(),
      fluid.grid().cell_start(), fluid.cell_activity(), fluid.particles().position.memory(),
      fluid.body_images().memory(), fluid.boundary().grid().cell_start(),
      fluid.boundary().points().position.memory(), fluid.boundary().points().velocity.memory(),
      fluid.boundary().volume().memory(), fluid.boundary().points().stride,
      fluid.boundary().steps().memory(), step.first_body, fluid.boundary().body_count(),
      static_cast<float>(step.piston), static_cast<float>(step.piston_speed), gradient_.memory(),
      response_.memory(), boundary_rate_.memory());
}

void DivergenceFree::answer_of_bodies(Fluid& fluid, const Step& step) {
  fluid.free_bodies()->answer(fluid, step,
                              {.pressure = &fluid.pressure_term(),
                               .pushing = step.dt,
                               .rubbing = step.dt,
                               .falling = step.dt,
                               .velocity = &guess_,
                               .rate = &boundary_rate_});
}

void DivergenceFree::solve(Fluid& fluid, const Step& step, std::size_t number,
                           const Buffer<float>& pressure) {
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const cl::Buffer& cells = fluid.grid().cell_start();
  const cl::Buffer& activity = fluid.cell_activity();
  const cl::Buffer& places = fluid.particles().position.memory();
  const cl::Buffer& state = state_[number].memory();
  const std::size_t items = fluid.groups();
  const auto dt = static_cast<float>(step.dt);
  const auto [least, most] = kIterations[number];
  double t = 1.0;  // Nesterov's sequence
  for (int k = 0; k < most; ++k) {
    const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    const auto beta = static_cast<float>((t - 1.0) / next);
    t = next;
    correct_pressure_.run(queue, items, params, k, state, beta, dt, cells, activity, places,
                          guess_.memory(), gradient_.memory(), response_.memory(),
                          boundary_rate_.memory(), offset_.memory(), pressure.memory(),
                          jacobi_.memory(), change_.memory(), error_part_.memory());
    judge_solve_.run_teams(queue, 1, params, static_cast<int>(error_parts_), k, least, most,
                           error_part_.memory(), state);
    push_by_pressure_.run(queue, items, params, k, state, dt, cells, activity, places,
                          gradient_.memory(), change_.memory(), pressure.memory(), guess_.memory());
    if (fluid.free_bodies() == nullptr) continue;
    fluid.free_bodies()->answer(fluid, step,
                                {.iteration = k,
                                 .state = &state_[number],
                                 .pressure = &change_,
                                 .pushing = step.dt,
                                 .velocity = &guess_,
                                 .rate = &boundary_rate_});
  }
}

void DivergenceFree::enqueue_work(Device& device) {
  for (std::size_t s = 0; s < 2; ++s) state_[s].enqueue_read(device, state_read_[s]);
}

SolverWork DivergenceFree::work() const {
  const auto of = [this](std::size_t number) -> SolveWork {
    const SolveState& s = state_read_[number][0];
    return {s.solves, s.total, s.most, s.given_up, static_cast<double>(s.error)};
  };
  return {of(kDivergence), of(kDensity)};
}

void DivergenceFree::forget_work(Device& device) {
  for (std::size_t s = 0; s < 2; ++s) {
    state_[s].enqueue_clear(device);
    state_read_[s] = {};
  }
}

std::vector<float> DivergenceFree::pressure(Device& device) {
  std::vector<float> kept = warm_.read(device, particles_);
  const std::vector<float> all = all_.read(device, particles_);
  kept.insert(kept.end(), all.begin(), all.end());
  return kept;
}

void DivergenceFree::restore_pressure(Device& device, const std::vector<float>& pressure) {
  const std::span<const float> both(pressure);
  warm_.write(device, both.first(particles_));
  all_.write(device, both.last(particles_));
}

}  // namespace splash::sim
