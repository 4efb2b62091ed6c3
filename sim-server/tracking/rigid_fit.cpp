// SPDX-License-Identifier: MIT
#include "sim-server/tracking/rigid_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

using Points = Eigen::Matrix<double, 3, Eigen::Dynamic>;

Points matrix(std::span<const Vector3> points) {
  Points all(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3d(points[i].data());
  }
  return all;
}

}  // namespace

bool spans_plane(std::span<const Vector3> points) {
  constexpr double kThin = 0.02;  // second singular value over the first
  if (points.size() < 3) return false;
  Points all = matrix(points);
  all.colwise() -= all.rowwise().mean().eval();
  const Eigen::Vector3d sizes = all.jacobiSvd().singularValues();
  return sizes[1] > kThin * sizes[0];
}

RigidFit fit_rigid(std::span<const Vector3> reference, std::span<const Vector3> measured) {
  if (reference.size() != measured.size()) {
    throw std::invalid_argument("a rigid fit needs as many measured as reference points");
  }
  if (!spans_plane(reference) || !spans_plane(measured)) {
    throw std::invalid_argument("a rigid fit needs three or more points that are not on a line");
  }
  const Points from = matrix(reference);
  const Points to = matrix(measured);
  const Eigen::Vector3d from_mean = from.rowwise().mean();
  const Eigen::Vector3d to_mean = to.rowwise().mean();
  const Eigen::Matrix3d covariance =
      (to.colwise() - to_mean) * (from.colwise() - from_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, 1.0);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs[2] = -1.0;
  const Eigen::Matrix3d turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  const Eigen::Vector3d shift = to_mean - turn * from_mean;
  const Eigen::Quaterniond q(turn);
  const Points left = to - ((turn * from).colwise() + shift);
  return {unit({q.x(), q.y(), q.z(), q.w()}),
          {shift[0], shift[1], shift[2]},
          std::sqrt(left.squaredNorm() / static_cast<double>(from.cols()))};
}

}  // namespace splash::sim
