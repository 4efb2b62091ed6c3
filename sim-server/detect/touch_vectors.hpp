// SPDX-License-Identifier: MIT
// What a point of the skin sees, as vectors in double precision.
#pragma once

#include "sim-server/detect/impacts.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

inline Vector3 vector(float x, float y, float z) {
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

/// Unit vector into the water.
inline Vector3 into_water(const Touch& touch) {
  const Vector3 g = vector(touch.gx, touch.gy, touch.gz);
  const double size = length(g);
  return size > 0.0 ? (1.0 / size) * g : Vector3{0.0, 0.0, -1.0};
}

inline Vector3 velocity_of(const Touch& touch) {
  return vector(touch.u, touch.v, touch.w);
}

inline Vector3 water_velocity_of(const Touch& touch) {
  return vector(touch.water_u, touch.water_v, touch.water_w);
}

inline Vector3 position_of(const Touch& touch) {
  return vector(touch.x, touch.y, touch.z);
}

inline Vector3 normal_of(const Touch& touch) {
  return vector(touch.nx, touch.ny, touch.nz);
}

}  // namespace splash::sim
