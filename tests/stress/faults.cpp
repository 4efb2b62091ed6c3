// SPDX-License-Identifier: MIT
#include "tests/stress/faults.hpp"

#include <algorithm>
#include <cmath>

namespace splash::stress {
namespace {

constexpr int kFramesBetween = 4;  ///< sound frames before the next fault, at least

bool all_finite(const sim::Snapshot& state, const sim::FluidParams& params) {
  const auto stride = static_cast<std::size_t>(params.capacity);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < state.id.size(); ++i) {
      if (!std::isfinite(state.position[axis * stride + i])) return false;
      if (!std::isfinite(state.velocity[axis * stride + i])) return false;
    }
  }
  return true;
}

/// Does one harm in the coming frame, in its step `wanted`.
class Saboteur {
 public:
  Saboteur(const Injection& injection, int wanted, int place)
      : injection_(injection), wanted_(wanted), place_(place) {}
  void operator()(sim::Fluid& fluid, sim::Step& step, sim::Moment moment) {
    const bool now = step_ == wanted_ && moment == injection_.moment;
    if (moment == sim::Moment::between) ++step_;
    if (now) injection_.harm(fluid, step, place_);
  }

 private:
  Injection injection_;
  int wanted_;
  int place_;
  int step_ = 0;
};

Outcome observe(sim::Simulation& simulation, const Injection& injection, int step, int place) {
  Outcome outcome;
  outcome.fault = injection.name;
  outcome.place = place;
  simulation.set_hook(Saboteur(injection, step, place));
  const double start = simulation.seconds();
  const std::int64_t before = simulation.totals().steps;
  for (int k = 0; k <= kFramesBetween; ++k) {
    const sim::FrameResult frame = simulation.advance();
    outcome.told += tests::count_of(frame.found);
    if (!frame.step_fault) continue;
    outcome.seen = outcome.seen || (k == 0 && frame.step_fault->step == before + step);
    outcome.sentence = describe(*frame.step_fault);
    if (frame.step_fault->remedy != sim::Remedy::retry) {
      outcome.ill_for = simulation.seconds() - start;
      k = 0;  // until it is well again
    }
    if (outcome.ill_for > 1.0) break;
  }
  simulation.set_hook({});
  outcome.finite = all_finite(simulation.fluid().snapshot(), simulation.fluid().params());
  return outcome;
}

}  // namespace

sim::Scene still_scene(sim::PressureKind solver, double factor) {
  sim::Scene scene;
  scene.name = "still";
  scene.fluid.spacing = 0.03;
  scene.fluid.solver = solver;
  scene.fluid.time_step_factor = factor;
  scene.tank.lower = {0.0, 0.0, 0.0};
  scene.tank.upper = {0.24, 0.24, 0.5};
  scene.water = {{{0.0, 0.0, 0.0}, {0.24, 0.24, 0.18}}};
  sim::BodySettings ball;
  ball.name = "ball";
  ball.shape = {.kind = sim::ShapeKind::sphere, .size = {0.1, 0.1, 0.1}};
  ball.rest.position = {0.12, 0.12, 0.4};
  scene.bodies = {ball};
  scene.skip.sleep = false;  // or nothing would be computed
  return scene;
}

std::vector<Outcome> run_faults(sim::Simulation& simulation, const std::vector<Injection>& faults,
                                int places, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int end) {
    return static_cast<int>(random() % static_cast<unsigned>(end));
  };
  std::vector<Outcome> outcomes;
  for (const Injection& injection : faults) {
    for (int k = 0; k < places; ++k) {
      // One at least: what a step began with is compared with the end of the one before.
      const int quiet = 1 + below(3);
      for (int frame = 0; frame < quiet; ++frame) static_cast<void>(simulation.advance());
      const double frame = 1.0 / simulation.scene().serve.frame_rate;
      const int steps = std::max(1, static_cast<int>(frame / simulation.time_step()));
      const int step = below(steps);
      outcomes.push_back(observe(simulation, injection, step, below(simulation.particles())));
    }
  }
  return outcomes;
}

}  // namespace splash::stress
