// SPDX-License-Identifier: MIT
// The fluid's kernels once more, in double precision and by brute force: every particle against
// every other, no grid, no lanes, no boxes. It starts from the floats the device holds.
#pragma once

#include <vector>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/mesh/distance_field.hpp"

namespace splash::sim {

[[nodiscard]] std::vector<double> read_numbers(Device& device, const Buffer<float>& buffer,
                                               std::size_t count);
/// Of a buffer whose components are `stride` apart.
[[nodiscard]] std::vector<Vector3> read_vectors(Device& device, const Buffer<float>& buffer,
                                                int stride, std::size_t count);

/// What the device holds between Fluid::prepare and Fluid::advance, in the device's order.
struct FluidState {
  FluidParams params = {};
  double piston = 0.0;  ///< offset [m]
  std::vector<int> id;
  std::vector<Vector3> position;      ///< [m]
  std::vector<Vector3> velocity;      ///< [m/s]
  std::vector<double> density;        ///< [kg/m3]
  std::vector<double> peak_density;   ///< [kg/m3]
  std::vector<double> pressure_term;  ///< p / rho^2
  std::vector<Vector3> body_position;
  std::vector<Vector3> body_velocity;
  std::vector<double> body_volume;  ///< [m3]
  std::vector<BodyShape> shapes;
  std::vector<DistanceField> fields;  ///< of the bodies that are meshes, empty of others
  std::vector<BodyStep> bodies;       ///< of the first step
};

/// Call after prepare and before advance.
[[nodiscard]] FluidState read_state(Fluid& fluid, double piston = 0.0);
/// Call after advance: in the order of the state read before it [m/s2].
[[nodiscard]] std::vector<Vector3> read_acceleration(Fluid& fluid);

/// Part of the kernel's weight inside walls, and its gradient [1], [1/m].
struct ReferenceWalls {
  double share = 0.0;
  Vector3 gradient = {0.0, 0.0, 0.0};
};
[[nodiscard]] double wall_distance(const FluidParams& params, int wall, const Vector3& place,
                                   double piston);
[[nodiscard]] ReferenceWalls reference_walls(const FluidParams& params, const Vector3& place,
                                             double piston);

[[nodiscard]] std::vector<double> reference_density(const FluidState& state);
/// The peak density of water of this density that had the peak density `before`, `dt` ago [kg/m3].
[[nodiscard]] double reference_peak_density(const FluidParams& params, double dt, double density,
                                            double before);
/// p / rho^2 from a density and a peak density.
[[nodiscard]] double reference_pressure_term(const FluidParams& params, double density,
                                             double peak);

/// An acceleration, and the sum of the magnitudes of all terms it is the sum of: rounding is
/// relative to these, which nearly cancel in water at rest [m/s2].
struct ReferenceAcceleration {
  Vector3 value = {0.0, 0.0, 0.0};
  double scale = 0.0;
};
/// From the pressure terms of the state.
[[nodiscard]] std::vector<ReferenceAcceleration> reference_acceleration(const FluidState& state);

}  // namespace splash::sim
