// SPDX-License-Identifier: MIT
// The detectors' kernels once more, in double precision and by brute force: every point against
// every other, no grid, no lanes, no boxes. They start from the floats the device holds.
#pragma once

#include <vector>

#include "tests/sim-server/fluid/reference.hpp"

namespace splash::sim {

/// What a point sees of the water (paper, section 5.1.2). The scales are sums of the magnitudes of
/// all terms: rounding is relative to these.
struct ReferenceTouch {
  double colour = 0.0;                 ///< c_f [1]
  double all_colour = 0.0;             ///< of spray, too [1]
  Vector3 gradient = {0.0, 0.0, 0.0};  ///< [1/m]
  Vector3 water = {0.0, 0.0, 0.0};     ///< mean velocity [m/s]
  double gradient_scale = 0.0;         ///< [1/m]
  int seen = 0;                        ///< particles within reach that are water
  int passed_over = 0;                 ///< particles within reach that are spray
};
/// `water_density`: of each particle without the bodies' part [kg/m3].
[[nodiscard]] ReferenceTouch reference_touch(const FluidState& state,
                                             const std::vector<float>& water_density,
                                             const Vector3& place);

/// sum_j W rho_j / sum_j W at a particle [kg/m3].
[[nodiscard]] double reference_mean_density(const FluidState& state,
                                            const std::vector<float>& water_density, std::size_t i);

/// Matter at a place: colour of all water and of the walls' solid, at most 1; 1 inside a wall [1].
[[nodiscard]] double reference_matter(const FluidState& state, const Vector3& place);

/// A number, and the sum of the magnitudes of all terms it is the sum of.
struct ReferenceSum {
  double value = 0.0;
  double scale = 0.0;
};
/// Vertical colour gradient of fluid, bodies, bubbles and walls, in that of a flat surface,
/// 3 / (2 H) (paper, eq. 2) [1].
[[nodiscard]] ReferenceSum reference_upward(const FluidState& state,
                                            const std::vector<Vector3>& bubbles,
                                            const Vector3& place);

/// What decides of the air that a particle folds in (air_fold.cl).
struct ReferenceEddies {
  double energy = 0.0;  ///< k [m2/s2]
  double air = 0.0;     ///< share of its surroundings [1]
};
[[nodiscard]] ReferenceEddies reference_eddies(const FluidState& state, std::size_t i,
                                               double reach);

/// Mean velocity of all water within reach, none: zero [m/s].
[[nodiscard]] Vector3 reference_water_velocity(const FluidState& state, const Vector3& place);

/// Colour of the other bubbles at bubble `i` [1].
[[nodiscard]] double reference_bubble_colour(const FluidParams& params,
                                             const std::vector<Vector3>& bubbles, std::size_t i);

/// Places as the device holds them.
[[nodiscard]] std::vector<Vector3> as_floats(std::vector<Vector3> places);

/// The group of each point by union-find: the smallest index among all points that a chain of
/// steps shorter than `reach` leads to; -1: the group has no seed.
[[nodiscard]] std::vector<int> reference_groups(const std::vector<Vector3>& places, double reach,
                                                const std::vector<bool>& seed);

}  // namespace splash::sim
