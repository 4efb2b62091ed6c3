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
  int used = 0;  ///< cells up to the last that has a particle
};

/// After a sort. The queue is finished.
[[nodiscard]] Places places_of(sim::Device& device, Block& block);

/// What the search around all particles meets (kernels/near.h).
struct Met {
  double tested = 0.0;   ///< points held against a group's box, a vector at a time
  double visited = 0.0;  ///< pairs whose formula is computed
};

/// With `lanes` particles to a work-item.
[[nodiscard]] Met meet_all(const Places& places, int lanes);

/// Of a kernel in a step.
struct Work {
  double bytes = 0.0;
  double operations = 0.0;
};

/// Of all kernels that a step of a cube runs, with either sort (cell_count.cl, cell_rank.cl): bytes
/// as if every array went through memory once, operations of the formulas.
[[nodiscard]] std::map<std::string, Work> work_of(const Places& places,
                                                  const sim::Profile& profile);

}  // namespace splash::bench
