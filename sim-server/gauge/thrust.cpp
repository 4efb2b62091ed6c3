// SPDX-License-Identifier: MIT
#include "sim-server/gauge/thrust.hpp"

#include <algorithm>

#include "sim-server/gauge/body_push.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

/// By its weight, the force that passes the face at `place` [Pa].
double share_of(const Face& face, const Vector3& place, double force) {
  return force * face_weight(length(place - face.place), face.radius);
}

double on_wall(const Face& face, const WaterState& water) {
  double sum = 0.0;
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    const double height = dot(water.position[i] - face.place, face.normal);
    if (height >= water.support) continue;
    sum += share_of(face, water.position[i] - height * face.normal,
                    water.mass * dot(water.wall_push[i], face.normal));
  }
  return sum;
}

double on_body(const Face& face, const WaterState& water, std::span<const BodyPoint> points,
               const BodyState& state) {
  double sum = 0.0;
  PlacedBody(water, points, face.body, state)
      .each_push(water, [&](std::size_t i, const PlacedPoint& point, const Vector3& force) {
        const double before = dot(water.position[i] - face.place, face.normal);
        const double behind = dot(point.place - face.place, face.normal);
        if (before <= 0.0 || behind >= 0.0) return;
        const double part = before / (before - behind);
        const Vector3 passes = water.position[i] + part * (point.place - water.position[i]);
        sum += share_of(face, passes, -dot(force, face.normal));
      });
  return sum;
}

}  // namespace

double thrust_on(const Face& face, const WaterState& water, std::span<const BodyPoint> points,
                 std::span<const BodyState> states) {
  if (face.cover <= 0.0) return 0.0;
  const double sum =
      face.body < 0 ? on_wall(face, water)
                    : on_body(face, water, points, states[static_cast<std::size_t>(face.body)]);
  if (sum <= 0.0) return 0.0;
  const double filled = water.rest_density * dot(water.gravity, face.place - face.middle);
  return std::max(sum / face.cover + filled, 0.0);
}

}  // namespace splash::sim
