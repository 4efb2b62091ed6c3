// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/divergence_free/divergence_free.hpp"

#include <cmath>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/params/parts.hpp"

namespace splash::sim {
namespace {

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
  recall_pressure_.run(fluid.device().queue(), particles_,
                       {{"p", fluid.params_buffer()},
                        {"id", fluid.particles().id},
                        {"kept", all_},
                        {"pressure", fluid.pressure_term()}});
}

void DivergenceFree::accelerate(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const PointArrays& particles = fluid.particles();
  const auto dt = static_cast<float>(step.dt);
  measure_response(fluid, step);
  FreeBodies* bodies = fluid.free_bodies();
  if (bodies != nullptr) bodies->reach(fluid, step, particles.velocity, response_);
  begin_divergence_solve_.run(queue, particles_,
                              {{"p", params},
                               {"density", fluid.density()},
                               {"velocity", particles.velocity},
                               {"guess", guess_},
                               {"offset", offset_},
                               {"pressure", divergence_pressure_}});
  solve(fluid, step, kDivergence, divergence_pressure_);
  recall_pressure_.run(
      queue, particles_,
      {{"p", params}, {"id", particles.id}, {"kept", warm_}, {"pressure", fluid.pressure_term()}});
  fluid.compute_acceleration(step, guess_);
  if (bodies != nullptr) bodies->reach(fluid, step, guess_, response_);
  begin_density_solve_.run(queue, particles_,
                           {{"p", params},
                            {"dt", dt},
                            {"density", fluid.density()},
                            {"acceleration", fluid.acceleration()},
                            {"guess", guess_},
                            {"offset", offset_}});
  if (bodies != nullptr) answer_of_bodies(fluid, step);
  solve(fluid, step, kDensity, fluid.pressure_term());
  end_solves_.run(queue, particles_,
                  {{"p", params},
                   {"dt", dt},
                   {"follow", kFollow},
                   {"id", particles.id},
                   {"velocity", particles.velocity},
                   {"guess", guess_},
                   {"divergence_pressure", divergence_pressure_},
                   {"pressure", fluid.pressure_term()},
                   {"warm", warm_},
                   {"pushed", all_},
                   {"acceleration", fluid.acceleration()}});
}

void DivergenceFree::measure_response(Fluid& fluid, const Step& step) {
  const Boundary& boundary = fluid.boundary();
  measure_response_.run(fluid.device().queue(), fluid.groups(),
                        {{"p", fluid.params_buffer()},
                         {"cell_start", fluid.grid().cell_start()},
                         {"activity", fluid.cell_activity()},
                         {"position", fluid.particles().position},
                         {"images", fluid.body_images()},
                         {"body_velocity", boundary.points().velocity},
                         {"piston", static_cast<float>(step.piston)},
                         {"piston_speed", static_cast<float>(step.piston_speed)},
                         {"gradient", gradient_},
                         {"response", response_},
                         {"boundary_rate", boundary_rate_}},
                        boundary.matter(), boundary.bodies_at(step));
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
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const Buffer<int>& cells = fluid.grid().cell_start();
  const Buffer<int>& activity = fluid.cell_activity();
  const Buffer<float>& places = fluid.particles().position;
  const Buffer<SolveState>& state = state_[number];
  const std::size_t items = fluid.groups();
  const auto dt = static_cast<float>(step.dt);
  const auto [least, most] = kIterations[number];
  double t = 1.0;  // Nesterov's sequence
  for (int k = 0; k < most; ++k) {
    const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    const auto beta = static_cast<float>((t - 1.0) / next);
    t = next;
    correct_pressure_.run(queue, items,
                          {{"p", params},
                           {"k", k},
                           {"state", state},
                           {"beta", beta},
                           {"dt", dt},
                           {"cell_start", cells},
                           {"activity", activity},
                           {"position", places},
                           {"velocity", guess_},
                           {"gradient", gradient_},
                           {"response", response_},
                           {"boundary_rate", boundary_rate_},
                           {"offset", offset_},
                           {"pressure", pressure},
                           {"jacobi", jacobi_},
                           {"change", change_},
                           {"error_part", error_part_}});
    judge_solve_.run_teams(queue, 1,
                           {{"p", params},
                            {"parts", static_cast<int>(error_parts_)},
                            {"k", k},
                            {"least", least},
                            {"most", most},
                            {"error_part", error_part_},
                            {"state", state}});
    push_by_pressure_.run(queue, items,
                          {{"p", params},
                           {"k", k},
                           {"state", state},
                           {"dt", dt},
                           {"cell_start", cells},
                           {"activity", activity},
                           {"position", places},
                           {"gradient", gradient_},
                           {"change", change_},
                           {"pressure", pressure},
                           {"velocity", guess_}});
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
