// SPDX-License-Identifier: MIT
// The invariants are of principle, not tuned to a run: speeds by what the scene puts in, densities
// by the pressures that such speeds and the depth make at this speed of sound.
#include "tests/stress/trial.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim-server/fluid/health/health.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "tests/support/detections.hpp"
#include "tests/support/median.hpp"

namespace splash::stress {
namespace {

using sim::Scene;
using sim::Simulation;

/// Speeds may exceed what is put in by this much: splashes are faster than what makes them.
constexpr double kSplash = 3.0;
/// No step is shorter than this part of the first one for good.
constexpr double kStuck = 0.1;
/// A frame that says more than this has gone mad.
constexpr std::size_t kFlood = 200000;

/// Water that simmers does so all the time; particles that slip into a better place, one after the
/// other, are fast for a third of a second. So the calm of still water is the median over so long
/// at the end [s]: nothing that lasts for half of it is missed.
constexpr double kWatched = 1.0;
/// A still column may sink by this part of its depth as its particles find better places: 2 mm of
/// the basin's 0.2 m, less than a tenth of the finest spacing.
constexpr double kDrift = 0.01;
/// What is deeper in a body than half a spacing collides with it (boundary/keep_out.h): none is,
/// but for the rounding [spacings].
constexpr double kInside = 0.51;

double wave_speed(const Scene& scene) {
  return std::sqrt(sim::length(scene.fluid.gravity) * sim::water_depth(scene));
}

/// What the mean density may exceed rest by: weight, stagnation, and 5 % for the lattice. What
/// `slams` is stopped all at once, at rho c v in place of rho v^2 / 2 (Joukowsky 1898).
double densest_mean(const Scene& scene, double speed, bool slams) {
  const double sound = sim::scene_sound_speed(scene);
  const double weight = wave_speed(scene) / sound;
  const double hit = speed / sound;
  return 0.05 + weight * weight + (slams ? hit : 0.5 * hit * hit);
}

bool is_finite(const sim::Vector3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

/// Counts a frame's events; false if one of them has a number that is none.
bool sound_events(const sim::Detections& found) {
  for (const auto& e : found.impacts) {
    if (!is_finite(e.position) || !std::isfinite(e.speed) || !std::isfinite(e.time)) return false;
  }
  for (const auto& e : found.bubbles) {
    if (!is_finite(e.position) || !(e.radius > 0.0) || !std::isfinite(e.time)) return false;
  }
  for (const auto& e : found.cavities) {
    if (!is_finite(e.position) || !(e.radius > 0.0) || !std::isfinite(e.time)) return false;
  }
  return true;
}

void note(Verdict& verdict, bool holds, const std::string& what) {
  if (holds) return;
  if (std::find(verdict.broken.begin(), verdict.broken.end(), what) == verdict.broken.end()) {
    verdict.broken.push_back(what);
  }
}

double fastest_free_body(const Simulation& simulation) {
  double fastest = 0.0;
  for (std::size_t b = 0; b < simulation.bodies().count(); ++b) {
    if (!simulation.bodies().is_free(b)) continue;
    const sim::BodyState state = simulation.bodies().state(b, simulation.seconds());
    // A speed that is no number counts as one beyond all bounds.
    const double speed = sim::length(state.velocity);
    fastest = std::isfinite(speed) ? std::max(fastest, speed) : HUGE_VAL;
  }
  return fastest;
}

/// Of what has fallen by the rounding of the edges of the thinnest body [m/s].
double fallen_speed(const Scene& scene) {
  double thinnest = HUGE_VAL;
  for (const sim::BodySettings& body : scene.bodies) {
    const sim::Vector3& size = body.shape.size;
    thinnest = std::min({thinnest, size[0], size[1], size[2]});
  }
  const double rounding = static_cast<double>(SPLASH_ROUNDED) * 0.5 * thinnest;
  return std::sqrt(2.0 * sim::length(scene.fluid.gravity) * rounding);
}

void watch(Simulation& simulation, const Drive& drive, double seconds, Verdict& verdict) {
  const double first = simulation.time_step();
  const double height = mean_height(simulation);
  std::vector<double> at_the_end;
  verdict.least_step = 1.0;
  while (simulation.seconds() < seconds) {
    if (drive) drive(simulation);
    const sim::FrameResult frame = simulation.advance();
    const std::size_t events = tests::count_of(frame.found);
    verdict.events += events;
    note(verdict, events < kFlood, "event count");
    note(verdict, sound_events(frame.found), "events finite");
    note(verdict, frame.stats.not_finite == 0, "no NaN");
    verdict.fastest = std::max(verdict.fastest, frame.stats.speed);
    verdict.mean_excess = std::max(verdict.mean_excess, frame.stats.mean_excess);
    verdict.max_excess = std::max(verdict.max_excess, frame.stats.max_excess);
    if (simulation.seconds() > seconds - kWatched) at_the_end.push_back(frame.stats.speed);
    verdict.fastest_body = std::max(verdict.fastest_body, fastest_free_body(simulation));
    verdict.least_step = std::min(verdict.least_step, simulation.time_step() / first);
    if (frame.step_fault && verdict.step_fault.empty())
      verdict.step_fault = describe(*frame.step_fault);
  }
  verdict.calm = tests::median(std::move(at_the_end));
  verdict.drift = mean_height(simulation) - height;
  // The water was put out of where bodies were when the last step began.
  const double way = simulation.bodies().fastest(simulation.seconds()) * simulation.time_step();
  verdict.inside = std::max(deepest_inside(simulation) - way, 0.0) /
                   static_cast<double>(simulation.fluid().params().spacing);
  note(verdict, simulation.time_step() > kStuck * first, "time step not stuck");
}

/// A speed of sound that the scene names becomes as slow as its author would have to make it, or as
/// he may: then steps are longer by less.
void set_steps(const Settings& settings, Scene& scene) {
  if (settings.stiff) scene.fluid.sound_speed = sim::scene_sound_speed(scene);
  scene.fluid.time_step_factor *= settings.factor;
  if (settings.stiff || scene.fluid.sound_speed == 0.0) return;
  const double share = sim::StepPolicy::sound_factor(scene.fluid);
  scene.fluid.sound_speed = std::max(share * scene.fluid.sound_speed, sim::slowest_sound(scene));
  scene.fluid.time_step_factor *= share;
}

}  // namespace

Verdict run_trial(sim::Device& device, const Trial& trial, const Settings& settings,
                  double seconds) {
  Verdict verdict;
  Scene scene = trial.scene(settings.spacing);
  scene.fluid.solver = settings.solver;
  set_steps(settings, scene);
  if (trial.still) scene.skip.sleep = false;  // or there would be nothing to be calm
  try {
    Simulation simulation(device, scene, {});
    // Maps go beyond twice the stable step on purpose: to see what comes of it.
    if (settings.factor > 2.0) {
      simulation.fluid().health().set_checks(sim::without(sim::Fault::step));
    }
    const Drive drive = trial.drive ? trial.drive() : Drive();
    watch(simulation, drive, seconds > 0.0 ? seconds : trial.seconds, verdict);
    verdict.particles = simulation.particles();
    const sim::RunTotals& totals = simulation.totals();
    verdict.steps = totals.steps;
    verdict.retried = totals.retried;
    verdict.calmed = totals.calmed;
    verdict.resets = totals.resets;
    note(verdict, !trial.turnover || totals.bubbles_dropped == 0, "room for bubbles");
    note(verdict, nobody_lost(simulation), "nobody lost");
  } catch (const std::exception& error) {
    verdict.broken.push_back(error.what());
    return verdict;
  }
  const double bound = kSplash * std::max(trial.speed, wave_speed(scene));
  note(verdict, verdict.fastest <= bound, "speed");
  note(verdict, verdict.fastest_body <= bound, "body's speed");
  note(verdict, !trial.stands || verdict.fastest_body <= fallen_speed(scene), "stands");
  note(verdict,
       trial.harmed || verdict.mean_excess <= densest_mean(scene, trial.speed, trial.slams),
       "mean density");
  note(verdict, trial.harmed || verdict.max_excess <= 1.0, "largest density");
  if (trial.still) {
    note(verdict, verdict.calm <= 0.1 * wave_speed(scene), "calm");
    note(verdict, std::abs(verdict.drift) <= kDrift * sim::water_depth(scene), "height kept");
  }
  note(verdict, verdict.inside <= kInside, "no water in a body");
  note(verdict, verdict.calmed + verdict.resets == 0, "nothing given up");
  note(verdict, trial.harmed || verdict.retried <= 3, "hardly a step again");
  return verdict;
}

namespace {

using sim::operator-;

sim::Vector3 place_of(const sim::Snapshot& water, std::size_t stride, std::size_t i) {
  return {static_cast<double>(water.position[i]), static_cast<double>(water.position[stride + i]),
          static_cast<double>(water.position[2 * stride + i])};
}

std::size_t stride_of(sim::Simulation& simulation) {
  return static_cast<std::size_t>(simulation.fluid().params().capacity);
}

}  // namespace

bool nobody_lost(sim::Simulation& simulation) {
  const sim::Snapshot water = simulation.fluid().snapshot();
  const sim::HealthLimits box = sim::health_limits(simulation.fluid().params());
  std::vector<int> ids = water.id;
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] != static_cast<int>(i)) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t at = axis * stride_of(simulation) + i;
      const bool inside =
          water.position[at] >= box.lower[axis] && water.position[at] <= box.upper[axis];
      if (!inside || !std::isfinite(water.velocity[at])) return false;
    }
  }
  return true;
}

double deepest_inside(sim::Simulation& simulation) {
  const sim::Snapshot water = simulation.fluid().snapshot();
  const std::vector<sim::BodySettings>& bodies = simulation.scene().bodies;
  double deepest = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const sim::BodyState now = simulation.bodies().state(b, simulation.seconds());
    for (std::size_t i = 0; i < water.id.size(); ++i) {
      const sim::Vector3 way = place_of(water, stride_of(simulation), i) - now.position;
      const sim::Vector3 own = sim::rotate(sim::inverse(now.rotation), way);
      deepest = std::max(deepest, -sim::distance_to(bodies[b].shape, own));
    }
  }
  return deepest;
}

double mean_height(sim::Simulation& simulation) {
  const sim::Snapshot water = simulation.fluid().snapshot();
  double sum = 0.0;
  for (std::size_t i = 0; i < water.id.size(); ++i) {
    sum += place_of(water, stride_of(simulation), i)[2];
  }
  return sum / static_cast<double>(water.id.size());
}

}  // namespace splash::stress
