// SPDX-License-Identifier: MIT
// What a step of water asks of a device, counted from where its particles and bodies are.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "tests/bench/fluid_block.hpp"

namespace splash::bench {

/// Where the particles are, as the kernels see them.
struct Places {
  sim::FluidParams params = {};
  std::vector<float> position;  ///< x, y, z parts
  std::vector<int> cell_start;
  std::vector<int> source;            ///< of each, before the sort
  int used = 0;                       ///< cells up to the last that has a particle
  std::vector<float> body_position;   ///< of the bodies' points, likewise
  std::vector<int> body_start;        ///< of them, as cell_start
  std::vector<sim::BodyStep> bodies;  ///< in this step
  bool watched = false;               ///< the health of each step is looked at
};

/// Between the halves of `step`. Waits.
[[nodiscard]] Places places_of(sim::Fluid& fluid, const sim::Step& step);
/// After half a step.
[[nodiscard]] Places places_of(Block& block);

/// What the search around all particles meets (neighbours/near.h).
struct Met {
  double tested = 0.0;   ///< points held against a group's box, a vector at a time
  double visited = 0.0;  ///< pairs whose formula is computed
  double turns = 0.0;    ///< searches of the nine runs around some particles of a row
};

/// With `lanes` particles to a work-item.
[[nodiscard]] Met meet_all(const Places& places, int lanes);
/// The bodies' points, by those that are near a body.
[[nodiscard]] Met meet_bodies(const Places& places, int lanes);
/// Pairs of a turn and a wall within its reach.
[[nodiscard]] double meet_walls(const Places& places, int lanes);

/// Points that the sort of CPUs moves one by one, since not all of their vector stay together.
[[nodiscard]] double moved_alone(const Places& places, const sim::Profile& profile);

/// Of all launches of a kernel in a step.
struct Work {
  double launches = 1.0;
  double groups = 0.0;  ///< work-groups
  double bytes = 0.0;
  double operations = 0.0;  ///< of all lanes; two to an instruction
  double scalar = 0.0;      ///< instructions that a CPU does one by one beside its vectors
  double counts = 0.0;      ///< of a histogram, by one work-item for many points
  double runs = 0.0;        ///< of points, looked up and gone through
  double held = 0.0;        ///< particles of vectors that are held against a body one by one

  Work& operator+=(const Work& other);
  [[nodiscard]] Work times(double factor) const;
};

/// What a device can do at most.
struct Limits {
  double bandwidth = 0.0;   ///< [B/s]
  double arithmetic = 0.0;  ///< two to an instruction, fused or not [1/s]
  double scalar = 0.0;      ///< instructions that no vector saves [1/s]
  double counts = 0.0;      ///< of a histogram, one after the other in each work-item [1/s]
  double runs = 0.0;        ///< looked up and gone through, of a length that is not foreseen [1/s]
  double held = 0.0;        ///< particles held against a body one by one; 0: by operations [1/s]
  double groups = 0.0;      ///< work-groups begun; 0: nobody waits for that [1/s]
  double launch = 0.0;      ///< [s]
  double begin = 0.0;  ///< that a launch takes on the device in which there is nothing to do [s]
};

/// Of all launches of a kernel, by the rule at the head of fluid_limits.cpp [s].
[[nodiscard]] double expected(const Work& work, const Limits& limits);

/// A sort of so many points.
struct SortSize {
  double points = 0.0;
  double cells = 0.0;   ///< of the grid
  double used = 0.0;    ///< up to the last that has a point
  double chunks = 0.0;  ///< runs of points that are sorted side by side; 0: by rank
  double alone = 0.0;   ///< points that are moved one by one
};
[[nodiscard]] std::map<std::string, Work> sort_work(const SortSize& size,
                                                    const sim::Profile& profile);

/// Of all kernels that a step runs, with the state equation and bodies that go their way: bytes as
/// if every array went through memory once, operations of the formulas. What is scalar on a CPU is
/// an operation on a GPU, an instruction as dear as a fused one.
[[nodiscard]] std::map<std::string, Work> work_of(const Places& places,
                                                  const sim::Profile& profile);

}  // namespace splash::bench
