// SPDX-License-Identifier: MIT
// Faults put into a running simulation, through the device's own buffers: what broken memory, a
// broken kernel or a broken time step would do.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "sim-server/simulation/simulation.hpp"

namespace splash::stress {

/// Does its harm once, to the particle at `place` of the sorted arrays.
struct Injection {
  std::string name;
  sim::Moment moment = sim::Moment::before;  ///< of the step
  std::function<void(sim::Fluid&, sim::Step&, int place)> harm;
};

/// Numbers that are none in place, velocity and density, 1e6 m/s, two particles at one place, all
/// of them in one cell, one beyond the tank, a lost one, a step fifty times as long.
[[nodiscard]] std::vector<Injection> injections();

/// For each kind of fault a harm that no other check sees.
struct Single {
  sim::Fault fault;
  Injection injection;
};
[[nodiscard]] std::vector<Single> single_faults();

}  // namespace splash::stress
