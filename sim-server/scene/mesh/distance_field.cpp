// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

int nodes_along(double lower, double upper, double cell, double margin) {
  return static_cast<int>(std::ceil((upper - lower + 2.0 * margin) / cell - 1.0e-9)) + 1;
}

}  // namespace

double field_nodes(const Vector3& lower, const Vector3& upper, double cell, double margin) {
  double all = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all *= nodes_along(lower[axis], upper[axis], cell, margin);
  }
  return all;
}

DistanceField sample_distance(const MeshDistance& distance, const Vector3& lower,
                              const Vector3& upper, double cell, double margin) {
  if (field_nodes(lower, upper, cell, margin) > kFieldNodesMax) {
    throw std::length_error("a distance field of more than 8 million nodes");
  }
  DistanceField field;
  field.cell = cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    field.lower[axis] = lower[axis] - margin;
    field.nodes[axis] = nodes_along(lower[axis], upper[axis], cell, margin);
  }
  field.values.reserve(static_cast<std::size_t>(field_nodes(lower, upper, cell, margin)));
  for (int k = 0; k < field.nodes[2]; ++k) {
    for (int j = 0; j < field.nodes[1]; ++j) {
      double before = std::numeric_limits<double>::infinity();
      for (int i = 0; i < field.nodes[0]; ++i) {
        const Vector3 place =
            field.lower +
            cell * Vector3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        const double here = distance.nearest(place, std::abs(before) + cell).distance;
        field.values.push_back(static_cast<float>(here));
        before = here;
      }
    }
  }
  return field;
}

double DistanceField::at(const Vector3& place) const {
  std::array<std::size_t, 3> node = {};
  Vector3 part = {};
  double beyond2 = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double steps = (place[axis] - lower[axis]) / cell;
    const double kept = std::min(std::max(0.0, steps), nodes[axis] - 1.0);
    beyond2 += (steps - kept) * (steps - kept);
    node[axis] = static_cast<std::size_t>(std::min(std::floor(kept), nodes[axis] - 2.0));
    part[axis] = kept - static_cast<double>(node[axis]);
  }
  const auto row = static_cast<std::size_t>(nodes[0]);
  const std::size_t layer = row * static_cast<std::size_t>(nodes[1]);
  double sum = cell * std::sqrt(beyond2);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::array<std::size_t, 3> up = {corner & 1U, corner >> 1U & 1U, corner >> 2U};
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      weight *= up[axis] != 0 ? part[axis] : 1.0 - part[axis];
    }
    const std::size_t at = node[0] + up[0] + row * (node[1] + up[1]) + layer * (node[2] + up[2]);
    sum += weight * static_cast<double>(values[at]);
  }
  return sum;
}

double DistanceField::error() const {
  return std::sqrt(0.75) * cell;
}

}  // namespace splash::sim
