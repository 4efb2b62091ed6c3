// SPDX-License-Identifier: MIT
// The rigid fit: exact without noise, best with noise, never a mirror image.
#include "sim-server/bodies/motion/rigid_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

const std::vector<Vector3> kMarkers = {{0.00, 0.00, 0.07},
                                       {0.28, 0.00, 0.05},
                                       {0.22, 0.08, 0.04},
                                       {0.23, -0.03, 0.05},
                                       {0.17, -0.03, 0.08}};

std::vector<Vector3> moved(const std::vector<Vector3>& points, const Quaternion& q,
                           const Vector3& shift) {
  std::vector<Vector3> result;
  for (const Vector3& point : points) result.push_back(rotate(q, point) + shift);
  return result;
}

double turn_between(const Quaternion& a, const Quaternion& b) {
  return length(to_turn(compose(a, inverse(b))));
}

/// Root mean square of the distances between measured and moved `reference` markers [m].
double misfit(const std::vector<Vector3>& reference, const std::vector<Vector3>& measured,
              const Quaternion& q, const Vector3& shift) {
  double sum = 0.0;
  const auto guess = moved(reference, q, shift);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Vector3 left = measured[i] - guess[i];
    sum += dot(left, left);
  }
  return std::sqrt(sum / static_cast<double>(measured.size()));
}

TEST(RigidFit, FindsAnyMotionExactly) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Quaternion q = unit({normal(random), normal(random), normal(random), normal(random)});
    const Vector3 shift = {normal(random), normal(random), normal(random)};
    const auto measured = moved(kMarkers, q, shift);
    const RigidFit fit = fit_rigid(kMarkers, measured);
    EXPECT_LT(turn_between(fit.rotation, q), 1e-7);
    EXPECT_LT(length(fit.translation - shift), 1e-9);
    EXPECT_LT(misfit(kMarkers, measured, fit.rotation, fit.translation), 1e-9);
  }
}

TEST(RigidFit, IsTheLeastOfSquaresUnderNoise) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 0.001);
  const Quaternion q = from_turn({0.4, -1.0, 2.0});
  for (int i = 0; i < 50; ++i) {
    auto measured = moved(kMarkers, q, {1.0, 2.0, 3.0});
    for (Vector3& place : measured) {
      place = place + Vector3{noise(random), noise(random), noise(random)};
    }
    const RigidFit fit = fit_rigid(kMarkers, measured);
    EXPECT_LT(turn_between(fit.rotation, q), 0.05) << "millimetres on a foot: below 3 degrees";
    const double least = misfit(kMarkers, measured, fit.rotation, fit.translation);
    // No small change makes it better.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double step : {-1e-4, 1e-4}) {
        Vector3 change = {};
        change[axis] = step;
        const Quaternion turned = compose(from_turn(change), fit.rotation);
        EXPECT_GT(misfit(kMarkers, measured, turned, fit.translation), least);
        EXPECT_GT(misfit(kMarkers, measured, fit.rotation, fit.translation + change), least);
      }
    }
  }
}

TEST(RigidFit, NeverMirrors) {
  auto mirrored = kMarkers;
  for (Vector3& place : mirrored) place[1] = -place[1];
  const RigidFit fit = fit_rigid(kMarkers, mirrored);
  // A proper rotation keeps the handedness of the axes; the mirror stays as misfit.
  const Vector3 x = rotate(fit.rotation, {1.0, 0.0, 0.0});
  const Vector3 y = rotate(fit.rotation, {0.0, 1.0, 0.0});
  const Vector3 z = rotate(fit.rotation, {0.0, 0.0, 1.0});
  EXPECT_NEAR(dot(cross(x, y), z), 1.0, 1e-12);
  EXPECT_GT(misfit(kMarkers, mirrored, fit.rotation, fit.translation), 0.005);
}

TEST(RigidFit, TurnsFlatMarkersOverInPlaceOfAMirror) {
  std::vector<Vector3> flat = kMarkers;
  for (Vector3& place : flat) place[2] = 0.0;
  auto mirrored = flat;
  for (Vector3& place : mirrored) place[1] = -place[1];
  const RigidFit fit = fit_rigid(flat, mirrored);
  EXPECT_LT(misfit(flat, mirrored, fit.rotation, fit.translation), 1e-12)
      << "half a turn about x does it";
  EXPECT_LT(turn_between(fit.rotation, {1.0, 0.0, 0.0, 0.0}), 1e-7);
}

TEST(RigidFit, FindsHalfTurnsAndNone) {
  for (const Quaternion& q : {Quaternion{0, 0, 0, 1}, Quaternion{1, 0, 0, 0},
                              Quaternion{0, 1, 0, 0}, Quaternion{0, 0, 1, 0}}) {
    const auto measured = moved(kMarkers, q, {});
    const RigidFit fit = fit_rigid(kMarkers, measured);
    EXPECT_LT(turn_between(fit.rotation, q), 1e-7);
    EXPECT_LT(misfit(kMarkers, measured, fit.rotation, fit.translation), 1e-12);
  }
}

TEST(RigidFit, NeedsMarkersThatAreNotNearlyOnALine) {
  const auto bent_by = [](double height) {
    return std::vector<Vector3>{{-0.1, 0, 0}, {0, height, 0}, {0.1, 0, 0}};
  };
  // Singular values sqrt(0.02) and sqrt(2/3) of the height; the limit is a 50th of the first.
  EXPECT_FALSE(spans_plane(bent_by(0.0034)));
  EXPECT_TRUE(spans_plane(bent_by(0.0036)));
}

TEST(RigidFit, ThreeMarkersAreEnoughButNotALine) {
  const std::vector<Vector3> three(kMarkers.begin(), kMarkers.begin() + 3);
  const Quaternion q = from_turn({0.0, 0.7, 0.0});
  EXPECT_LT(turn_between(fit_rigid(three, moved(three, q, {})).rotation, q), 1e-7);
  const std::vector<Vector3> line = {{0, 0, 0}, {0.1, 0.1, 0}, {0.3, 0.3, 0}};
  EXPECT_THROW(static_cast<void>(fit_rigid(line, line)), std::invalid_argument);
  const std::vector<Vector3> two(three.begin(), three.begin() + 2);
  EXPECT_THROW(static_cast<void>(fit_rigid(two, two)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(fit_rigid(three, kMarkers)), std::invalid_argument);
}

}  // namespace
}  // namespace splash::sim
