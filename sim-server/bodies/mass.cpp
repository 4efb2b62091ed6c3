// SPDX-License-Identifier: MIT
#include "sim-server/bodies/mass.hpp"

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

double mass_of(const BodySettings& body) {
  if (body.motion.mass > 0.0) return body.motion.mass;
  return body.motion.density * volume_of(body.shape);
}

Vector3 inertia_of(const Shape& shape, double mass) {
  const auto [a, b, c] = shape.size;
  switch (shape.kind) {
    case ShapeKind::sphere: {
      const double round = mass * a * a / 10.0;
      return {round, round, round};
    }
    case ShapeKind::cylinder: {
      const double across = mass * (0.75 * a * a + c * c) / 12.0;
      return {across, across, mass * a * a / 8.0};
    }
    case ShapeKind::box:
      break;
  }
  return {mass * (b * b + c * c) / 12.0, mass * (a * a + c * c) / 12.0,
          mass * (a * a + b * b) / 12.0};
}

std::vector<FreeBody> free_bodies(const std::vector<BodySettings>& bodies) {
  std::vector<FreeBody> all;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodySettings& body = bodies[b];
    if (!is_free(body)) continue;
    const double mass = mass_of(body);
    const Vector3 inertia = inertia_of(body.shape, mass);
    all.push_back({static_cast<int>(b), static_cast<float>(mass), static_cast<float>(inertia[0]),
                   static_cast<float>(inertia[1]), static_cast<float>(inertia[2]),
                   static_cast<float>(length(body.shape.size) / 2.0),
                   static_cast<float>(body.motion.restitution),
                   static_cast<float>(body.motion.friction)});
  }
  return all;
}

}  // namespace splash::sim
