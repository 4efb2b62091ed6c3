// SPDX-License-Identifier: MIT
// Pins water that nothing supports to its place while the rest comes to rest, until time begins.
#pragma once

#include <vector>

#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

class PinnedParticles {
 public:
  /// `kept`: for each particle by its id whether it is pinned. It stays where it is now.
  /// Waits.
  PinnedParticles(Fluid& fluid, const std::vector<bool>& kept);

  [[nodiscard]] bool is_empty() const noexcept { return kept_count_ == 0; }
  [[nodiscard]] bool has_all() const noexcept { return kept_count_ == particles_; }
  /// After each step: enqueues what brings all that it keeps to its place, at rest.
  void restore();

 private:
  Fluid& fluid_;
  std::size_t particles_ = 0;
  std::size_t kept_count_ = 0;
  Buffer<int> kept_;
  Buffer<float> place_;  ///< by id, axis after axis [m]
  Kernel put_back_;
};

}  // namespace splash::sim
