// SPDX-License-Identifier: MIT
// Bodies as points: they fill the shape, know its surface, and follow a curved sole.
#include "sim-server/bodies/body_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.02;
constexpr double kSupport = 0.04;

double total_volume(const std::vector<BodyPoint>& points) {
  double sum = 0.0;
  for (const BodyPoint& point : points) sum += point.volume;
  return sum;
}

double nearest(const std::vector<BodyPoint>& points, const Vector3& place) {
  double least = 1.0e9;
  for (const BodyPoint& point : points) least = std::min(least, length(point.place - place));
  return least;
}

/// Every place inside the shape has a point within the half diagonal of a cube of the spacing.
void expect_filled(const Shape& shape, const std::vector<BodyPoint>& points, double within) {
  constexpr int kSteps = 13;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const int index[] = {i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps};
    Vector3 place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = shape.size[axis] * (static_cast<double>(index[axis]) / (kSteps - 1) - 0.5);
    }
    if (!is_inside(shape, place)) continue;
    EXPECT_LT(nearest(points, place), within) << place[0] << ' ' << place[1] << ' ' << place[2];
  }
}

TEST(BodyPoints, FillABox) {
  const Shape box = {ShapeKind::box, {0.13, 0.1, 0.05}, 0.0, 0.0};
  const auto points = sample_shape(box, 3, kSpacing, kSupport);
  ASSERT_EQ(points.size(), 7U * 5U * 3U);  // 0.13 / 0.02 is 6.5: seven layers
  EXPECT_NEAR(total_volume(points), 0.13 * 0.1 * 0.05, 1.0e-12);
  expect_filled(box, points, 0.5 * std::sqrt(3.0) * kSpacing);
  for (const BodyPoint& point : points) {
    EXPECT_EQ(point.owner, 3);
    EXPECT_TRUE(is_inside(box, point.place));
    const Vector3& x = point.place;
    EXPECT_LE(std::abs(x[0]), 0.065 - 0.13 / 14 + 1.0e-12);  // half a step below each face
    EXPECT_LE(std::abs(x[2]), 0.025 - 0.05 / 6 + 1.0e-12);
  }
}

TEST(BodyPoints, FillASphereAndACylinder) {
  const Shape sphere = {ShapeKind::sphere, {0.1, 0.1, 0.1}, 0.0, 0.0};
  const Shape cylinder = {ShapeKind::cylinder, {0.1, 0.1, 0.14}, 0.0, 0.0};
  EXPECT_NEAR(volume_of(sphere), std::numbers::pi / 6.0 * 1.0e-3, 1.0e-12);
  EXPECT_NEAR(volume_of(cylinder), std::numbers::pi * 0.0025 * 0.14, 1.0e-12);
  for (const Shape& shape : {sphere, cylinder}) {
    const auto points = sample_shape(shape, 0, kSpacing, kSupport);
    EXPECT_NEAR(total_volume(points), volume_of(shape), 1.0e-12);
    // Curved faces cut the lattice: up to a whole spacing more.
    expect_filled(shape, points, 1.5 * kSpacing);
    for (const BodyPoint& point : points) EXPECT_LE(distance_to(shape, point.place), 1.0e-12);
  }
}

TEST(BodyPoints, SurfaceIsTheOutermostLayer) {
  const Shape box = {ShapeKind::box, {0.16, 0.16, 0.16}, 0.0, 0.0};
  const auto points = sample_shape(box, 0, kSpacing, kSupport);
  int surface = 0;
  for (const BodyPoint& point : points) {
    const bool outermost = distance_to(box, point.place) > -kSpacing;
    EXPECT_EQ(point.surface, outermost)
        << point.place[0] << ' ' << point.place[1] << ' ' << point.place[2] << ": " << point.colour;
    EXPECT_EQ(point.surface, point.colour < 0.95);
    surface += point.surface;
  }
  EXPECT_EQ(surface, 8 * 8 * 8 - 6 * 6 * 6);
  // Deep inside the colour field is that of water: 1, but for the lattice's sum.
  EXPECT_NEAR(points[static_cast<std::size_t>(8 * 8 * 4 + 8 * 4 + 4)].colour, 1.0, 0.05);
}

TEST(BodyPoints, ThinShapesKeepOneLayer) {
  const Shape sheet = {ShapeKind::box, {0.1, 0.1, 0.003}, 0.0, 0.0};
  const auto points = sample_shape(sheet, 0, kSpacing, kSupport);
  ASSERT_EQ(points.size(), 25U);
  EXPECT_NEAR(total_volume(points), 3.0e-5, 1.0e-12);
  for (const BodyPoint& point : points) {
    EXPECT_NEAR(point.place[2], 0.0, 1.0e-12);
    EXPECT_TRUE(point.surface);
  }
  for (const ShapeKind kind : {ShapeKind::box, ShapeKind::sphere, ShapeKind::cylinder}) {
    const Shape crumb = {kind, {0.004, 0.004, 0.004}, 0.0, 0.0};
    const auto one = sample_shape(crumb, 0, kSpacing, kSupport);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_NEAR(one[0].volume, volume_of(crumb), 1.0e-15);
  }
}

TEST(BodyPoints, FollowARockerSole) {
  const Shape foot = {ShapeKind::box, {0.26, 0.1, 0.08}, 0.03, 0.4};
  EXPECT_EQ(rocker_rise(foot, 0.0), 0.0);
  EXPECT_EQ(rocker_rise(foot, 0.05), 0.0);  // within the flat 40 %
  EXPECT_NEAR(rocker_rise(foot, 0.13), 0.03, 1.0e-12);
  EXPECT_NEAR(rocker_rise(foot, -0.13), 0.03, 1.0e-12);
  EXPECT_NEAR(rocker_rise(foot, 0.091), 0.03 / 4, 1.0e-12);  // half way along the curve
  EXPECT_NEAR(rocker_rise(foot, 9.0), 0.03, 1.0e-12);
  double area = 0.0;  // of the side, by the midpoint rule
  for (int k = 0; k < 10000; ++k) {
    area += (0.08 - rocker_rise(foot, 0.26 * ((k + 0.5) / 10000 - 0.5))) * 0.26 / 10000;
  }
  EXPECT_NEAR(volume_of(foot), 0.1 * area, 1.0e-8);

  const auto points = sample_shape(foot, 0, kSpacing, kSupport);
  ASSERT_EQ(points.size(), 13U * 5U * 4U);  // squeezed, not cut off
  for (const BodyPoint& point : points) EXPECT_TRUE(is_inside(foot, point.place));
  // The lowest layer's skin is the sole, out to its ends.
  for (std::size_t i = 0; i < 13U * 5U; ++i) {
    const Vector3& x = points[i].skin;
    EXPECT_NEAR(x[2], -0.04 + rocker_rise(foot, x[0]), 1.0e-12);
  }
  EXPECT_NEAR(points[0].skin[0], -0.13, 1.0e-12);
  EXPECT_NEAR(points[12].skin[0], 0.13, 1.0e-12);
}

/// Processor time to sample a ball of so many spacings across [s].
double cost(double spacings) {
  const double spacing = 0.1 / spacings;
  const Shape ball = {ShapeKind::sphere, {0.1, 0.1, 0.1}, 0.0, 0.0};
  const std::clock_t start = std::clock();
  EXPECT_GT(sample_shape(ball, 0, spacing, 2.0 * spacing).size(), 100U);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// A ball among a million particles has 30,000 points: a look at every pair took minutes.
TEST(BodyPoints, TakeTimeInProportionToTheirNumber) {
  EXPECT_LT(cost(36.0), 3.0 * 8.0 * cost(18.0)) << "eight times as many, not 64";
}

TEST(BodyPoints, SkinOfASurfacePointIsOnTheTrueSurface) {
  const Shape box = {ShapeKind::box, {0.13, 0.1, 0.05}, 0.0, 0.0};
  for (const BodyPoint& point : sample_shape(box, 0, kSpacing, kSupport)) {
    if (!point.surface) continue;
    const Vector3& x = point.skin;
    const double deepest =
        std::max({std::abs(x[0]) - 0.065, std::abs(x[1]) - 0.05, std::abs(x[2]) - 0.025});
    EXPECT_NEAR(deepest, 0.0, 1.0e-12);
  }
  const Shape sphere = {ShapeKind::sphere, {0.1, 0.1, 0.1}, 0.0, 0.0};
  for (const BodyPoint& point : sample_shape(sphere, 0, kSpacing, kSupport)) {
    if (!point.surface) continue;
    EXPECT_NEAR(length(point.skin), 0.05, 1.0e-12);
  }
}

TEST(BodyPoints, OfAllBodiesComeBodyAfterBody) {
  BodySettings a;
  a.shape = {ShapeKind::box, {0.04, 0.04, 0.04}, 0.0, 0.0};
  BodySettings b;
  b.shape = {ShapeKind::box, {0.06, 0.02, 0.02}, 0.0, 0.0};
  const auto points = sample_bodies({a, b}, kSpacing, kSupport);
  ASSERT_EQ(points.size(), 8U + 3U);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i].owner, i < 8 ? 0 : 1);
}

TEST(BodyPoints, OfAMeshedBoxAreThoseOfTheBox) {
  const Shape box{ShapeKind::box, {0.12, 0.08, 0.1}, 0.0, 0.0};
  const auto points = sample_shape(box, 0, kSpacing, kSupport);
  const Shape mesh = mesh_shape(make_solid(box_mesh(box.size), kSpacing));
  const auto meshed = sample_shape(mesh, 0, kSpacing, kSupport);
  ASSERT_EQ(meshed.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(length(meshed[i].place - points[i].place), 1.0e-12);
    EXPECT_NEAR(meshed[i].volume, points[i].volume, 1.0e-15);
    EXPECT_EQ(meshed[i].surface, points[i].surface);
    if (!points[i].surface) continue;
    EXPECT_NEAR(distance_to(box, meshed[i].skin), 0.0, 1.0e-9);
    // Corners are where they are; on an edge a point may be half a layer beside.
    const bool corner = std::abs(distance_to(box, points[i].place)) < kSpacing &&
                        length(points[i].skin - points[i].place) > 0.8 * kSpacing;
    EXPECT_LT(length(meshed[i].skin - points[i].skin), corner ? 1.0e-9 : 0.8 * kSpacing);
  }
}

TEST(BodyPoints, OfAMeshBesideItsOriginLieInIt) {
  const Vector3 away = {0.3, -0.2, 0.1};
  const Quaternion turn = from_turn({0.4, -0.7, 0.2});
  const TriangleMesh askew = placed(box_mesh({0.12, 0.08, 0.1}), turn, away);
  const Shape mesh = mesh_shape(make_solid(askew, kSpacing));
  const auto points = sample_shape(mesh, 0, kSpacing, kSupport);
  EXPECT_NEAR(total_volume(points), 0.12 * 0.08 * 0.1, 1.0e-12);
  double lattice = 1.0;  // whole layers, a spacing thick at most, fill the box around it
  for (const double edge : mesh.size) lattice *= edge / std::ceil(edge / kSpacing);
  EXPECT_NEAR(points[0].volume / lattice, 1.0, 0.15) << "as many as fill it";
  for (const BodyPoint& point : points) {
    EXPECT_LT(distance_to(mesh, point.place), 0.0);
    EXPECT_NEAR(mesh.mesh->distance.nearest(point.skin).distance, 0.0, 1.0e-12);
  }
  // Every corner is some point's skin: whichever goes in first is seen.
  for (const Vector3& vertex : askew.vertices) {
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const BodyPoint& point) {
      return point.surface && length(point.skin - vertex) < 1.0e-9;
    }));
  }
}

TEST(BodyPoints, OfAMeshThatFallsBetweenThemIsOneInItsMiddle) {
  // Two pyramids base to base: all of the lattice of its box lies outside.
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.02}, {0.0, 0.0, -0.02}, {0.02, 0.0, 0.0},
                   {0.0, 0.02, 0.0}, {-0.02, 0.0, 0.0}, {0.0, -0.02, 0.0}};
  mesh.triangles = {{0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 2},
                    {1, 3, 2}, {1, 4, 3}, {1, 5, 4}, {1, 2, 5}};
  mesh.lines.assign(8, 1);
  mesh.file = "formula";
  const auto points = sample_shape(mesh_shape(make_solid(mesh, 0.0205)), 0, 0.0205, 0.05);
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(total_volume(points), 4.0 / 3.0 * 0.02 * 0.02 * 0.02, 1.0e-12);
}

}  // namespace
}  // namespace splash::sim
