// SPDX-License-Identifier: MIT
// The water of a run as it lies at the end of a frame: sums over its particles in double precision.
#pragma once

#include <array>
#include <vector>

#include "sim-server/detect/surface_distance.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/detection/steps.hpp"

namespace splash::detection {

class RunWater {
 public:
  /// `reach`: how far ahead of the skin matter must be to back a blow [m].
  RunWater(sim::Simulation& simulation, double reach);

  /// Skin is wet within a tenth of a spacing, to which the surface is known, and dry beyond
  /// `clear`.
  [[nodiscard]] Water water(double clear) const;

 private:
  /// Share of water at a place [1], and its velocity there.
  struct Seen {
    double colour = 0.0;
    sim::Vector3 velocity = {0.0, 0.0, 0.0};  ///< [m/s]
  };
  [[nodiscard]] Seen see(const sim::Vector3& place) const;
  /// Of water and of what is beyond the tank's walls [1].
  [[nodiscard]] double matter(const sim::Vector3& place) const;
  [[nodiscard]] int cell_along(std::size_t axis, double at) const;

  sim::FluidParams params_;
  sim::Tank tank_;
  double reach_;
  sim::Snapshot state_;
  sim::SurfaceDistance distance_;
  sim::SmoothingKernel kernel_;
  std::array<int, 3> cells_ = {};
  std::vector<int> from_;  ///< of each cell, where its particles begin in list_
  std::vector<int> list_;
};

}  // namespace splash::detection
