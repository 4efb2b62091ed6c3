// SPDX-License-Identifier: MIT
// How far the water's surface is, from how much of it is seen. Water at rest lies in layers one
// spacing apart, the first half a spacing and what the surface packs more densely (kSurfaceLoss)
// below it; at distance D above the surface the colour field is the sum of the layers' planar
// marginals. That sum falls with D, so it can be turned round.
#pragma once

#include <vector>

namespace splash::sim {

class SurfaceDistance {
 public:
  /// `layer_weight`: colour of a layer per planar marginal [m], as in FluidParams.
  SurfaceDistance(double spacing, double support, double layer_weight);

  /// Colour field at distance `d` outside the surface; negative: below it [m].
  [[nodiscard]] double colour_at(double d) const;
  /// Distance for a colour [m]; at most the largest that is seen at all, at least -0.72 spacings
  /// (below, the colour tells distances apart no more).
  [[nodiscard]] double distance_for(double colour) const;
  /// Beyond this distance no water is seen [m].
  [[nodiscard]] double farthest() const noexcept { return farthest_; }
  [[nodiscard]] double spacing() const noexcept { return spacing_; }

 private:
  double spacing_;
  double support_;
  double layer_weight_;
  double depth_;  ///< of a lattice's surface below the water's [m]
  double nearest_;
  double farthest_;
  std::vector<double> colours_;  ///< from nearest_ to farthest_, evenly spaced, falling
};

}  // namespace splash::sim
