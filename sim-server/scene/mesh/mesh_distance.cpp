// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/mesh_distance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

TrianglePoint nearest_on(const std::array<Vector3, 3>& corner, const Vector3& place) {
  const auto& [a, b, c] = corner;
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double a1 = dot(ab, place - a);
  const double a2 = dot(ac, place - a);
  if (a1 <= 0.0 && a2 <= 0.0) return {a, TrianglePart::corner_0};
  const double b1 = dot(ab, place - b);
  const double b2 = dot(ac, place - b);
  if (b1 >= 0.0 && b2 <= b1) return {b, TrianglePart::corner_1};
  const double over_c = a1 * b2 - b1 * a2;  // signed area of a, b and the place, and so on
  if (over_c <= 0.0 && a1 >= 0.0 && b1 <= 0.0) {
    return {a + (a1 / (a1 - b1)) * ab, TrianglePart::side_0};
  }
  const double c1 = dot(ab, place - c);
  const double c2 = dot(ac, place - c);
  if (c2 >= 0.0 && c1 <= c2) return {c, TrianglePart::corner_2};
  const double over_b = c1 * a2 - a1 * c2;
  if (over_b <= 0.0 && a2 >= 0.0 && c2 <= 0.0) {
    return {a + (a2 / (a2 - c2)) * ac, TrianglePart::side_2};
  }
  const double over_a = b1 * c2 - c1 * b2;
  if (over_a <= 0.0 && b2 - b1 >= 0.0 && c1 - c2 >= 0.0) {
    return {b + ((b2 - b1) / ((b2 - b1) + (c1 - c2))) * (c - b), TrianglePart::side_1};
  }
  const double all = over_a + over_b + over_c;
  return {a + (over_b / all) * ab + (over_c / all) * ac, TrianglePart::inside};
}

namespace {

constexpr std::size_t kLeaf = 4;  ///< triangles, at most
/// Slack of a bound that is known [1].
constexpr double kSlack = 1.0 + 1.0e-9;

Vector3 middle(const std::array<Vector3, 3>& corner) {
  return (1.0 / 3.0) * (corner[0] + corner[1] + corner[2]);
}

}  // namespace

MeshDistance::MeshDistance(const TriangleMesh& mesh) {
  std::vector<Vector3> at_vertex(mesh.vertices.size(), Vector3{0.0, 0.0, 0.0});
  std::map<std::pair<int, int>, Vector3> at_edge;
  const std::size_t count = mesh.triangles.size();
  triangles_.resize(count);
  const auto edge = [&](std::size_t t, std::size_t side) {
    return std::minmax({mesh.triangles[t][side], mesh.triangles[t][(side + 1) % 3]});
  };
  for (std::size_t t = 0; t < count; ++t) {
    const auto corner = triangles_[t].corner = corners(mesh, t);
    const Vector3 normal = triangles_[t].normal[6] = face_normal(corner);
    for (std::size_t k = 0; k < 3; ++k) {
      Vector3& sum = at_vertex[static_cast<std::size_t>(mesh.triangles[t][k])];
      sum = sum + angle_at(corner, k) * normal;
      Vector3& two = at_edge[edge(t, k)];
      two = two + normal;
    }
  }
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangles_[t].normal[k] = at_vertex[static_cast<std::size_t>(mesh.triangles[t][k])];
      triangles_[t].normal[3 + k] = at_edge[edge(t, k)];
    }
  }
  parts_.emplace_back();
  split(0, 0, count);
}

void MeshDistance::split(std::size_t part, std::size_t first, std::size_t count) {
  const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = begin + static_cast<std::ptrdiff_t>(count);
  Vector3 lower = begin->corner[0];
  Vector3 upper = lower;
  for (auto triangle = begin; triangle != end; ++triangle) {
    for (const Vector3& x : triangle->corner) grow_box(x, lower, upper);
  }
  parts_[part] = {lower, upper, first, count};
  if (count <= kLeaf) return;
  const Vector3 size = upper - lower;
  const auto axis =
      static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const std::size_t half = count / 2;
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half), end,
                   [axis](const Triangle& a, const Triangle& b) {
                     return middle(a.corner)[axis] < middle(b.corner)[axis];
                   });
  const std::size_t halves = parts_.size();
  parts_[part].first = halves;
  parts_[part].count = 0;
  parts_.resize(halves + 2);
  split(halves, first, half);
  split(halves + 1, first + half, count - half);
}

double MeshDistance::square_distance(const Part& part, const Vector3& place) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double off =
        std::max({part.lower[axis] - place[axis], place[axis] - part.upper[axis], 0.0});
    sum += off * off;
  }
  return sum;
}

void MeshDistance::search(std::size_t part, const Vector3& place, Found& found) const {
  const Part& here = parts_[part];
  if (here.count == 0) {
    const double left = square_distance(parts_[here.first], place);
    const double right = square_distance(parts_[here.first + 1], place);
    const std::size_t nearer = left <= right ? 0 : 1;
    if (std::min(left, right) < found.square) search(here.first + nearer, place, found);
    if (std::max(left, right) < found.square) search(here.first + 1 - nearer, place, found);
    return;
  }
  for (std::size_t t = here.first; t < here.first + here.count; ++t) {
    const TrianglePoint point = nearest_on(triangles_[t].corner, place);
    const Vector3 off = place - point.place;
    const double square = dot(off, off);
    if (square < found.square) found = {square, t, point};
  }
}

SurfacePlace MeshDistance::nearest(const Vector3& place, double within) const {
  Found found;
  found.square = kSlack * within * within + std::numeric_limits<double>::min();
  search(0, place, found);
  const Vector3& normal =
      triangles_[found.triangle].normal[static_cast<std::size_t>(found.point.part)];
  const double distance = std::sqrt(found.square);
  const bool inside = dot(place - found.point.place, normal) < 0.0;
  return {found.point.place, inside ? -distance : distance};
}

}  // namespace splash::sim
