// SPDX-License-Identifier: MIT
// Mass, centre and moments of inertia of meshes against closed forms.
#include "sim-server/scene/mesh/mesh_mass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

const Vector3 kBox = {0.1, 0.2, 0.3};
/// By 0.7 rad about an axis that is none of the box's.
const Quaternion kTurn = from_turn({0.187, 0.374, 0.561});
const Vector3 kWay = {3.0, -2.0, 1.0};

double moment(double a, double b) {
  return (a * a + b * b) / 12.0;
}

TEST(MeshMass, OfABoxIsItsClosedForm) {
  const MeshMass mass = mesh_mass(placed(box_mesh(kBox), {0.0, 0.0, 0.0, 1.0}, kWay));
  EXPECT_NEAR(mass.volume, 0.006, 1e-15);
  EXPECT_LT(length(mass.centre - kWay), 1e-12);
  EXPECT_NEAR(mass.inertia[0], moment(0.2, 0.3), 1e-13);
  EXPECT_NEAR(mass.inertia[1], moment(0.1, 0.3), 1e-13);
  EXPECT_NEAR(mass.inertia[2], moment(0.1, 0.2), 1e-13);
  EXPECT_NEAR(std::abs(mass.axes[3]), 1.0, 1e-12) << "its own axes are the principal ones";
}

TEST(MeshMass, OfATurnedBoxHasThatBoxesAxes) {
  const MeshMass mass = mesh_mass(placed(box_mesh(kBox), kTurn, kWay));
  Vector3 sorted = mass.inertia;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_NEAR(sorted[0], moment(0.1, 0.2), 1e-13);
  EXPECT_NEAR(sorted[1], moment(0.1, 0.3), 1e-13);
  EXPECT_NEAR(sorted[2], moment(0.2, 0.3), 1e-13);
  // The tensor in the mesh's axes is the same either way.
  const Vector3 spin = {0.3, -1.0, 0.7};
  const auto momentum = [&](const Quaternion& axes, const Vector3& inertia) {
    Vector3 own = rotate(inverse(axes), spin);
    for (std::size_t k = 0; k < 3; ++k) own[k] *= inertia[k];
    return rotate(axes, own);
  };
  const Vector3 box = {moment(0.2, 0.3), moment(0.1, 0.3), moment(0.1, 0.2)};
  EXPECT_LT(length(momentum(mass.axes, mass.inertia) - momentum(kTurn, box)), 1e-13);
}

TEST(MeshMass, OfASphereConvergesToItsClosedForm) {
  const double radius = 0.3;
  double before = 0.0;
  for (const int levels : {2, 3, 4}) {
    const MeshMass mass = mesh_mass(placed(sphere_mesh(radius, levels), kTurn, kWay));
    const double error = 1.0 - mass.volume / (4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3));
    EXPECT_GT(error, 0.0) << "it lies within the sphere";
    if (before > 0.0) {
      EXPECT_NEAR(before / error, 4.0, 0.2) << "second order";
    }
    before = error;
    EXPECT_LT(length(mass.centre - kWay), 1e-12);
    for (const double part : mass.inertia) {
      EXPECT_NEAR(part / (0.4 * radius * radius), 1.0, error) << "two thirds of the volume's error";
      EXPECT_LT(part, 0.4 * radius * radius);
    }
  }
  EXPECT_LT(before, 0.005);
}

TEST(MeshMass, TurnsNegativeInsideOut) {
  TriangleMesh mesh = box_mesh(kBox);
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(signed_volume(mesh), -0.006, 1e-15);
}

}  // namespace
}  // namespace splash::sim
