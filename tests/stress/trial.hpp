// SPDX-License-Identifier: MIT
// One thing that water must survive, and whether it did.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim-server/simulation/simulation.hpp"

namespace splash::stress {

/// What happens from outside before each frame.
using Drive = std::function<void(sim::Simulation&)>;

struct Trial {
  int group = 0;  ///< of the list of thirteen (README.md); 0: what users of other solvers reported
  std::string name;
  double seconds = 1.0;
  double speed = 1.0;     ///< the fastest that anything is meant to get [m/s]
  bool still = false;     ///< nothing moves: the water, none of it asleep, must be calm at the end
  bool slams = false;     ///< all of it lands flat and at once
  bool stands = false;    ///< no free body may fall, not by the rounding of its edges
  bool harmed = false;    ///< faults are put in: steps may be computed again
  bool turnover = false;  ///< bubbles end as fast as they begin: there is always room for more
  double finest = 0.0;    ///< with finer water it takes hours and is left out [m]
  std::function<sim::Scene(double spacing)> scene;
  std::function<Drive()> drive = {};  ///< a fresh one for each run
};

/// All of them, group by group.
[[nodiscard]] std::vector<Trial> all_trials();
/// Throws std::logic_error when there is none of that name.
[[nodiscard]] const Trial& trial_named(const std::string& name);

struct Settings {
  sim::PressureKind solver = sim::PressureKind::weakly_compressible;
  double spacing = 0.05;  ///< [m]
  double factor = 1.0;    ///< of the time step
  bool stiff = false;     ///< sound stays as fast as it is at 1, which no scene file may ask for
};

struct Verdict {
  std::vector<std::string> broken;  ///< invariants that did not hold; empty: passed
  int particles = 0;
  std::int64_t steps = 0;
  double fastest = 0.0;       ///< [m/s]
  double fastest_body = 0.0;  ///< of those that the water moves [m/s]
  double mean_excess = 0.0;   ///< largest in time [1]
  double max_excess = 0.0;    ///< [1]
  double calm = 0.0;          ///< median of the fastest in the last second [m/s]
  double drift = 0.0;         ///< by which the mean height has changed at the end [m]
  double inside = 0.0;        ///< depth of the deepest particle in a body, at the end [spacings]
  std::uint64_t events = 0;
  std::uint64_t retried = 0;
  std::uint64_t calmed = 0;
  std::uint64_t resets = 0;
  double least_step = 0.0;  ///< shortest step in the first one's [1]
  std::string step_fault;   ///< the first, in words
  [[nodiscard]] bool passes() const { return broken.empty(); }
};

/// `seconds`: another duration than the trial's, 0: its own.
[[nodiscard]] Verdict run_trial(sim::Device& device, const Trial& trial, const Settings& settings,
                                double seconds = 0.0);

// Where the particles are: all of them in the tank, none in a body, as high in the mean as they
// were.

/// Every particle is there once, has finite numbers and is not behind a wall of the tank.
[[nodiscard]] bool nobody_lost(sim::Simulation& simulation);

/// How deep below a body's surface the deepest particle is, with the bodies where they are now [m];
/// 0: none is in any.
[[nodiscard]] double deepest_inside(sim::Simulation& simulation);

/// Of all particles [m].
[[nodiscard]] double mean_height(sim::Simulation& simulation);

}  // namespace splash::stress
