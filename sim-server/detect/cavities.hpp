// SPDX-License-Identifier: MIT
// The main cavity by the paper's rule (section 5.3.2): bubbles surrounded by bubbles are found by
// their colour field c_b, the group around them by an iterative neighbour search on the device, and
// their number is mapped to the radius of one sphere. A cavity is told once: a group that holds
// bubbles of a known cavity is that cavity. What a scene has without this rule: pockets.hpp.
#pragma once

#include <vector>

#include "sim-server/detect/bubbles.hpp"

namespace splash::sim {

/// N_b to radius, linearly between the scene's bounds [m].
[[nodiscard]] double cavity_radius(int bubbles, const DetectSettings& settings);

/// Gives each group its cavity: `label[i]`: the group of pool bubble i, -1: none. Marks the pool's
/// bubbles and returns the groups that are new cavities. `next_cavity` counts cavities.
[[nodiscard]] std::vector<DetectedCavity> name_cavities(std::vector<PoolBubble>& pool,
                                                        const std::vector<int>& label, double time,
                                                        const DetectSettings& settings,
                                                        int& next_cavity);

class Cavities {
 public:
  Cavities(Fluid& fluid, const cl::Program& program, const DetectSettings& settings,
           std::size_t room, bool search_always = false);

  /// Searches among the bubbles that were carried; before they are renewed.
  [[nodiscard]] std::vector<DetectedCavity> search(double time, Bubbles& bubbles);
  void set(const DetectSettings& settings) { settings_ = settings; }
  /// Searches that were worth it so far.
  [[nodiscard]] std::uint64_t searches() const noexcept { return searches_; }
  /// Rounds of the longest search so far.
  [[nodiscard]] int rounds() const noexcept { return rounds_; }

  /// Groups among bubbles that need not be enough for a search, for nobody.
  void rehearse(const Bubbles& bubbles) { static_cast<void>(grow(bubbles)); }

 private:
  [[nodiscard]] std::vector<int> grow(const Bubbles& bubbles);

  Fluid& fluid_;
  DetectSettings settings_;
  int next_cavity_ = 0;
  int rounds_ = 0;
  bool search_always_ = false;
  std::uint64_t searches_ = 0;
  Buffer<int> label_;
  Buffer<int> grown_;
  Buffer<int> changed_;
  Kernel seed_cavities_;
  Kernel grow_cavities_;
};

}  // namespace splash::sim
