// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/rigid_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/symmetric_matrix.hpp"

namespace splash::sim {

namespace {

Vector3 mean(std::span<const Vector3> points) {
  const Vector3 sum = std::accumulate(points.begin(), points.end(), Vector3{},
                                      [](const Vector3& a, const Vector3& b) { return a + b; });
  return (1.0 / static_cast<double>(points.size())) * sum;
}

/// Sum over the points of b a^T, each less its mean [m2].
Matrix<3> covariance(std::span<const Vector3> a, std::span<const Vector3> b) {
  const Vector3 a_mean = mean(a);
  const Vector3 b_mean = mean(b);
  Matrix<3> sum = {};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector3 p = a[i] - a_mean;
    const Vector3 q = b[i] - b_mean;
    for (std::size_t row = 0; row < 3; ++row) sum[row] = sum[row] + q[row] * p;
  }
  return sum;
}

/// Horn 1987, section 4A: the rotation is the eigenvector of this matrix's largest eigenvalue, as
/// (w, x, y, z).
Matrix<4> horn_matrix(const Matrix<3>& s) {
  const double trace = s[0][0] + s[1][1] + s[2][2];
  const Vector3 turn = {s[2][1] - s[1][2], s[0][2] - s[2][0], s[1][0] - s[0][1]};
  Matrix<4> n = {};
  n[0][0] = trace;
  for (std::size_t i = 0; i < 3; ++i) {
    n[0][i + 1] = n[i + 1][0] = turn[i];
    for (std::size_t j = 0; j < 3; ++j) n[i + 1][j + 1] = s[i][j] + s[j][i];
    n[i + 1][i + 1] -= trace;
  }
  return n;
}

}  // namespace

bool spans_plane(std::span<const Vector3> points) {
  constexpr double kThin = 0.02;  // second singular value over the first
  if (points.size() < 3) return false;
  auto sizes = eigensystem(covariance(points, points)).values;
  std::sort(sizes.begin(), sizes.end());
  return sizes[1] > kThin * kThin * sizes[2];
}

RigidFit fit_rigid(std::span<const Vector3> reference, std::span<const Vector3> measured) {
  if (reference.size() != measured.size()) {
    throw std::invalid_argument("a rigid fit needs as many measured as reference points");
  }
  if (!spans_plane(reference) || !spans_plane(measured)) {
    throw std::invalid_argument("a rigid fit needs three or more points that are not on a line");
  }
  const auto [values, vectors] = eigensystem(horn_matrix(covariance(reference, measured)));
  const auto largest = std::max_element(values.begin(), values.end()) - values.begin();
  const auto& q = vectors[static_cast<std::size_t>(largest)];
  RigidFit fit;
  fit.rotation = unit({q[1], q[2], q[3], q[0]});
  fit.translation = mean(measured) - rotate(fit.rotation, mean(reference));
  return fit;
}

}  // namespace splash::sim
