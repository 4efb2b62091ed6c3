// SPDX-License-Identifier: MIT
// A cube of water without walls and bodies, and how long something takes.
#pragma once

#include <functional>
#include <vector>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/scene.hpp"
#include "tests/support/median.hpp"

namespace splash::bench {

using tests::median;

/// The value that a tenth of them stay below: what something takes when nobody gets in its way.
[[nodiscard]] double undisturbed(std::vector<double> values);
/// Median of `runs` [s].
[[nodiscard]] double wall_time(const std::function<void()>& work, int runs);
/// User time of all threads so far [s].
[[nodiscard]] double processor_time();

/// About `count` particles at the spacing of the paper's pool, some steps after the lattice, so
/// that no order but that of the sort is left.
struct Block {
  Block(sim::Device& device, int count);
  void move();

  sim::Scene scene;
  sim::FluidParams params;
  sim::Fluid fluid;
  sim::Step step;
};

}  // namespace splash::bench
