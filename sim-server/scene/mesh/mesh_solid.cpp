// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/mesh_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <utility>

#include "sim-server/scene/mesh/soundness.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kSharp = std::numbers::pi / 6.0;  // [rad]

using Edge = std::pair<int, int>;

/// By how much the surface turns from one triangle to the next over an edge, outwards [rad].
double turn(const TriangleMesh& mesh, std::size_t one, std::size_t other, const Vector3& along) {
  const Vector3 n = face_normal(corners(mesh, one));
  const Vector3 m = face_normal(corners(mesh, other));
  return std::atan2(dot(cross(n, m), along) / length(along), dot(n, m));
}

void add_edges(const TriangleMesh& mesh, double step, Ridges& ridges, std::set<Vector3>& tips) {
  std::map<Edge, std::size_t> owner;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      owner[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
    }
  }
  for (const auto& [edge, one] : owner) {
    if (edge.first > edge.second) continue;
    const Vector3& from = mesh.vertices[static_cast<std::size_t>(edge.first)];
    const Vector3 along = mesh.vertices[static_cast<std::size_t>(edge.second)] - from;
    if (turn(mesh, one, owner.at({edge.second, edge.first}), along) < kSharp) continue;
    tips.insert({from, mesh.vertices[static_cast<std::size_t>(edge.second)]});
    const int parts = static_cast<int>(std::ceil(length(along) / step));
    for (int k = 1; k < parts; ++k) {
      ridges.edges.push_back(from + (static_cast<double>(k) / parts) * along);
    }
  }
}

void add_tips(const TriangleMesh& mesh, std::set<Vector3>& tips) {
  std::vector<double> around(mesh.vertices.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corner = corners(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      around[static_cast<std::size_t>(mesh.triangles[t][k])] += angle_at(corner, k);
    }
  }
  for (std::size_t v = 0; v < around.size(); ++v) {
    if (around[v] < 2.0 * std::numbers::pi - kSharp) tips.insert(mesh.vertices[v]);
  }
}

constexpr double kCells = 4.0;   ///< of the field, in a spacing
constexpr double kMargin = 3.0;  ///< of the field, beyond the reach of a particle [spacings]

void find_box(MeshSolid& solid) {
  solid.lower = solid.upper = solid.surface.vertices.front();
  for (const Vector3& x : solid.surface.vertices) grow_box(x, solid.lower, solid.upper);
}

program::ConfigError wrong(const MeshSolid& solid, const std::string& reason) {
  return {program::Place{.file = solid.surface.file}, reason};
}

std::string metres(double length) {
  std::ostringstream text;
  text.precision(3);
  text << length << " m";
  return text.str();
}

void check_size(const MeshSolid& solid) {
  const double nodes =
      field_nodes(solid.lower, solid.upper, solid.spacing / kCells, kMargin * solid.spacing);
  if (nodes <= kFieldNodesMax) return;
  const Vector3 size = solid.upper - solid.lower;
  throw wrong(solid, "is " + metres(size[0]) + " by " + metres(size[1]) + " by " + metres(size[2]) +
                         ", too large beside particles " + metres(solid.spacing) +
                         " apart: its distances would take more than 32 MiB; a smaller scale, "
                         "or a larger spacing of the fluid");
}

/// Depth below the surface [m].
double depth_at(const MeshSolid& solid, const Vector3& place) {
  return -solid.distance.nearest(place).distance;
}

/// From a place to a deeper one near it, in ways of `step` [m], then in halves of them, and so on.
Vector3 climb(const MeshSolid& solid, Vector3 place, double step) {
  constexpr int kHalvings = 10;
  double deepest = depth_at(solid, place);
  for (int halving = 0; halving < kHalvings; ++halving) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double way : {-step, step}) {
        Vector3 other = place;
        other[axis] += way;
        const double depth = depth_at(solid, other);
        if (depth <= deepest) continue;
        deepest = depth;
        place = other;
      }
    }
    step *= 0.5;
  }
  return place;
}

/// Finds where it is thickest: the deepest of places half a spacing apart, and what is deeper
/// there.
void find_deepest(MeshSolid& solid) {
  const Vector3 size = solid.upper - solid.lower;
  std::array<int, 3> count = {};
  Vector3 step = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // An odd number: one of them is in the middle.
    count[axis] = 2 * static_cast<int>(size[axis] / solid.spacing) + 1;
    step[axis] = size[axis] / count[axis];
  }
  double deepest = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < count[2]; ++k) {
    for (int j = 0; j < count[1]; ++j) {
      for (int i = 0; i < count[0]; ++i) {
        const Vector3 place =
            solid.lower + Vector3{(i + 0.5) * step[0], (j + 0.5) * step[1], (k + 0.5) * step[2]};
        const double depth = depth_at(solid, place);
        if (depth <= deepest) continue;
        deepest = depth;
        solid.deepest = place;
      }
    }
  }
  solid.deepest = climb(solid, solid.deepest, 0.5 * solid.spacing);
}

void check_thickness(const MeshSolid& solid) {
  const double thick = 2.0 * depth_at(solid, solid.deepest);
  if (thick >= (1.0 - 1.0e-6) * solid.spacing) return;
  throw wrong(solid, "is too thin: the largest ball within it has a diameter of " + metres(thick) +
                         ", and particles are " + metres(solid.spacing) +
                         " apart; make it thicker, or the spacing of the fluid smaller");
}

}  // namespace

Ridges find_ridges(const TriangleMesh& mesh, double step) {
  Ridges ridges;
  std::set<Vector3> tips;
  add_edges(mesh, step, ridges, tips);
  add_tips(mesh, tips);
  ridges.tips.assign(tips.begin(), tips.end());
  return ridges;
}

const DistanceField& MeshSolid::field() const {
  std::call_once(made_, [this] {
    field_ = sample_distance(distance, lower, upper, spacing / kCells, kMargin * spacing);
  });
  return field_;
}

void move_mesh(TriangleMesh& mesh, const Vector3& way) {
  for (Vector3& x : mesh.vertices) x = x + way;
}

std::shared_ptr<const MeshSolid> make_solid(TriangleMesh surface, double spacing) {
  check_soundness(surface);
  auto solid = std::make_shared<MeshSolid>();
  solid->surface = std::move(surface);
  solid->spacing = spacing;
  find_box(*solid);
  check_size(*solid);
  solid->mass = mesh_mass(solid->surface);
  solid->distance = MeshDistance(solid->surface);
  find_deepest(*solid);
  check_thickness(*solid);
  solid->ridges = find_ridges(solid->surface, 0.5 * spacing);
  return solid;
}

}  // namespace splash::sim
