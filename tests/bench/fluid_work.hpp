// SPDX-License-Identifier: MIT
// What a step of a block of water asks of a device, counted from where its particles are.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/bench/fluid_block.hpp"

namespace splash::bench {

/// Where the particles are, as the kernels see them.
struct Places {
  sim::FluidParams params = {};
  std::vector<float> position;  ///< x, y, z parts
  std::vector<int> cell_start;
  std::vector<int> source;  ///< of each, before the sort
  int used = 0;             ///< cells up to the last that has a particle
};

/// After a sort. The queue is finished.
[[nodiscard]] Places places_of(sim::Device& device, Block& block);

/// What the search around all particles meets (neighbours/near.h).
struct Met {
  double tested = 0.0;   ///< points held against a group's box, a vector at a time
  double visited = 0.0;  ///< pairs whose formula is computed
  double turns = 0.0;    ///< searches of the nine runs around some particles of a row
};

/// With `lanes` particles to a work-item.
[[nodiscard]] Met meet_all(const Places& places, int lanes);

/// Points that the sort of CPUs moves one by one, since not all of their vector stay together.
[[nodiscard]] double moved_alone(const Places& places, const sim::Profile& profile);

/// Of a kernel in a step.
struct Work {
  double bytes = 0.0;
  double operations = 0.0;  ///< of all lanes; two to a fused one
  double scalar = 0.0;      ///< instructions that a CPU does one by one beside its vectors
  double counts = 0.0;      ///< of a histogram, by one work-item for many points
  double runs = 0.0;        ///< of points, looked up and gone through
};

/// Of all kernels that a step of a cube runs, with either sort (cell_count.cl, cell_rank.cl): bytes
/// as if every array went through memory once, operations of the formulas. What is scalar on a CPU
/// is an operation on a GPU, an instruction as dear as a fused one.
[[nodiscard]] std::map<std::string, Work> work_of(const Places& places,
                                                  const sim::Profile& profile);

}  // namespace splash::bench
