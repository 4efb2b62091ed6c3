// SPDX-License-Identifier: MIT
#include "sim-server/gauge/film_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sim-server/gauge/body_push.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {

namespace {

constexpr double kGap = 2.0;     ///< of the widest film [spacings]
constexpr double kApart = 3.0;   ///< from there on no particle counts as between solids [spacings]
constexpr double kLeast = 0.01;  ///< what those between the solids count without others [1]
constexpr double kNoDirection = 0.003;  ///< square of the share of the areas that is none [1]

double floor_gap(const Solids& solids, const Vector3& place) {
  const double above = place[2] - solids.tank.lower[2];
  const Slope& slope = solids.scene.slope;
  if (!slope.present) return above;
  const double over = above - slope.gradient * (place[0] - slope.foot);
  return std::min(above, over / std::hypot(slope.gradient, 1.0));
}

double distance_to_body(const Solids& solids, std::size_t body, const Vector3& place) {
  const BodyState& state = solids.states[body];
  const Vector3 local = rotate(inverse(state.rotation), place - state.position);
  return distance_to(solids.scene.bodies[body].shape, local);
}

/// From the nearest wall or other body [m].
double gap_at(const Solids& solids, std::size_t body, const Vector3& place) {
  const Tank& tank = solids.tank;
  double gap = floor_gap(solids, place);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    gap = std::min({gap, place[axis] - tank.lower[axis], tank.upper[axis] - place[axis]});
  }
  for (std::size_t other = 0; other < solids.states.size(); ++other) {
    if (other != body) gap = std::min(gap, distance_to_body(solids, other, place));
  }
  return gap;
}

/// By differences over `step` [m].
template <class Distance>
Vector3 normal_of(const Distance& distance, const Vector3& place, double step) {
  Vector3 slope = differences(distance, place, step);
  for (double& x : slope) x /= 2.0 * step;
  return slope;
}

/// How much a place is between the body and another solid [1].
double between(const Solids& solids, std::size_t body, const Vector3& place, double spacing) {
  const auto own = [&](const Vector3& x) { return distance_to_body(solids, body, x); };
  const auto other = [&](const Vector3& x) { return gap_at(solids, body, x); };
  const double step = 1.0e-5 * spacing;
  const double facing = -dot(normal_of(own, place, step), normal_of(other, place, step));
  const double apart = (own(place) + other(place)) / spacing;
  return std::clamp(2.0 * facing, 0.0, 1.0) * std::clamp(kApart - apart, 0.0, 1.0);
}

/// What pushes the body by a unit of pressure: particles and areas that they have on it [m2].
std::map<std::size_t, Vector3> areas_of(const WaterState& water, std::span<const BodyPoint> points,
                                        std::size_t body, const BodyState& state) {
  WaterState unit = water;
  std::fill(unit.pressure.begin(), unit.pressure.end(), 1.0);
  unit.viscous = unit.artificial = 0.0;
  std::map<std::size_t, Vector3> areas;
  PlacedBody(unit, points, static_cast<int>(body), state)
      .each_push(unit, [&](std::size_t i, const PlacedPoint&, const Vector3& force) {
        Vector3& area = areas[i];
        area = area + force;
      });
  return areas;
}

/// The film's pressure.
struct Level {
  Vector3 centre = {0.0, 0.0, 0.0};  ///< of the body [m]
  Vector3 weight = {0.0, 0.0, 0.0};  ///< rho0 g [Pa/m]
  double p0 = 0.0;                   ///< at the centre [Pa]
  [[nodiscard]] double at(const Vector3& place) const {
    return std::max(p0 + dot(weight, place - centre), 0.0);
  }
};

}  // namespace

BodyForce film_force(const WaterState& water, const Solids& solids,
                     std::span<const BodyPoint> points, std::span<const SkinFace> skin,
                     std::size_t body) {
  const BodyState& state = solids.states[body];
  const auto in_world = [&](const SkinFace& face) {
    return state.position + rotate(state.rotation, face.place);
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const SkinFace& face : skin) {
    nearest = std::min(nearest, gap_at(solids, body, in_world(face)));
  }
  const double share = std::clamp(kGap - nearest / water.spacing, 0.0, 1.0);
  BodyForce film;
  if (share <= 0.0) return film;
  const auto areas = areas_of(water, points, body, state);
  Level level = {state.position, water.rest_density * water.field_at(state.position)};
  Vector3 towards = {0.0, 0.0, 0.0};
  Vector3 pushed = {0.0, 0.0, 0.0};
  double all = 0.0;
  double sum = 0.0;
  std::map<std::size_t, double> pinched;
  for (const auto& [i, area] : areas) {
    const Vector3& place = water.position[i];
    pinched[i] = between(solids, body, place, water.spacing);
    const double counts = std::max(1.0 - pinched[i], kLeast);
    const double p = water.pressure[i] - dot(level.weight, place - state.position);
    towards = towards + counts * area;
    pushed = pushed + counts * p * area;
    all += counts * length(area);
    sum += counts * p * length(area);
  }
  if (all <= 0.0) return film;
  level.p0 = (dot(towards, pushed) + kNoDirection * all * sum) /
             (dot(towards, towards) + kNoDirection * all * all);
  const auto press = [&](double pressure, const Vector3& place, const Vector3& area) {
    const Vector3 force = -pressure * area;
    film.force = film.force + force;
    film.torque = film.torque + cross(place - state.position, force);
  };
  double wet = 0.0;
  double below = 0.0;
  for (const auto& [i, area] : areas) {
    const double p = level.at(water.position[i]);
    press(p + pinched[i] * (water.pressure[i] - p), water.position[i], area);
    wet += length(area);
  }
  for (const SkinFace& face : skin) {
    const Vector3 place = in_world(face);
    press(level.at(place), place, rotate(state.rotation, face.area));
    const double open = std::clamp(gap_at(solids, body, place) / water.spacing, 0.0, 1.0);
    if (level.at(place) > 0.0) below += open * length(face.area);
  }
  const double part = below > 0.0 ? share * std::clamp(4.0 * wet / below - 1.0, 0.0, 1.0) : 0.0;
  return {part * film.force, part * film.torque};
}

}  // namespace splash::sim
