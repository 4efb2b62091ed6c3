// SPDX-License-Identifier: MIT
#include "sim-server/show/scene_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "sim-server/scene/mesh/mesh_mass.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

/// Edges along which triangles do not go as often one way as the other.
int open_edges(const TriangleMesh& mesh) {
  std::map<std::array<int, 2>, int> times;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangle[k];
      const int b = triangle[(k + 1) % 3];
      times[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return static_cast<int>(
      std::count_if(times.begin(), times.end(), [](const auto& edge) { return edge.second != 0; }));
}

TEST(BodyMesh, IsTheClosedSurfaceOfEachForm) {
  for (const std::string& name : shape_names()) {
    const Shape shape = {shape_kind(name), {0.2, 0.2, 0.2}, 0.0, 0.0};
    const TriangleMesh mesh = body_mesh(shape);
    EXPECT_EQ(open_edges(mesh), 0) << name;
    EXPECT_NEAR(signed_volume(mesh) / volume_of(shape), 1.0, 0.02) << name;
    for (const Vector3& corner : mesh.vertices) {
      EXPECT_NEAR(distance_to(shape, corner), 0.0, 1e-12) << name;
    }
  }
}

TEST(BodyMesh, FollowsACurvedSole) {
  const Shape sole = {ShapeKind::box, {0.29, 0.1, 0.07}, 0.03, 0.5};
  const TriangleMesh mesh = body_mesh(sole);
  EXPECT_EQ(open_edges(mesh), 0);
  EXPECT_NEAR(signed_volume(mesh) / volume_of(sole), 1.0, 0.01);
}

TEST(BodyMesh, OfABoxIsItsTwelveTriangles) {
  const Shape box = {ShapeKind::box, {0.3, 0.2, 0.1}, 0.0, 0.0};
  EXPECT_EQ(body_mesh(box).triangles.size(), 12U);
  EXPECT_EQ(body_mesh(box).vertices.size(), 8U);
}

}  // namespace
}  // namespace splash::sim
