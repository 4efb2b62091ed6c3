// SPDX-License-Identifier: MIT
// Where a sensor is let in, and how much of its face is there.
#include "sim-server/gauge/face.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kRadius = 0.04;
constexpr double kReach = 0.005;
/// First moment of half a face: 96 / (105 pi) of its radius, by integration of face_weight.
constexpr double kHalfMiddle = 96.0 / (105.0 * std::numbers::pi) * kRadius;

struct Basin {
  std::vector<BodySettings> bodies = std::vector<BodySettings>(1);
  std::vector<BodyState> states = std::vector<BodyState>(1);
  Surfaces surfaces;

  Basin() {
    bodies[0].shape.kind = ShapeKind::box;
    bodies[0].shape.size = {0.2, 0.2, 0.1};
    states[0].position = {0.5, 0.5, 0.05};
    surfaces.tank = {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.6}};
    surfaces.slope_from = 0.9;
    surfaces.bodies = bodies;
    surfaces.states = states;
  }
  std::optional<Face> at(const Vector3& place) const {
    return face_at(place, surfaces, kReach, kRadius);
  }
};

TEST(Face, WeighsOneInAll) {
  double sum = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const double r = (k + 0.5) / 4000.0 * 1.5 * kRadius;
    sum += 2.0 * std::numbers::pi * r * face_weight(r, kRadius) * 1.5 * kRadius / 4000.0;
  }
  EXPECT_NEAR(sum, 1.0, 1.0e-6);
  EXPECT_EQ(face_weight(1.01 * kRadius, kRadius), 0.0);
}

TEST(Face, IsNoneInOpenWater) {
  const Basin basin;
  EXPECT_FALSE(basin.at({0.2, 0.3, 0.1}));
  EXPECT_FALSE(basin.at({0.2, 0.3, 1.01 * kReach}));
  EXPECT_FALSE(basin.at({0.2, 0.3, 0.6})) << "the tank is open";
}

TEST(Face, OfTheFloorIsWholeAwayFromItsEdges) {
  const auto face = Basin().at({0.2, 0.3, 0.9 * kReach});
  ASSERT_TRUE(face);
  EXPECT_EQ(face->body, -1);
  EXPECT_EQ(face->normal, (Vector3{0.0, 0.0, 1.0}));
  EXPECT_DOUBLE_EQ(face->cover, 1.0);
  EXPECT_NEAR(length(face->middle - face->place), 0.0, 1.0e-12);
}

TEST(Face, LosesWhatIsBeyondAnEdge) {
  const Basin basin;
  const auto edge = basin.at({0.2, 0.0, 0.0});
  ASSERT_TRUE(edge);
  EXPECT_EQ(edge->normal, (Vector3{0.0, 0.0, 1.0})) << "of equally near ones the floor";
  EXPECT_NEAR(edge->cover, 0.5, 1.0e-9);
  EXPECT_NEAR(edge->middle[1], kHalfMiddle, 1.0e-3 * kRadius);
  EXPECT_NEAR(edge->middle[0], 0.2, 1.0e-9);
  EXPECT_NEAR(basin.at({0.0, 0.0, 0.0})->cover, 0.25, 1.0e-9);
  EXPECT_NEAR(basin.at({0.3, 0.0, 0.3})->cover, 1.0, 1.0e-9);
  EXPECT_EQ(basin.at({0.3, 1.0, 0.3})->normal, (Vector3{0.0, -1.0, 0.0}));
}

TEST(Face, EndsWhereTheSlopeBegins) {
  const Basin basin;
  EXPECT_FALSE(basin.at({0.95, 0.5, 0.0}));
  EXPECT_NEAR(basin.at({0.9 - 1.0e-9, 0.5, 0.0})->cover, 0.5, 1.0e-9);
  EXPECT_TRUE(basin.at({0.95, 1.0, 0.3})) << "its sides are walls like others";
}

TEST(Face, OfABodyIsItsSkin) {
  const Basin basin;
  const auto front = basin.at({0.6, 0.5, 0.05});
  ASSERT_TRUE(front);
  EXPECT_EQ(front->body, 0);
  EXPECT_NEAR(length(front->normal - Vector3{1.0, 0.0, 0.0}), 0.0, 1.0e-9);
  EXPECT_NEAR(front->cover, 1.0, 1.0e-9);
  const auto low = basin.at({0.6, 0.5, 0.0 + 2.0 * kReach});
  ASSERT_TRUE(low);
  EXPECT_EQ(low->body, 0);
  EXPECT_LT(low->cover, 0.8) << "the rest is under the floor";
  EXPECT_NEAR(basin.at({0.55, 0.45, 0.1})->cover, 1.0, 1.0e-9);
  EXPECT_LT(basin.at({0.6, 0.5, 0.1})->cover, 0.6) << "an edge";
}

TEST(Face, TurnsWithItsBody) {
  Basin basin;
  basin.states[0].position = {0.5, 0.5, 0.3};
  basin.states[0].rotation = from_turn({0.0, 0.5, 0.0});
  const Vector3 up = rotate(basin.states[0].rotation, {0.0, 0.0, 1.0});
  const auto face = basin.at(basin.states[0].position + 0.05 * up);
  ASSERT_TRUE(face);
  EXPECT_NEAR(length(face->normal - up), 0.0, 1.0e-9);
}

}  // namespace
}  // namespace splash::sim
