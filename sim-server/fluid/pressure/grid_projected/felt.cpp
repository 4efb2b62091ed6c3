// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/felt.hpp"

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {
namespace {

/// Iterations of a solve for an answer to a body, at most: the error of a derivative is of the
/// order of the solution's error squared (felt.cl).
constexpr int kAnswerIterations = 4;

}  // namespace

FeltForces::FeltForces(Device& device, const cl::Program& program, const MacFields& fields,
                       const GridSolids& solids, CoupledBodies& bodies, PressureSystem& system)
    : fields_(fields),
      solids_(solids),
      bodies_(bodies),
      system_(system),
      given_(device, program, fields, solids, system),
      grip_(device, 1),
      answer_(device, 1),
      answer_state_(device, 1),
      weigh_pressure_(program, "weigh_pressure", fields.team),
      ask_for_answer_(program, "ask_for_answer") {}

void FeltForces::feel(Device& device, bool on) {
  feels_ = on && solids_.any();
  if (!feels_ || answer_.size() == fields_.room) return;
  grip_ = Buffer<float>(device, 6 * fields_.room);
  answer_ = Buffer<float>(device, fields_.room);
  given_.make_room(device);
}

void FeltForces::add(const FeltBodies& felt) {
  if (feels_) now_.emplace(felt);
}

void FeltForces::weigh(Fluid& fluid, const Step& step) {
  if (!now_) return;
  const int count = static_cast<int>(now_->list.size());
  bodies_.find_grip(fluid, step, count, now_->on_device, grip_);
  weigh_pressure(fluid, step, system_.found());
  given_.weigh(fluid, step, *now_, system_.found());
  for (int k = 0; k < count; ++k) {
    const bool rates = now_->wanted[static_cast<std::size_t>(k)];
    for (int part = 0; rates && part < 6; ++part) weigh_answer(fluid, step, k, part);
    weigh_answer(fluid, step, k, SPLASH_BY_FLOW);
  }
  now_.reset();
}

void FeltForces::weigh_answer(Fluid& fluid, const Step& step, int k, int part) {
  cl::CommandQueue& queue = fluid.device().queue();
  ask_for_answer_.run(queue, fields_.cells,
                      {{"g", fields_.on_device},
                       {"k", k},
                       {"part", part},
                       {"dt", static_cast<float>(step.dt)},
                       {"felt", now_->on_device},
                       {"owner", solids_.owner()},
                       {"gap", solids_.gap()},
                       {"mean", fields_.carries},
                       {"grip", grip_},
                       {"start", answer_}},
                      system_.unknowns(), fluid.boundary().steps_at(step));
  system_.solve_again(fluid, step, kAnswerIterations, true, answer_, answer_state_);
  if (part != SPLASH_BY_FLOW) weigh_pressure(fluid, step, answer_, k, part);
  given_.weigh(fluid, step, *now_, answer_, k, part);
}

void FeltForces::weigh_pressure(Fluid& fluid, const Step& step, const Buffer<float>& found,
                                int only, int part) {
  weigh_pressure_.run_teams(fluid.device().queue(), 1,
                            {{"only", only},
                             {"part", part},
                             {"body_count", static_cast<int>(now_->list.size())},
                             {"felt", now_->on_device},
                             {"owner", solids_.owner()},
                             {"grip", grip_},
                             {"found", found},
                             {"sums", now_->sums}},
                            fluid.boundary().steps_at(step), fields_.args(fluid));
}

}  // namespace splash::sim
