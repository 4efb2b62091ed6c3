// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/ridges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kSharp = std::numbers::pi / 6.0;  // [rad]

using Edge = std::pair<int, int>;

Vector3 normal_of(const TriangleMesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = corners(mesh, triangle);
  const Vector3 n = cross(b - a, c - a);
  return (1.0 / length(n)) * n;
}

/// By how much the surface turns from one triangle to the next over an edge, outwards [rad].
double turn(const TriangleMesh& mesh, std::size_t one, std::size_t other, const Vector3& along) {
  const Vector3 n = normal_of(mesh, one);
  const Vector3 m = normal_of(mesh, other);
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
      const Vector3 one = corner[(k + 1) % 3] - corner[k];
      const Vector3 other = corner[(k + 2) % 3] - corner[k];
      around[static_cast<std::size_t>(mesh.triangles[t][k])] +=
          std::atan2(length(cross(one, other)), dot(one, other));
    }
  }
  for (std::size_t v = 0; v < around.size(); ++v) {
    if (around[v] < 2.0 * std::numbers::pi - kSharp) tips.insert(mesh.vertices[v]);
  }
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

}  // namespace splash::sim
