// SPDX-License-Identifier: MIT
#include "sim-server/scene/rotation.hpp"

#include <cmath>

namespace splash::sim {

std::vector<Vector3> as_vectors(const std::vector<float>& parts, std::size_t stride,
                                std::size_t count) {
  std::vector<Vector3> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = vector_at(parts, stride, i);
  return all;
}

double length(const Vector3& a) noexcept {
  return std::hypot(a[0], a[1], a[2]);
}

Quaternion compose(const Quaternion& a, const Quaternion& b) noexcept {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
          a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
          a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

Quaternion inverse(const Quaternion& q) noexcept {
  return {-q[0], -q[1], -q[2], q[3]};
}

Vector3 rotate(const Quaternion& q, const Vector3& v) noexcept {
  const Vector3 u = {q[0], q[1], q[2]};
  const Vector3 uv = cross(u, v);
  return v + 2.0 * (q[3] * uv + cross(u, uv));
}

Quaternion unit(const Quaternion& q) noexcept {
  const double size = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!std::isfinite(size) || size < 1.0e-12) return {0.0, 0.0, 0.0, 1.0};
  return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
}

Quaternion from_turn(const Vector3& turn) noexcept {
  const double angle = length(turn);
  // sin(a/2)/a by its series where the quotient loses digits.
  const double scale = angle < 1.0e-6 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return unit({scale * turn[0], scale * turn[1], scale * turn[2], std::cos(0.5 * angle)});
}

Vector3 to_turn(const Quaternion& q) noexcept {
  // q and -q are the same rotation; the one with w >= 0 is the shorter way.
  const double sign = q[3] < 0.0 ? -1.0 : 1.0;
  const Vector3 u = {sign * q[0], sign * q[1], sign * q[2]};
  const double sine = length(u);
  const double angle = 2.0 * std::atan2(sine, sign * q[3]);
  return (sine < 1.0e-9 ? 2.0 : angle / sine) * u;
}

}  // namespace splash::sim
