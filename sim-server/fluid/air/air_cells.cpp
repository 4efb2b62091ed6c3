// SPDX-License-Identifier: MIT
#include "sim-server/fluid/air/air_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// Appends the images of all points near the plane where `axis` is `wall`; the water is on the side
/// of `sign`.
void mirror(std::vector<Vector3>& points, std::size_t first, std::size_t last, std::size_t axis,
            double wall, double reach, double sign) {
  for (std::size_t i = first; i < last; ++i) {
    const double distance = sign * (points[i][axis] - wall);
    if (distance < 0.0 || distance >= reach) continue;
    Vector3 image = points[i];
    image[axis] = wall - sign * distance;
    points.push_back(image);
  }
}

}  // namespace

std::vector<Vector3> with_images(std::vector<Vector3> points, const Tank& tank, double reach) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t count = points.size();
    mirror(points, 0, count, axis, tank.lower[axis], reach, 1.0);
    if (axis < 2) mirror(points, 0, count, axis, tank.upper[axis], reach, -1.0);
  }
  return points;
}

AirCells::AirCells(const Vector3& lower, const Vector3& upper, double spacing, double support)
    : kernel_(support), support_(support), lower_(lower), volume_(1.0) {
  std::size_t cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double layers = std::max(std::round((upper[axis] - lower[axis]) / spacing), 1.0);
    count_[axis] = static_cast<int>(layers);
    edge_[axis] = (upper[axis] - lower[axis]) / layers;
    volume_ *= edge_[axis];
    cells *= static_cast<std::size_t>(count_[axis]);
  }
  colour_.resize(cells);
  cells_.resize(cells, Cell::matter);
}

Vector3 AirCells::middle(const Index& cell) const {
  Vector3 place = lower_;
  for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += (cell[axis] + 0.5) * edge_[axis];
  return place;
}

/// Cells whose middles are within the support of `x` along an axis: first, and one past the last.
std::array<int, 2> AirCells::range(std::size_t axis, double x) const {
  const double at = (x - lower_[axis]) / edge_[axis] - 0.5;
  const double by = support_ / edge_[axis];
  const double last = count_[axis];
  return {static_cast<int>(std::clamp(std::ceil(at - by), 0.0, last)),
          static_cast<int>(std::clamp(std::floor(at + by) + 1.0, 0.0, last))};
}

void AirCells::add(const Vector3& place, double volume) {
  const auto [i0, i1] = range(0, place[0]);
  const auto [j0, j1] = range(1, place[1]);
  const auto [k0, k1] = range(2, place[2]);
  for (int k = k0; k < k1; ++k) {
    for (int j = j0; j < j1; ++j) {
      const Vector3 first = middle({i0, j, k}) - place;
      const double across2 = first[1] * first[1] + first[2] * first[2];
      double* const row = &colour_[number({0, j, k})];
      for (int i = i0; i < i1; ++i) {
        const double x = first[0] + (i - i0) * edge_[0];
        row[i] += volume * kernel_.of_square(x * x + across2);
      }
    }
  }
}

template <class Visit>
void AirCells::for_each_cell(const Visit& visit) const {
  for (int k = 0; k < count_[2]; ++k) {
    for (int j = 0; j < count_[1]; ++j) {
      for (int i = 0; i < count_[0]; ++i) visit(Index{i, j, k});
    }
  }
}

void AirCells::fill(const std::function<bool(const Vector3&)>& solid) {
  for_each_cell([&](const Index& cell) {
    const std::size_t n = number(cell);
    if (colour_[n] < 0.5 && !solid(middle(cell))) cells_[n] = Cell::air;
  });
  for_each_cell([&](const Index& cell) {
    if (cell[2] == count_[2] - 1) open_ += join(cell, Cell::open);
  });
  for_each_cell([&](const Index& cell) {
    const std::size_t joined = join(cell, Cell::enclosed);
    if (joined > 0) pockets_.push_back(static_cast<double>(joined) * volume_);
  });
}

bool AirCells::any_open(const std::function<bool(const Vector3&)>& is_such) const {
  bool any = false;
  for_each_cell([&](const Index& cell) {
    any = any || (cells_[number(cell)] == Cell::open && is_such(middle(cell)));
  });
  return any;
}

/// Of those that share a face with it.
template <class Visit>
void AirCells::for_each_beside(const Index& cell, const Visit& visit) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      Index beside = cell;
      beside[axis] += step;
      if (beside[axis] >= 0 && beside[axis] < count_[axis]) visit(beside);
    }
  }
}

std::size_t AirCells::join(const Index& first, Cell what) {
  std::vector<Index> joined;
  const auto visit = [&](const Index& cell) {
    Cell& here = cells_[number(cell)];
    if (here != Cell::air) return;
    here = what;
    joined.push_back(cell);
  };
  visit(first);
  for (std::size_t next = 0; next < joined.size(); ++next) {
    const Index cell = joined[next];
    for_each_beside(cell, visit);
  }
  return joined.size();
}

}  // namespace splash::sim
