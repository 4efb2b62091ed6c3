// SPDX-License-Identifier: MIT
// Only the surface of a solid is one, and what is wrong with another is told with the triangle.
#include "sim-server/scene/mesh/soundness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"
#include "tests/support/refusal.hpp"

namespace splash::sim {
namespace {

using ::testing::HasSubstr;

std::string complaint(const TriangleMesh& mesh) {
  return tests::refusal([&] { check_soundness(mesh); });
}

TEST(MeshSoundness, AcceptsSolids) {
  EXPECT_EQ(complaint(box_mesh({0.1, 0.2, 0.3})), "");
  EXPECT_EQ(complaint(sphere_mesh(0.1, 2)), "");
}

TEST(MeshSoundness, AcceptsTwoSolidsApart) {
  TriangleMesh both = box_mesh({0.1, 0.1, 0.1});
  const TriangleMesh other = placed(both, {0.0, 0.0, 0.0, 1.0}, {0.5, 0.0, 0.0});
  for (auto triangle : other.triangles) {
    for (int& corner : triangle) corner += 8;
    both.triangles.push_back(triangle);
    both.lines.push_back(1);
  }
  both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  EXPECT_EQ(complaint(both), "");
}

TEST(MeshSoundness, RefusesAHole) {
  TriangleMesh mesh = box_mesh({0.1, 0.1, 0.1});
  mesh.triangles.erase(mesh.triangles.begin() + 7);
  mesh.lines = {31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41};
  EXPECT_THAT(complaint(mesh), HasSubstr("formula:34:1"));
  EXPECT_THAT(complaint(mesh), HasSubstr("triangle 4 has an edge without a neighbour"));
}

TEST(MeshSoundness, RefusesATriangleThatIsInsideOut) {
  TriangleMesh mesh = box_mesh({0.1, 0.1, 0.1});
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  EXPECT_THAT(complaint(mesh), HasSubstr("one of them is inside out"));
}

TEST(MeshSoundness, RefusesThreeTrianglesAtAnEdge) {
  TriangleMesh mesh = box_mesh({0.1, 0.1, 0.1});
  mesh.vertices.push_back({0.2, 0.2, 0.2});
  mesh.triangles.push_back({0, 2, 8});
  mesh.lines.push_back(1);
  EXPECT_THAT(complaint(mesh), HasSubstr("more than two meet there"));
}

TEST(MeshSoundness, RefusesASurfaceThatIsInsideOut) {
  TriangleMesh mesh = box_mesh({0.1, 0.1, 0.1});
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_THAT(complaint(mesh), HasSubstr("the surface is inside out"));
}

TEST(MeshSoundness, RefusesWhatHasNoArea) {
  TriangleMesh needle = box_mesh({0.1, 0.1, 0.1});
  // A vertex on the edge of triangle 3, which becomes two that lie on a line.
  needle.triangles[2] = {4, 5, 5};
  EXPECT_THAT(complaint(needle), HasSubstr("triangle 3 has no area"));
  TriangleMesh line = box_mesh({0.1, 0.1, 0.1});
  line.vertices.push_back({0.0, -0.05, 0.05});
  line.triangles.insert(line.triangles.begin(), {4, 8, 5});
  line.lines.push_back(1);
  EXPECT_THAT(complaint(line), HasSubstr("triangle 1 has no area"));
}

TEST(MeshSoundness, RefusesWhatHasNoVolume) {
  TriangleMesh sheet;
  sheet.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  sheet.lines = {1, 2};
  EXPECT_THAT(complaint(sheet), HasSubstr("encloses no volume"));
}

TEST(MeshSoundness, RefusesASpeck) {
  EXPECT_THAT(complaint(box_mesh({0.9e-4, 0.9e-4, 0.9e-4})), HasSubstr("give it a scale"));
  EXPECT_EQ(complaint(box_mesh({1.1e-4, 0.9e-4, 0.9e-4})), "");
}

std::string complaint_of_solid(const TriangleMesh& mesh, double spacing) {
  return tests::refusal([&] { return make_solid(mesh, spacing); });
}

TEST(MeshSolid, IsAsThickAsAParticle) {
  EXPECT_EQ(complaint_of_solid(box_mesh({0.1, 0.1, 0.021}), 0.02), "");
  EXPECT_THAT(complaint_of_solid(box_mesh({0.1, 0.1, 0.009}), 0.02), HasSubstr("too thin"));
  EXPECT_THAT(complaint_of_solid(box_mesh({0.1, 0.1, 0.009}), 0.02), HasSubstr("0.009 m"));
  EXPECT_THAT(complaint_of_solid(box_mesh({0.1, 0.1, 0.009}), 0.02), HasSubstr("0.02 m"));
  EXPECT_EQ(complaint_of_solid(box_mesh({0.1, 0.1, 0.02}), 0.02), "") << "one layer";
  EXPECT_EQ(complaint_of_solid(sphere_mesh(0.0102, 3), 0.02), "");
}

TEST(MeshSolid, IsNoLargerThanItsFieldMayBe) {
  EXPECT_THAT(complaint_of_solid(box_mesh({20.0, 20.0, 20.0}), 0.02), HasSubstr("too large"));
}

}  // namespace
}  // namespace splash::sim
