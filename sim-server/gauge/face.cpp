// SPDX-License-Identifier: MIT
#include "sim-server/gauge/face.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {

namespace {

constexpr int kRings = 16;  ///< of equal width, in which a face's cover is counted
constexpr int kTurns = 32;  ///< places on each ring

/// A place is on a surface if the solid begins this far behind it and the water as far before it,
/// in radii of the face [1].
constexpr double kSkin = 0.05;

bool in_tank(const Tank& tank, const Vector3& place) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (place[axis] < tank.lower[axis] || place[axis] > tank.upper[axis]) return false;
  }
  return true;
}

double distance_to_body(const Surfaces& surfaces, std::size_t body, const Vector3& place) {
  const BodyState& state = surfaces.states[body];
  return distance_to(surfaces.bodies[body].shape,
                     rotate(inverse(state.rotation), place - state.position));
}

/// Away from the body: the gradient of the distance.
Vector3 normal_of_body(const Surfaces& surfaces, std::size_t body, const Vector3& place,
                       double step) {
  const auto distance = [&](const Vector3& x) { return distance_to_body(surfaces, body, x); };
  const Vector3 slope = differences(distance, place, step);
  return (1.0 / std::max(length(slope), std::numeric_limits<double>::min())) * slope;
}

/// Any two unit vectors across `normal` and each other.
std::pair<Vector3, Vector3> across(const Vector3& normal) {
  const Vector3 other = std::abs(normal[0]) < 0.9 ? Vector3{1.0, 0.0, 0.0} : Vector3{0.0, 1.0, 0.0};
  Vector3 first = cross(normal, other);
  first = (1.0 / length(first)) * first;
  return {first, cross(normal, first)};
}

void find_cover(Face& face, const std::function<bool(const Vector3&)>& on_surface) {
  const auto [first, second] = across(face.normal);
  double all = 0.0;
  face.cover = 0.0;
  face.middle = {0.0, 0.0, 0.0};
  for (int ring = 0; ring < kRings; ++ring) {
    const double r = (ring + 0.5) / kRings * face.radius;
    const double weight = r * face_weight(r, face.radius);
    for (int turn = 0; turn < kTurns; ++turn) {
      const double angle = 2.0 * std::numbers::pi * (turn + 0.5) / kTurns;
      const Vector3 place =
          face.place + (r * std::cos(angle)) * first + (r * std::sin(angle)) * second;
      all += weight;
      if (!on_surface(place)) continue;
      face.cover += weight;
      face.middle = face.middle + weight * place;
    }
  }
  if (face.cover > 0.0) face.middle = (1.0 / face.cover) * face.middle;
  face.cover /= all;
}

}  // namespace

double face_weight(double r, double radius) {
  const double left = std::max(1.0 - r * r / (radius * radius), 0.0);
  return 3.0 / (std::numbers::pi * radius * radius) * left * left;
}

std::optional<Face> face_at(const Vector3& place, const Surfaces& surfaces, double reach,
                            double radius) {
  Face face;
  face.place = place;
  face.radius = radius;
  double nearest = std::numeric_limits<double>::infinity();
  const auto offer = [&](double distance, const Vector3& normal, int body) {
    if (std::abs(distance) > reach || std::abs(distance) >= nearest) return;
    nearest = std::abs(distance);
    face.normal = normal;
    face.body = body;
  };
  const Tank& tank = surfaces.tank;
  const bool walls = surfaces.only < 0;
  if (walls && place[0] < surfaces.slope_from) {
    offer(place[2] - tank.lower[2], {0.0, 0.0, 1.0}, -1);
  }
  for (std::size_t axis = 0; walls && axis < 2; ++axis) {
    Vector3 normal = {0.0, 0.0, 0.0};
    normal[axis] = 1.0;
    offer(place[axis] - tank.lower[axis], normal, -1);
    offer(tank.upper[axis] - place[axis], -1.0 * normal, -1);
  }
  for (std::size_t b = 0; b < surfaces.bodies.size(); ++b) {
    if (!walls && static_cast<int>(b) != surfaces.only) continue;
    const double distance = distance_to_body(surfaces, b, place);
    if (std::abs(distance) > reach) continue;
    offer(distance, normal_of_body(surfaces, b, place, reach), static_cast<int>(b));
  }
  if (!(nearest <= reach)) return std::nullopt;
  const double skin = kSkin * radius;
  find_cover(face, [&](const Vector3& x) {
    if (!in_tank(tank, x + skin * face.normal)) return false;
    if (face.body < 0) return x[0] < surfaces.slope_from || face.normal[2] == 0.0;
    const auto body = static_cast<std::size_t>(face.body);
    return distance_to_body(surfaces, body, x - skin * face.normal) < 0.0 &&
           distance_to_body(surfaces, body, x + skin * face.normal) > 0.0;
  });
  return face;
}

std::vector<Vector3> disc_on(const Face& face, double radius, const Tank& tank) {
  constexpr int kParts = 37;  // of equal area: the middle, and three rings around it
  const auto [first, second] = across(face.normal);
  std::vector<Vector3> places;
  int inner = 0;  // parts within the ring
  for (const int count : {1, 6, 12, 18}) {
    // Half the ring's area is on either side of its places.
    const double part = inner == 0 ? 0.0 : (inner + 0.5 * count) / kParts;
    const double r = radius * std::sqrt(part);
    for (int k = 0; k < count; ++k) {
      // Askew: no diameter along an edge has places on it but for the middle.
      const double angle = 2.0 * std::numbers::pi * (k + 0.3) / count;
      const Vector3 place =
          face.place + (r * std::cos(angle)) * first + (r * std::sin(angle)) * second;
      if (in_tank(tank, place)) places.push_back(place);
    }
    inner += count;
  }
  return places;
}

}  // namespace splash::sim
