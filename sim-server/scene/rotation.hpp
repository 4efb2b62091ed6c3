// SPDX-License-Identifier: MIT
// Vectors, unit quaternions as rotations, and their logarithm: the few formulas every moving body
// needs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Three numbers of single precision, as kernels have them.
[[nodiscard]] inline Vector3 vector(float x, float y, float z) noexcept {
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

/// The one of number `i` in an array with x, y and z parts `stride` apart.
[[nodiscard]] inline Vector3 vector_at(const std::vector<float>& parts, std::size_t stride,
                                       std::size_t i) {
  return vector(parts[i], parts[stride + i], parts[2 * stride + i]);
}
/// The first `count` of them.
[[nodiscard]] std::vector<Vector3> as_vectors(const std::vector<float>& parts, std::size_t stride,
                                              std::size_t count);

[[nodiscard]] inline Vector3 operator+(const Vector3& a, const Vector3& b) noexcept {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

[[nodiscard]] inline Vector3 operator-(const Vector3& a, const Vector3& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

[[nodiscard]] inline Vector3 operator*(double factor, const Vector3& a) noexcept {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

[[nodiscard]] inline Vector3 cross(const Vector3& a, const Vector3& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] inline double dot(const Vector3& a, const Vector3& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] double length(const Vector3& a) noexcept;

/// The box from `lower` to `upper` grows until `x` is in it.
inline void grow_box(const Vector3& x, Vector3& lower, Vector3& upper) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower[axis] = std::min(lower[axis], x[axis]);
    upper[axis] = std::max(upper[axis], x[axis]);
  }
}

/// By how much `field` grows along each axis, from a `step` before a place to a step beyond.
template <class Field>
[[nodiscard]] Vector3 differences(const Field& field, const Vector3& place, double step) {
  Vector3 all = {0.0, 0.0, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vector3 ahead = place;
    Vector3 behind = place;
    ahead[axis] += step;
    behind[axis] -= step;
    all[axis] = field(ahead) - field(behind);
  }
  return all;
}

/// First `b`, then `a`.
[[nodiscard]] Quaternion compose(const Quaternion& a, const Quaternion& b) noexcept;
/// The opposite rotation of a unit quaternion.
[[nodiscard]] Quaternion inverse(const Quaternion& q) noexcept;
/// `v` turned by the unit quaternion `q`.
[[nodiscard]] Vector3 rotate(const Quaternion& q, const Vector3& v) noexcept;
/// To unit length; no rotation when it has (almost) none or is not finite.
[[nodiscard]] Quaternion unit(const Quaternion& q) noexcept;
/// Rotation about the direction of `turn` by its length [rad], and back: the shortest turn.
[[nodiscard]] Quaternion from_turn(const Vector3& turn) noexcept;
[[nodiscard]] Vector3 to_turn(const Quaternion& q) noexcept;

}  // namespace splash::sim
