// SPDX-License-Identifier: MIT
#include "tests/sim-server/fluid/grid_projected_reference.hpp"

#include <algorithm>
#include <cmath>

namespace splash::sim {
namespace {

constexpr double kLight = 1.0e-6;
constexpr double kFull = 0.5;

/// Where in the hat of a cell of this fill the surface is, above its middle [edges].
double surface_above(double fill) {
  const double e = std::clamp(fill - kFull, -0.5, 0.5);
  const double s = 1.0 - std::sqrt(1.0 - 2.0 * std::abs(e));
  return e < 0.0 ? -s : s;
}

double way_to_surface(double water, double air) {
  const double under = surface_above(water);
  const double over = -surface_above(air);
  return std::clamp(under / std::max(under + over, 1.0e-3), 0.1, 1.0);
}

}  // namespace

MacReference::MacReference(const MacGrid& grid)
    : cells_{grid.level[0].nx, grid.level[0].ny, grid.level[0].nz},
      step_{1, grid.level[0].row, grid.level[0].layer},
      lower_(vector(grid.x, grid.y, grid.z)),
      edge_(vector(grid.hx, grid.hy, grid.hz)),
      share_(static_cast<double>(grid.share)) {}

std::size_t MacReference::number(const Cell& cell) const {
  return static_cast<std::size_t>((cell[2] + 1) * step_[2] + (cell[1] + 1) * step_[1] + cell[0] +
                                  1);
}

template <class Visit>
void MacReference::each(const Visit& visit) const {
  for (int k = 0; k <= cells_[2]; ++k) {
    for (int j = 0; j <= cells_[1]; ++j) {
      for (int i = 0; i <= cells_[0]; ++i) visit(Cell{i, j, k}, number({i, j, k}));
    }
  }
}

double MacReference::hat(const Vector3& place, const Cell& cell, std::size_t axis) const {
  double weight = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    double d = (place[a] - lower_[a]) / edge_[a] - cell[a];
    if (a != axis) {
      if (cell[a] == cells_[a]) return 0.0;
      d -= 0.5;
      if (cell[a] == 0) d = std::max(d, 0.0);
      if (a < 2 && cell[a] == cells_[a] - 1) d = std::min(d, 0.0);
    }
    weight *= std::max(1.0 - std::abs(d), 0.0);
  }
  return weight;
}

bool MacReference::is_wall(const Cell& cell, std::size_t axis) const {
  return cell[axis] == 0 || (axis < 2 && cell[axis] == cells_[axis]);
}

ReferenceGathered MacReference::gather(const std::vector<Vector3>& position,
                                       const std::vector<Vector3>& value) const {
  const auto all = static_cast<std::size_t>(step_[2]) * static_cast<std::size_t>(cells_[2] + 2);
  ReferenceGathered g;
  g.fill.assign(all, 0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    g.mean[axis].assign(all, 0.0);
    g.weight[axis].assign(all, 0.0);
  }
  each([&](const Cell& cell, std::size_t c) {
    const bool inside = cell[0] < cells_[0] && cell[1] < cells_[1] && cell[2] < cells_[2];
    for (std::size_t i = 0; i < position.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double w = hat(position[i], cell, axis);
        g.weight[axis][c] += w;
        g.mean[axis][c] += w * value[i][axis];
      }
      if (inside) g.fill[c] += share_ * hat(position[i], cell, 3);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      g.mean[axis][c] = g.weight[axis][c] > kLight ? g.mean[axis][c] / g.weight[axis][c] : 0.0;
    }
  });
  return g;
}

Vector3 MacReference::at(const Vector3& place, const MacFaces& faces, const MacFaces& known,
                         const Vector3& otherwise) const {
  Vector3 sum = {0.0, 0.0, 0.0};
  Vector3 weight = {0.0, 0.0, 0.0};
  each([&](const Cell& cell, std::size_t c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double w = hat(place, cell, axis) * known[axis][c];
      sum[axis] += w * faces[axis][c];
      weight[axis] += w;
    }
  });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum[axis] = weight[axis] > 1.0e-3 ? sum[axis] / weight[axis] : otherwise[axis];
  }
  return sum;
}

MacFaces MacReference::known(const ReferenceGathered& water) const {
  MacFaces known = water.weight;  // 0 beyond the grid
  each([&](const Cell& cell, std::size_t c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto holds = [&](const Cell& at) { return water.fill[number(at)] > kFull; };
      auto below = cell;
      --below[axis];
      bool beside = holds(cell) || holds(below);
      // A wall stops what is within a cell along it from water, too.
      for (std::size_t along = 0; along < 3 && is_wall(cell, axis) && cell[2] < cells_[2];
           ++along) {
        for (const int side : {-1, 1}) {
          if (along == axis) continue;
          auto next = cell, next_below = below;
          next[along] += side;
          next_below[along] += side;
          beside = beside || holds(next) || (axis < 2 && holds(next_below));
        }
      }
      known[axis][c] = water.weight[axis][c] > kLight && beside ? 1.0 : 0.0;
    }
  });
  return known;
}

MacFaces MacReference::sharpened(const ReferenceGathered& water, const MacFaces& known,
                                 const MacFaces& field) const {
  MacFaces sharp = field;
  const auto in_water = [&](Cell cell, std::size_t axis) {
    const std::size_t c = number(cell);
    --cell[axis];
    const std::size_t below = number(cell);
    return water.fill[c] > kFull && water.fill[below] > kFull && known[axis][c] > 0.0;
  };
  each([&](const Cell& cell, std::size_t c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (is_wall(cell, axis) || !in_water(cell, axis)) continue;
      for (std::size_t along = 0; along < 3; ++along) {
        for (const int side : {-1, 1}) {
          auto next = cell;
          next[along] += side;
          const std::size_t n = number(next);
          const double part = std::min(1.0, water.weight[axis][n] / water.weight[axis][c]);
          if (along == axis && is_wall(next, axis)) {
            sharp[axis][c] += field[axis][c] / 6.0;
          } else if (in_water(next, axis)) {
            sharp[axis][c] += part * (field[axis][c] - field[axis][n]) / 6.0;
          }
        }
      }
    }
  });
  return sharp;
}

MacFaces MacReference::change(const ReferenceGathered& water, const FluidParams& params,
                              const MacField& pressure, double dt) const {
  const Vector3 gravity = vector(params.gravity_x, params.gravity_y, params.gravity_z);
  const double nu = 0.1 * static_cast<double>(params.viscous);
  const double rho = static_cast<double>(params.rest_density);
  MacFaces change = water.mean;
  each([&](const Cell& cell, std::size_t c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const MacField& u = water.mean[axis];
      if (is_wall(cell, axis)) {
        change[axis][c] = -u[c];
        continue;
      }
      double rub = 0.0;
      for (std::size_t other = 0; other < 3; ++other) {
        const auto s = static_cast<std::size_t>(step_[other]);
        for (const std::size_t n : {c + s, c - s}) {
          if (water.weight[axis][n] > kLight && water.weight[axis][c] > kLight) {
            rub += (u[n] - u[c]) / (edge_[other] * edge_[other]);
          }
        }
      }
      const auto below = c - static_cast<std::size_t>(step_[axis]);
      const bool here = water.fill[c] > kFull;
      const bool there = water.fill[below] > kFull;
      double slope = 0.0;
      if (here && there) slope = pressure[c] - pressure[below];
      if (here && !there) slope = pressure[c] / way_to_surface(water.fill[c], water.fill[below]);
      if (!here && there)
        slope = -pressure[below] / way_to_surface(water.fill[below], water.fill[c]);
      change[axis][c] = dt * (gravity[axis] + nu * rub - slope / (rho * edge_[axis]));
    }
  });
  return change;
}

MacFaces MacReference::shared(const ReferenceGathered& water, const MacFaces& change) const {
  MacFaces shared = change;
  const MacField& fill = water.fill;
  each([&](const Cell& cell, std::size_t c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto step = static_cast<std::size_t>(step_[axis]);
      const std::size_t below = c - step;
      if (is_wall(cell, axis) || (fill[c] > kFull) == (fill[below] > kFull)) continue;
      const bool here = fill[c] > kFull;
      const std::size_t deep = here ? c + step : below - step;
      const std::size_t next = here ? c + step : below;  // face
      if (!(fill[deep] > kFull)) continue;
      const double way =
          here ? way_to_surface(fill[c], fill[below]) : way_to_surface(fill[below], fill[c]);
      const double part = std::min(1.0, way / (share_ * water.weight[axis][c]));
      shared[axis][c] = part * change[axis][c] + (1.0 - part) * change[axis][next];
    }
  });
  return shared;
}

MacField MacReference::left(const ReferenceGathered& water, const MacFaces& velocity) const {
  MacField left(water.fill.size(), 0.0);
  each([&](const Cell& cell, std::size_t c) {
    if (!(water.fill[c] > kFull)) return;
    double out = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto above = c + static_cast<std::size_t>(step_[axis]);
      Cell next = cell;
      ++next[axis];
      const double low = is_wall(cell, axis) ? 0.0 : velocity[axis][c];
      const double high = is_wall(next, axis) ? 0.0 : velocity[axis][above];
      out += (high - low) / edge_[axis];
    }
    bool inner = true;
    for (int z = std::max(cell[2] - 1, 0); z <= cell[2] + 1; ++z) {
      for (int y = std::max(cell[1] - 1, 0); y <= std::min(cell[1] + 1, cells_[1] - 1); ++y) {
        for (int x = std::max(cell[0] - 1, 0); x <= std::min(cell[0] + 1, cells_[0] - 1); ++x) {
          inner = inner && water.fill[number({x, y, z})] > kFull;
        }
      }
    }
    const double contracts = inner ? std::clamp(1.0 - water.fill[c], 0.0, 0.2) : 0.0;
    left[c] = out + contracts;
  });
  return left;
}

}  // namespace splash::sim
