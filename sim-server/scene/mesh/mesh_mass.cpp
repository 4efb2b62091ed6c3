// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/mesh_mass.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/symmetric_matrix.hpp"

namespace splash::sim {
namespace {

struct Integrals {
  double volume = 0.0;              ///< [m3]
  Vector3 first = {0.0, 0.0, 0.0};  ///< of x [m4]
  Matrix<3> second = {};            ///< of x x^T [m5]
};

/// About `origin`: nearby, or much is lost to rounding.
Integrals integrate(const TriangleMesh& mesh, const Vector3& origin) {
  Integrals sum;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto corner = corners(mesh, t);
    for (Vector3& x : corner) x = x - origin;
    const double det = dot(corner[0], cross(corner[1], corner[2]));
    const Vector3 all = corner[0] + corner[1] + corner[2];
    sum.volume += det / 6.0;
    sum.first = sum.first + (det / 24.0) * all;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        double products = all[i] * all[j];
        for (const Vector3& x : corner) products += x[i] * x[j];
        sum.second[i][j] += det / 120.0 * products;
      }
    }
  }
  return sum;
}

/// The rotation that carries x, y and z to three right-handed unit vectors (Shepperd 1978).
Quaternion rotation_to(const Matrix<3>& axes) {
  // Columns of the rotation's matrix are the new axes.
  const auto r = [&](std::size_t row, std::size_t column) { return axes[column][row]; };
  const std::array<double, 4> squares = {
      1.0 + r(0, 0) - r(1, 1) - r(2, 2), 1.0 - r(0, 0) + r(1, 1) - r(2, 2),
      1.0 - r(0, 0) - r(1, 1) + r(2, 2), 1.0 + r(0, 0) + r(1, 1) + r(2, 2)};
  const auto largest =
      static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
  const double a = squares[largest];
  if (largest == 3) {
    return unit({r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1), a});
  }
  if (largest == 0) {
    return unit({a, r(0, 1) + r(1, 0), r(0, 2) + r(2, 0), r(2, 1) - r(1, 2)});
  }
  if (largest == 1) {
    return unit({r(0, 1) + r(1, 0), a, r(1, 2) + r(2, 1), r(0, 2) - r(2, 0)});
  }
  return unit({r(0, 2) + r(2, 0), r(1, 2) + r(2, 1), a, r(1, 0) - r(0, 1)});
}

}  // namespace

double signed_volume(const TriangleMesh& mesh) {
  return integrate(mesh, mesh.vertices.front()).volume;
}

MeshMass mesh_mass(const TriangleMesh& mesh) {
  const Vector3 near = mesh.vertices.front();
  const Integrals rough = integrate(mesh, near);
  MeshMass mass;
  mass.volume = rough.volume;
  mass.centre = near + (1.0 / rough.volume) * rough.first;
  const auto [square, axes] = eigensystem(integrate(mesh, mass.centre).second);
  mass.inertia = (1.0 / mass.volume) *
                 Vector3{square[1] + square[2], square[0] + square[2], square[0] + square[1]};
  mass.axes = rotation_to(axes);
  return mass;
}

}  // namespace splash::sim
