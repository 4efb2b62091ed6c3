// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/rigid_fit.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

Vector3 mean(std::span<const Vector3> points) {
  const Vector3 sum = std::accumulate(points.begin(), points.end(), Vector3{},
                                      [](const Vector3& a, const Vector3& b) { return a + b; });
  return (1.0 / static_cast<double>(points.size())) * sum;
}

/// Sum over the points of b a^T, each less its mean [m2].
Eigen::Matrix3d covariance(std::span<const Vector3> a, std::span<const Vector3> b) {
  const Vector3 a_mean = mean(a);
  const Vector3 b_mean = mean(b);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector3 p = a[i] - a_mean;
    const Vector3 q = b[i] - b_mean;
    sum += Eigen::Vector3d(q.data()) * Eigen::Vector3d(p.data()).transpose();
  }
  return sum;
}

/// Horn 1987, section 4A: the rotation is the eigenvector of this matrix's largest eigenvalue, as
/// (w, x, y, z).
Eigen::Matrix4d horn_matrix(const Eigen::Matrix3d& s) {
  const double trace = s.trace();
  const Eigen::Vector3d turn(s(2, 1) - s(1, 2), s(0, 2) - s(2, 0), s(1, 0) - s(0, 1));
  Eigen::Matrix4d n;
  n(0, 0) = trace;
  n.block<3, 1>(1, 0) = turn;
  n.block<1, 3>(0, 1) = turn.transpose();
  n.block<3, 3>(1, 1) = s + s.transpose() - trace * Eigen::Matrix3d::Identity();
  return n;
}

}  // namespace

bool spans_plane(std::span<const Vector3> points) {
  constexpr double kThin = 0.02;  // second singular value over the first
  if (points.size() < 3) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> sizes(covariance(points, points),
                                                             Eigen::EigenvaluesOnly);
  return sizes.eigenvalues()[1] > kThin * kThin * sizes.eigenvalues()[2];
}

RigidFit fit_rigid(std::span<const Vector3> reference, std::span<const Vector3> measured) {
  if (reference.size() != measured.size()) {
    throw std::invalid_argument("a rigid fit needs as many measured as reference points");
  }
  if (!spans_plane(reference) || !spans_plane(measured)) {
    throw std::invalid_argument("a rigid fit needs three or more points that are not on a line");
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> best(
      horn_matrix(covariance(reference, measured)));
  const Eigen::Vector4d q = best.eigenvectors().col(3);
  RigidFit fit;
  fit.rotation = unit({q[1], q[2], q[3], q[0]});
  fit.translation = mean(measured) - rotate(fit.rotation, mean(reference));
  double left = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Vector3 off = measured[i] - rotate(fit.rotation, reference[i]) - fit.translation;
    left += dot(off, off);
  }
  fit.residual = std::sqrt(left / static_cast<double>(reference.size()));
  return fit;
}

}  // namespace splash::sim
