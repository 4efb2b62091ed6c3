// SPDX-License-Identifier: MIT
// The exact signed distance from a mesh against all of its triangles one by one, and its field on a
// grid against that and against analytic distances.
#include "sim-server/scene/mesh/mesh_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "sim-server/scene/mesh/distance_field.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

std::vector<Vector3> random_places(std::size_t count, double reach) {
  std::mt19937 random(7);
  std::vector<Vector3> places(count);
  for (Vector3& place : places) {
    for (double& part : place) {
      part = reach * (2.0 * static_cast<double>(random()) / 4294967296.0 - 1.0);
    }
  }
  return places;
}

/// Solid angle of the surface, seen from `place`, in that of the whole sphere (van Oosterom &
/// Strackee 1983): 1 inside, 0 outside. Knows nothing of normals.
double winding(const TriangleMesh& mesh, const Vector3& place) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto x = corners(mesh, t);
    for (Vector3& corner : x) corner = corner - place;
    const double a = length(x[0]);
    const double b = length(x[1]);
    const double c = length(x[2]);
    sum += std::atan2(dot(x[0], cross(x[1], x[2])),
                      a * b * c + dot(x[0], x[1]) * c + dot(x[1], x[2]) * a + dot(x[2], x[0]) * b);
  }
  return sum / (2.0 * std::numbers::pi);
}

/// Of a triangle by its plane and its three sides.
double triangle_distance(const std::array<Vector3, 3>& x, const Vector3& place) {
  const Vector3 n = cross(x[1] - x[0], x[2] - x[0]);
  bool over = true;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 side = x[(k + 1) % 3] - x[k];
    over = over && dot(cross(n, side), place - x[k]) >= 0.0;
    const double part = std::clamp(dot(place - x[k], side) / dot(side, side), 0.0, 1.0);
    least = std::min(least, length(place - x[k] - part * side));
  }
  return over ? std::abs(dot(n, place - x[0])) / length(n) : least;
}

double brute_distance(const TriangleMesh& mesh, const Vector3& place) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    least = std::min(least, triangle_distance(corners(mesh, t), place));
  }
  return winding(mesh, place) > 0.5 ? -least : least;
}

/// A star of eight spikes: from before a tip the nearest triangle may show its back.
TriangleMesh star() {
  TriangleMesh mesh = sphere_mesh(0.1, 1);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (v % 3 == 0) mesh.vertices[v] = 2.5 * mesh.vertices[v];
  }
  return mesh;
}

TEST(MeshDistance, IsThatOfAllTrianglesOneByOne) {
  for (const TriangleMesh& mesh : {box_mesh({0.1, 0.2, 0.3}), sphere_mesh(0.15, 2), star(),
                                   placed(star(), from_turn({0.3, 0.2, 0.1}), {0.02, 0.01, 0.0})}) {
    const MeshDistance distance(mesh);
    int inside = 0;
    for (const Vector3& place : random_places(3000, 0.3)) {
      const SurfacePlace found = distance.nearest(place);
      EXPECT_NEAR(found.distance, brute_distance(mesh, place), 1e-12);
      EXPECT_NEAR(length(found.place - place), std::abs(found.distance), 1e-12);
      const double bounded = distance.nearest(place, std::abs(found.distance)).distance;
      EXPECT_EQ(bounded, found.distance) << "a bound that just holds changes nothing";
      inside += found.distance < 0.0 ? 1 : 0;
    }
    EXPECT_GT(inside, 20);
  }
}

TEST(MeshDistance, KnowsTheOutsideBeforeEdgesAndTips) {
  const TriangleMesh mesh = star();
  const MeshDistance distance(mesh);
  for (const Vector3& tip : find_ridges(mesh, 0.02).tips) {
    EXPECT_NEAR(distance.nearest(tip).distance, 0.0, 1e-12);
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); v += 3) {
    for (const Vector3& off : random_places(50, 0.003)) {
      const Vector3 place = 1.02 * mesh.vertices[v] + off;
      EXPECT_EQ(distance.nearest(place).distance > 0.0, winding(mesh, place) < 0.5);
    }
  }
}

TEST(MeshDistance, OfABoxIsTheShapesOwn) {
  Shape box;
  box.size = {0.1, 0.2, 0.3};
  const MeshDistance distance(box_mesh(box.size));
  for (const Vector3& place : random_places(2000, 0.25)) {
    EXPECT_NEAR(distance.nearest(place).distance, distance_to(box, place), 1e-12);
  }
}

constexpr double kCell = 0.005;
constexpr double kMargin = 0.06;

TEST(DistanceField, IsWithinItsBoundOfTheExactDistance) {
  for (const TriangleMesh& mesh : {box_mesh({0.101, 0.202, 0.153}), sphere_mesh(0.15, 3), star()}) {
    const MeshDistance distance(mesh);
    Vector3 upper = {0.0, 0.0, 0.0};
    for (const Vector3& x : mesh.vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) upper[axis] = std::max(upper[axis], x[axis]);
    }
    const DistanceField field = sample_distance(distance, -1.0 * upper, upper, kCell, kMargin);
    double worst = 0.0;
    for (const Vector3& place : random_places(20000, 0.2)) {
      bool beyond = false;
      for (std::size_t k = 0; k < 3; ++k) {
        beyond = beyond || std::abs(place[k]) > upper[k] + kMargin;
      }
      if (beyond) continue;
      const double error = std::abs(field.at(place) - distance.nearest(place).distance);
      worst = std::max(worst, error);
    }
    std::printf("%zu triangles: worst error %.3f cells\n", mesh.triangles.size(), worst / kCell);
    EXPECT_LT(worst, field.error());
    EXPECT_GT(worst, 0.01 * kCell) << "a field that knows more than its nodes";
  }
}

TEST(DistanceField, IsExactBeforeTheFacesOfABox) {
  Shape box;
  box.size = {0.101, 0.202, 0.153};
  const DistanceField field = sample_distance(MeshDistance(box_mesh(box.size)), -0.5 * box.size,
                                              0.5 * box.size, kCell, kMargin);
  int seen = 0;
  for (const Vector3& place : random_places(20000, 0.15)) {
    // Before a face, or behind it by less than from the sides: nothing bends within a cell.
    Vector3 over;
    for (std::size_t k = 0; k < 3; ++k) over[k] = std::abs(place[k]) - 0.5 * box.size[k];
    std::sort(over.begin(), over.end());
    if (over[1] > -2.0 * kCell || over[2] - over[1] < 2.0 * kCell || over[2] < -0.04) continue;
    ++seen;
    EXPECT_NEAR(field.at(place), distance_to(box, place), 1e-7);
  }
  EXPECT_GT(seen, 1000);
}

TEST(DistanceField, IsASpheresWhereTheSphereIsSmooth) {
  const double radius = 0.1;
  const TriangleMesh mesh = sphere_mesh(radius, 4);  // 5120 triangles
  const Vector3 corner = {radius, radius, radius};
  const DistanceField field =
      sample_distance(MeshDistance(mesh), -1.0 * corner, corner, kCell, kMargin);
  // The triangles' middles lie below the sphere by edge^2 / (6 R), edges at most 0.0078 long.
  const double flat = 0.0078 * 0.0078 / (6.0 * radius);
  double worst = 0.0;
  for (const Vector3& place : random_places(20000, 0.15)) {
    const double exact = length(place) - radius;
    if (std::abs(exact) > 0.05) continue;
    const double error = std::abs(field.at(place) - exact);
    worst = std::max(worst, error);
    EXPECT_LT(error, kCell * kCell / (4.0 * length(place)) * 1.1 + flat) << exact;
  }
  std::printf("sphere of %.0f cells: worst error %.4f cells\n", radius / kCell, worst / kCell);
}

TEST(DistanceField, GoesOnBeyondItsGrid) {
  const double radius = 0.1;
  const Vector3 corner = {radius, radius, radius};
  const DistanceField field =
      sample_distance(MeshDistance(sphere_mesh(radius, 3)), -1.0 * corner, corner, kCell, kMargin);
  for (const Vector3& place : random_places(500, 3.0)) {
    const double exact = length(place) - radius;
    if (exact < 0.2) continue;
    EXPECT_GE(field.at(place), exact - 0.002);
    EXPECT_LE(field.at(place), 1.1 * exact + 0.02);
  }
}

TEST(Ridges, AreTheEdgesOfABoxAndNoneOfASphere) {
  const Vector3 size = {0.1, 0.2, 0.3};
  const Ridges ridges = find_ridges(box_mesh(size), 0.01);
  const auto on_faces = [&](const Vector3& x) {
    int faces = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      faces += std::abs(std::abs(x[k]) - 0.5 * size[k]) < 1e-12 ? 1 : 0;
    }
    return faces;
  };
  for (const Vector3& x : ridges.edges) EXPECT_EQ(on_faces(x), 2);
  for (const Vector3& x : ridges.tips) EXPECT_EQ(on_faces(x), 3);
  EXPECT_EQ(ridges.tips.size(), 8U);
  EXPECT_NEAR(static_cast<double>(ridges.edges.size()), 4.0 * (9.0 + 19.0 + 29.0), 12.0);
  const Ridges round = find_ridges(sphere_mesh(0.1, 3), 0.01);
  EXPECT_TRUE(round.edges.empty());
  EXPECT_TRUE(round.tips.empty());
}

TEST(Ridges, FindTheTipOfACone) {
  TriangleMesh mesh = sphere_mesh(0.1, 3);
  const Vector3 tip = 1.15 * mesh.vertices[0];  // of five slopes, none of them sharp
  mesh.vertices[0] = tip;
  const Ridges ridges = find_ridges(mesh, 0.01);
  EXPECT_NE(std::find(ridges.tips.begin(), ridges.tips.end(), tip), ridges.tips.end());
}

}  // namespace
}  // namespace splash::sim
