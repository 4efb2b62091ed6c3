// SPDX-License-Identifier: MIT
// The grid of the grid-projected solver once more, in double precision and by brute force: every
// particle against every face.
#pragma once

#include <array>
#include <vector>

#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "tests/sim-server/fluid/reference.hpp"

namespace splash::sim {

/// Of all cells of the finest level, by their numbers.
using MacField = std::vector<double>;
using MacFaces = std::array<MacField, 3>;  ///< of each cell's lower face along x, y, z

struct ReferenceGathered {
  MacFaces mean;
  MacFaces weight;  ///< [particles]
  MacField fill;    ///< [1]
};

[[nodiscard]] inline const GridProjected& solver_of(const Fluid& fluid) {
  return dynamic_cast<const GridProjected&>(fluid.solver());
}

class MacReference {
 public:
  using Cell = std::array<int, 3>;

  explicit MacReference(const MacGrid& grid);

  [[nodiscard]] ReferenceGathered gather(const std::vector<Vector3>& position,
                                         const std::vector<Vector3>& value) const;
  /// Of the faces around a place, by the hat; those alone that `known` says.
  [[nodiscard]] Vector3 at(const Vector3& place, const MacFaces& faces, const MacFaces& known,
                           const Vector3& otherwise) const;
  /// Which faces a solve finds: those beside a cell with water.
  [[nodiscard]] MacFaces known(const ReferenceGathered& water) const;
  /// A field on faces, sharpened where it is in the water and `known`.
  [[nodiscard]] MacFaces sharpened(const ReferenceGathered& water, const MacFaces& known,
                                   const MacFaces& field) const;
  /// What the step changes at faces: gravity, viscosity `nu`, and pressures in Pa.
  [[nodiscard]] MacFaces change(const ReferenceGathered& water, const FluidParams& params,
                                const MacField& pressure, double dt) const;
  /// What of these changes particles get: at the surface those beyond the mass that pressure moves
  /// go with the next face in the water.
  [[nodiscard]] MacFaces shared(const ReferenceGathered& water, const MacFaces& change) const;
  /// In cells with water what is left to demand of these velocities, 0 in others [1/s].
  [[nodiscard]] MacField left(const ReferenceGathered& water, const MacFaces& velocity) const;

  [[nodiscard]] std::size_t number(const Cell& cell) const;

 private:
  /// Weight of a place for one of a cell's three lower faces, or for its middle (axis 3).
  [[nodiscard]] double hat(const Vector3& place, const Cell& cell, std::size_t axis) const;
  [[nodiscard]] bool is_wall(const Cell& cell, std::size_t axis) const;
  template <class Visit>
  void each(const Visit& visit) const;

  Cell cells_;
  std::array<int, 3> step_;  ///< to the next cell along each axis
  Vector3 lower_;
  Vector3 edge_;
  double share_;
};

}  // namespace splash::sim
