// SPDX-License-Identifier: MIT
#include "sim-server/gauge/cavity.hpp"

#include <algorithm>

#include "sim-server/fluid/air/air_cells.hpp"

namespace splash::sim {

Cavity find_cavity(std::span<const Vector3> points, const WaterState& water, const Vector3& lower,
                   const Vector3& upper, const std::function<bool(const Vector3&)>& solid) {
  AirCells cells(lower, upper, water.spacing, water.support);
  for (const Vector3& point : points) cells.add(point, water.volume());
  cells.fill(solid);
  Cavity cavity;
  cavity.open = cells.open();
  for (const double pocket : cells.pockets()) {
    cavity.enclosed += pocket;
    cavity.pocket = std::max(cavity.pocket, pocket);
  }
  return cavity;
}

}  // namespace splash::sim
