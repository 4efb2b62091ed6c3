// SPDX-License-Identifier: MIT
#include "sim-server/bodies/body_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

/// Points with less than this part of an unbounded lattice's colour lie at the surface. A flat
/// face leaves 0.81 of it, two layers deep it is 1.
constexpr double kSurfaceColour = 0.95;

struct BodyLattice {
  std::array<int, 3> count = {1, 1, 1};
  Vector3 step = {0.0, 0.0, 0.0};  ///< [m]
};

/// Whole layers that fill the box: the first and last lie half a step below its faces.
BodyLattice fit_lattice(const Vector3& size, double spacing) {
  BodyLattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double layers = std::ceil(size[axis] / spacing - 1e-9);
    lattice.count[axis] = std::max(static_cast<int>(layers), 1);
    lattice.step[axis] = size[axis] / lattice.count[axis];
  }
  return lattice;
}

double along(const BodyLattice& lattice, std::size_t axis, int k, double size) {
  return (k + 0.5) * lattice.step[axis] - size / 2.0;
}

/// Of the box around a shape, in its own axes [m].
Vector3 middle_of(const Shape& shape) {
  if (shape.kind != ShapeKind::mesh) return {0.0, 0.0, 0.0};
  return 0.5 * (shape.mesh->lower + shape.mesh->upper);
}

double distance(const Vector3& a, const Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The layer that it is in along each axis. A single layer is inside, but for z: it shows its
/// underside.
std::array<int, 3> side_of(const BodyLattice& lattice, const std::array<int, 3>& layer) {
  std::array<int, 3> side = {0, 0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (lattice.count[axis] == 1 && axis != 2) continue;
    if (layer[axis] == lattice.count[axis] - 1) side[axis] = 1;
    if (layer[axis] == 0) side[axis] = -1;
  }
  return side;
}

using LatticeCell = std::array<int, 3>;

LatticeCell cell_of(const Vector3& place, double size) {
  LatticeCell cell = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell[axis] = static_cast<int>(std::floor(place[axis] / size));
  }
  return cell;
}

/// Numbers of the points in this cell and those around it, in ascending order: sums do not depend
/// on how a body lies among the cells.
std::vector<std::size_t> around(const std::map<LatticeCell, std::vector<std::size_t>>& cells,
                                const LatticeCell& middle) {
  std::vector<std::size_t> found;
  for (int k = 0; k < 27; ++k) {
    const auto cell =
        cells.find({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
    if (cell == cells.end()) continue;
    found.insert(found.end(), cell->second.begin(), cell->second.end());
  }
  std::sort(found.begin(), found.end());
  return found;
}

void mark_surface(std::vector<BodyPoint>& points, double support) {
  std::map<LatticeCell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cells[cell_of(points[i].place, support)].push_back(i);
  }
  for (const auto& [cell, inside] : cells) {
    const std::vector<std::size_t> others = around(cells, cell);
    for (const std::size_t i : inside) {
      BodyPoint& point = points[i];
      point.colour = 0.0;
      for (const std::size_t j : others) {
        const double apart = distance(point.place, points[j].place);
        if (apart < support) point.colour += points[j].volume * kernel_value(apart, support);
      }
      point.surface = point.colour < kSurfaceColour;
    }
  }
}

/// Carries the nearest point of the surface to each of these places, to the farthest of several.
void carry_to(const std::vector<Vector3>& places, double spacing, std::vector<BodyPoint>& points) {
  std::vector<double> carried(points.size(), 0.0);
  for (const Vector3& place : places) {
    double least = 2.0 * spacing;
    std::size_t nearest = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].surface) continue;
      const double off = distance(points[i].place, place);
      if (off >= least) continue;
      least = off;
      nearest = i;
    }
    if (nearest == points.size() || least < carried[nearest]) continue;
    carried[nearest] = least;
    points[nearest].skin = place;
  }
}

/// Edges and tips of a mesh meet the water first, and lie between the lattice's points; tips, first
/// of all.
void carry_to_ridges(const Shape& shape, double spacing, std::vector<BodyPoint>& points) {
  carry_to(shape.mesh->ridges.edges, spacing, points);
  carry_to(shape.mesh->ridges.tips, spacing, points);
}

/// A mesh between whose faces no point of the lattice lies has one where it is thickest.
void add_deepest(const Shape& shape, int owner, std::vector<BodyPoint>& points) {
  if (!points.empty() || shape.kind != ShapeKind::mesh) return;
  BodyPoint point;
  point.place = shape.mesh->deepest;
  point.skin = shape.mesh->distance.nearest(point.place).place;
  point.owner = owner;
  points.push_back(point);
}

}  // namespace

std::vector<BodyPoint> sample_shape(const Shape& shape, int owner, double spacing, double support) {
  const BodyLattice lattice = fit_lattice(shape.size, spacing);
  const Vector3 middle = middle_of(shape);
  std::vector<BodyPoint> points;
  for (int kz = 0; kz < lattice.count[2]; ++kz) {
    for (int ky = 0; ky < lattice.count[1]; ++ky) {
      for (int kx = 0; kx < lattice.count[0]; ++kx) {
        BodyPoint point;
        point.place = {along(lattice, 0, kx, shape.size[0]), along(lattice, 1, ky, shape.size[1]),
                       along(lattice, 2, kz, shape.size[2])};
        if (shape.kind == ShapeKind::mesh) point.place = point.place + middle;
        // A curved sole squeezes the layers instead of cutting them off.
        const double rise = rocker_rise(shape, point.place[0]);
        const double height = point.place[2] + shape.size[2] / 2.0;
        point.place[2] += rise * (1.0 - height / shape.size[2]);
        if (shape.kind != ShapeKind::box && !is_inside(shape, point.place)) continue;
        point.owner = owner;
        point.skin =
            carried_to_skin(shape, {point.place, lattice.step[0], side_of(lattice, {kx, ky, kz})});
        points.push_back(point);
      }
    }
  }
  add_deepest(shape, owner, points);
  for (BodyPoint& point : points) {
    point.volume = volume_of(shape) / static_cast<double>(points.size());
  }
  mark_surface(points, support);
  if (shape.kind == ShapeKind::mesh) carry_to_ridges(shape, spacing, points);
  return points;
}

std::vector<BodyPoint> sample_bodies(const std::vector<BodySettings>& bodies, double spacing,
                                     double support) {
  std::vector<BodyPoint> all;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto points = sample_shape(bodies[b].shape, static_cast<int>(b), spacing, support);
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

}  // namespace splash::sim
