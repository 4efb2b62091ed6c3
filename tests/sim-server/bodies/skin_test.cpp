// SPDX-License-Identifier: MIT
// The skin of a body: its whole surface, outward normals, edges and tips where they are.
#include "sim-server/bodies/skin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.01;

double total_area(const std::vector<SkinPoint>& skin) {
  double sum = 0.0;
  for (const SkinPoint& point : skin) sum += point.area;
  return sum;
}

/// Sum of area times normal, and of that times place: nothing, and three times the volume, over any
/// closed surface (Gauss).
void expect_closed(const std::vector<SkinPoint>& skin, double volume, double within) {
  Vector3 sum = {0.0, 0.0, 0.0};
  double flux = 0.0;
  for (const SkinPoint& point : skin) {
    EXPECT_NEAR(length(point.normal), 1.0, 1.0e-9);
    sum = sum + point.area * point.normal;
    flux += point.area * dot(point.normal, point.place);
  }
  EXPECT_LT(length(sum), 1.0e-3 * total_area(skin));
  EXPECT_NEAR(flux / 3.0, volume, within * volume);
}

TEST(Skin, OfABoxIsItsFacesAndHasTheirCorners) {
  const Shape box = {ShapeKind::box, {0.18, 0.09, 0.04}, 0.0, 0.0};
  const auto skin = sample_skin(box, 3, kSpacing);
  EXPECT_NEAR(total_area(skin), 2.0 * (0.18 * 0.09 + 0.09 * 0.04 + 0.04 * 0.18), 1.0e-9);
  expect_closed(skin, 0.18 * 0.09 * 0.04, 1.0e-9);
  int corners = 0;
  for (const SkinPoint& point : skin) {
    EXPECT_EQ(point.owner, 3);
    EXPECT_NEAR(distance_to(box, point.place), 0.0, 1.0e-12);
    EXPECT_NEAR(std::abs(point.normal[0]) + std::abs(point.normal[1]) + std::abs(point.normal[2]),
                1.0, 1.0e-9);
    const Vector3& x = point.place;
    corners +=
        std::abs(x[0]) > 0.0899999 && std::abs(x[1]) > 0.0449999 && std::abs(x[2]) > 0.0199999;
  }
  EXPECT_EQ(corners, 24) << "each of eight, on three faces";
  EXPECT_NEAR(faces_of(skin, 4)[3], 0.18 * 0.09, 1.0e-9);
  EXPECT_EQ(faces_of(skin, 4)[0], 0.0);
}

TEST(Skin, OfABallAndACylinderIsTheirSurface) {
  const double pi = std::numbers::pi;
  const Shape ball = {ShapeKind::sphere, {0.1, 0.1, 0.1}, 0.0, 0.0};
  const auto round = sample_skin(ball, 0, kSpacing);
  EXPECT_NEAR(total_area(round) / (pi * 0.01), 1.0, 0.02);
  expect_closed(round, pi * 0.001 / 6.0, 0.03);
  for (const SkinPoint& point : round) {
    EXPECT_NEAR(length(point.place), 0.05, 1.0e-12);
    EXPECT_GT(dot(point.normal, point.place), 0.99 * 0.05);
  }
  EXPECT_NEAR(faces_of(round, 1)[0] / (pi * 0.0025), 1.0, 0.03);
  const Shape cylinder = {ShapeKind::cylinder, {0.1, 0.1, 0.2}, 0.0, 0.0};
  const auto can = sample_skin(cylinder, 0, kSpacing);
  EXPECT_NEAR(total_area(can) / (pi * 0.1 * 0.2 + 2.0 * pi * 0.0025), 1.0, 0.02);
  expect_closed(can, pi * 0.0025 * 0.2, 0.03);
  EXPECT_NEAR(faces_of(can, 1)[0] / (0.1 * 0.2), 1.0, 0.03);
}

TEST(Skin, FollowsARockerSole) {
  const Shape foot = {ShapeKind::box, {0.26, 0.1, 0.08}, 0.03, 0.4};
  double lowest_end = 1.0;
  for (const SkinPoint& point : sample_skin(foot, 0, kSpacing)) {
    if (point.normal[2] > -0.5) continue;
    EXPECT_NEAR(point.place[2], -0.04 + rocker_rise(foot, point.place[0]), 1.0e-12);
    if (point.place[0] > 0.129999) lowest_end = std::min(lowest_end, point.place[2]);
  }
  EXPECT_NEAR(lowest_end, -0.01, 1.0e-12);
}

TEST(Skin, OfAMeshIsThatOfItsForm) {
  const Vector3 size = {0.12, 0.08, 0.1};
  const Shape box = mesh_shape(make_solid(box_mesh(size), 2.0 * kSpacing));
  const auto skin = sample_skin(box, 0, kSpacing);
  EXPECT_NEAR(total_area(skin), 2.0 * (0.12 * 0.08 + 0.08 * 0.1 + 0.1 * 0.12), 1.0e-9);
  for (const Vector3& vertex : box.mesh->surface.vertices) {
    EXPECT_TRUE(std::any_of(skin.begin(), skin.end(), [&](const SkinPoint& point) {
      return length(point.place - vertex) < 1.0e-12;
    })) << "a corner, which may meet the water first";
  }
  EXPECT_NEAR(faces_of(skin, 1)[0], 0.12 * 0.1, 1.0e-9);
  // However fine its triangles are, it has about as many points as its surface has cells.
  const Shape ball = mesh_shape(make_solid(sphere_mesh(0.05, 4), 2.0 * kSpacing));
  const auto round = sample_skin(ball, 0, kSpacing);
  EXPECT_LT(round.size(), 3.0 * total_area(round) / (kSpacing * kSpacing));
  EXPECT_NEAR(faces_of(round, 1)[0] / (std::numbers::pi * 0.0025), 1.0, 0.03);
  expect_closed(round, std::numbers::pi * 0.001 / 6.0, 0.1);
}

TEST(Skin, OfManyBodiesIsCoarserRatherThanEndless) {
  BodySettings hull;
  hull.shape = {ShapeKind::box, {2.0, 1.0, 0.5}, 0.0, 0.0};
  const auto skin = sample_skins({hull, hull}, 0.005);
  EXPECT_LT(skin.size(), 6000U);
  EXPECT_GT(skin.size(), 3000U);
  EXPECT_EQ(skin.back().owner, 1);
}

}  // namespace
}  // namespace splash::sim
