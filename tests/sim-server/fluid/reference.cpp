// SPDX-License-Identifier: MIT
#include "tests/sim-server/fluid/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

Vector3 normal_of(const FluidParams& params, int wall) {
  const WallPlane& plane = params.walls[wall];
  return vector(plane.nx, plane.ny, plane.nz);
}

/// Walls that count at a place: the floor or the slope, whichever is nearer, and all others.
std::vector<int> open_walls(const FluidParams& params, const Vector3& place, double piston) {
  std::vector<int> walls;
  for (int k = 0; k < params.wall_count; ++k) walls.push_back(k);
  if (params.slope < 0) return walls;
  const bool slope_nearer =
      wall_distance(params, params.slope, place, piston) < wall_distance(params, 0, place, piston);
  std::erase(walls, slope_nearer ? 0 : params.slope);
  return walls;
}

/// Layers of fluid behind wall k at distance `d`, one spacing apart: its mirror image, the first as
/// deep as d is high; or, behind a slope and the floor it continues, fixed ones, the first half a
/// spacing deep. Their weight, and its fall with d: 2 pi z W(z) per layer and z, twice for a
/// mirror, as z grows by 2 d. Nearer than half a spacing a mirror's fall stays as it is there.
std::pair<double, double> layers_behind(const FluidParams& params, int k, double d) {
  const bool mirrors = params.slope < 0 || (k != 0 && k != params.slope);
  const double support = static_cast<double>(params.support);
  const double spacing = static_cast<double>(params.spacing);
  const double weight = static_cast<double>(params.layer_weight);
  const double outside = std::max(d, 0.0);
  const double kept = std::max(d, spacing / 2.0);
  double share = 0.0;
  double fall = 0.0;
  for (double behind = 0.0; behind < 0.999 * support; behind += spacing) {
    const double z = mirrors ? 2.0 * kept + behind : outside + spacing / 2.0 + behind;
    share += weight * plane_marginal(z, support);
    fall += (mirrors ? 2.0 : 1.0) * weight * 2.0 * std::numbers::pi * z * kernel_value(z, support);
  }
  return {mirrors ? share + fall * (kept - outside) : share, fall};
}

/// One term of the pair sums: the push of a neighbour at `from` with `weight` = m or rho0 V, by
/// the p / rho^2 of both.
Vector3 pair_push(const FluidState& s, std::size_t i, const Vector3& from, const Vector3& velocity,
                  double weight, double own, double theirs) {
  const FluidParams& p = s.params;
  const double support = static_cast<double>(p.support);
  const Vector3 x = s.position[i] - from;
  if (dot(x, x) >= support * support) return {0.0, 0.0, 0.0};
  const double r = length(x);
  const double closing = dot(s.velocity[i] - velocity, x);
  const double h = static_cast<double>(p.length);
  double k = static_cast<double>(p.viscous);
  if (closing < 0.0) k += static_cast<double>(p.artificial);
  const double rub = k / static_cast<double>(p.rest_density) * closing / (r * r + 0.01 * h * h);
  return -weight * (own + theirs - rub) * kernel_gradient(r, support) * x;
}

// The image of the water behind a body's face (boundary/body_image.h); gradients by differences.

/// R and its gradient.
struct ReferenceImage {
  double factor = 1.0;                 ///< [1]
  Vector3 gradient = {0.0, 0.0, 0.0};  ///< [1/m]
};

Shape shape_of(const BodyShape& s) {
  Shape shape;
  shape.kind = static_cast<ShapeKind>(s.kind);
  shape.size = 2.0 * vector(s.half_x, s.half_y, s.half_z);
  shape.rocker = static_cast<double>(s.rocker);
  shape.flat = static_cast<double>(s.flat);
  return shape;
}

/// With a curved underside: the height below it.
double outline_distance(const Shape& shape, const Vector3& x) {
  const double half = 0.5 * shape.size[2];
  if (shape.kind != ShapeKind::box || shape.rocker <= 0.0) return distance_to(shape, x);
  const double under = rocker_rise(shape, x[0]) - half - x[2];
  // A box whose underside is where that distance says.
  return distance_to(shape, {x[0], x[1], std::max(under, x[2] - half) + half});
}

/// To the nearest body.
double nearest(const FluidState& s, const Vector3& place) {
  double found = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < s.shapes.size(); ++b) {
    const BodyState body = state_of(s.bodies[b]);
    const Vector3 own = rotate(inverse(body.rotation), place - body.position);
    const double d = s.shapes[b].kind == SPLASH_MESH ? s.fields[b].at(own)
                                                     : outline_distance(shape_of(s.shapes[b]), own);
    found = std::min(found, d);
  }
  return found;
}

double factor_at(const FluidParams& params, double distance) {
  const double support = static_cast<double>(params.support);
  const double spacing = static_cast<double>(params.spacing);
  const double d = std::max(distance, 0.0);
  const double kept = std::max(distance, 0.5 * spacing);
  double mirror = 0.0;
  double fixed = 0.0;
  for (double behind = 0.0; behind < 0.999 * support; behind += spacing) {
    const double z = 2.0 * kept + behind;
    mirror += plane_marginal(z, support);
    mirror += 4.0 * std::numbers::pi * z * kernel_value(z, support) * (kept - d);
    fixed += plane_marginal(d + 0.5 * spacing + behind, support);
  }
  return fixed > 0.0 ? mirror / fixed : 0.0;
}

/// Without bodies: 1 everywhere.
ReferenceImage reference_image(const FluidState& s, const Vector3& place) {
  if (s.shapes.empty()) return {};
  const auto factor = [&](const Vector3& x) { return factor_at(s.params, nearest(s, x)); };
  const double step = 1.0e-5 * static_cast<double>(s.params.spacing);
  return {factor(place), (0.5 / step) * differences(factor, place, step)};
}

/// A mesh's distances, out of the device's numbers.
DistanceField field_of(const BodyShape& shape, const std::vector<float>& meshes) {
  DistanceField field;
  if (shape.kind != SPLASH_MESH) return field;
  field.lower = vector(shape.lower_x, shape.lower_y, shape.lower_z);
  field.cell = static_cast<double>(shape.cell);
  field.nodes = {shape.nodes_x, shape.nodes_y, shape.nodes_z};
  const auto first = meshes.begin() + shape.field;
  field.values.assign(first, first + std::ptrdiff_t{shape.nodes_x} * shape.nodes_y * shape.nodes_z);
  return field;
}

}  // namespace

std::vector<double> read_numbers(Device& device, const Buffer<float>& buffer, std::size_t count) {
  const std::vector<float> read = buffer.read(device, count);
  return {read.begin(), read.end()};
}

std::vector<Vector3> read_vectors(Device& device, const Buffer<float>& buffer, int stride,
                                  std::size_t count) {
  const auto apart = static_cast<std::size_t>(stride);
  return as_vectors(buffer.read(device, 3 * apart), apart, count);
}

FluidState read_state(Fluid& fluid, double piston) {
  Device& device = fluid.device();
  FluidState s;
  s.params = fluid.params();
  s.piston = piston;
  const auto count = static_cast<std::size_t>(s.params.count);
  const PointArrays& points = fluid.particles();
  s.id = points.id.read(device, count);
  s.position = read_vectors(device, points.position, points.stride, count);
  s.velocity = read_vectors(device, points.velocity, points.stride, count);
  s.density = read_numbers(device, fluid.density(), count);
  s.peak_density = read_numbers(device, fluid.peak_density(), count);
  s.pressure_term = read_numbers(device, fluid.pressure_term(), count);
  const auto body_points = static_cast<std::size_t>(fluid.boundary().point_count());
  const PointArrays& boundary = fluid.boundary().points();
  s.body_position = read_vectors(device, boundary.position, boundary.stride, body_points);
  s.body_velocity = read_vectors(device, boundary.velocity, boundary.stride, body_points);
  s.body_volume = read_numbers(device, fluid.boundary().volume(), body_points);
  const auto bodies = static_cast<std::size_t>(fluid.boundary().body_count());
  if (bodies == 0) return s;
  s.shapes = fluid.boundary().shapes().read(device, bodies);
  s.bodies = fluid.boundary().steps().read(device, bodies);
  const std::vector<float> meshes =
      fluid.boundary().meshes().read(device, fluid.boundary().meshes().size());
  for (const BodyShape& shape : s.shapes) s.fields.push_back(field_of(shape, meshes));
  return s;
}

std::vector<Vector3> read_acceleration(Fluid& fluid) {
  return read_vectors(fluid.device(), fluid.acceleration(), fluid.params().capacity,
                      static_cast<std::size_t>(fluid.params().count));
}

double wall_distance(const FluidParams& params, int wall, const Vector3& place, double piston) {
  const double moved = wall == params.piston ? piston : 0.0;
  return dot(normal_of(params, wall), place) - static_cast<double>(params.walls[wall].offset) -
         moved;
}

ReferenceWalls reference_walls(const FluidParams& params, const Vector3& place, double piston) {
  ReferenceWalls result;
  const std::vector<int> walls = open_walls(params, place, piston);
  double open = 1.0;
  for (const int k : walls) {
    const auto [share, fall] = layers_behind(params, k, wall_distance(params, k, place, piston));
    double others = 1.0;
    for (const int l : walls) {
      if (l == k) continue;
      others *= 1.0 - layers_behind(params, l, wall_distance(params, l, place, piston)).first;
    }
    result.gradient = result.gradient - others * fall * normal_of(params, k);
    open *= 1.0 - share;
  }
  result.share = 1.0 - open;
  return result;
}

std::vector<double> reference_density(const FluidState& s) {
  const double support = static_cast<double>(s.params.support);
  const double mass = static_cast<double>(s.params.mass);
  const double rest = static_cast<double>(s.params.rest_density);
  std::vector<double> density(s.position.size(), 0.0);
  for (std::size_t i = 0; i < density.size(); ++i) {
    for (const Vector3& other : s.position) {
      const Vector3 x = s.position[i] - other;
      if (dot(x, x) < support * support) density[i] += mass * kernel_value(length(x), support);
    }
    double share = 0.0;
    for (std::size_t b = 0; b < s.body_position.size(); ++b) {
      share += s.body_volume[b] * kernel_value(length(s.position[i] - s.body_position[b]), support);
    }
    density[i] += rest * share * reference_image(s, s.position[i]).factor;
    density[i] += rest * reference_walls(s.params, s.position[i], s.piston).share;
  }
  return density;
}

double reference_peak_density(const FluidParams& params, double dt, double density, double before) {
  if (density < static_cast<double>(params.torn_density)) return density;
  if (density >= before) return std::min(density, static_cast<double>(params.rest_density));
  return before - static_cast<double>(SPLASH_STRETCH_FADES) * dt * (before - density);
}

double reference_pressure_term(const FluidParams& params, double density, double peak) {
  const double sound = static_cast<double>(params.sound_speed);
  const double rest = static_cast<double>(params.rest_density);
  if (density > rest) return sound * sound * (density - rest) / (density * density);
  if (density > peak) return 0.0;
  return static_cast<double>(SPLASH_STRETCH_STIFFNESS) * sound * sound * (density - peak) /
         (rest * rest);
}

std::vector<ReferenceAcceleration> reference_acceleration(const FluidState& s) {
  const FluidParams& p = s.params;
  const double mass = static_cast<double>(p.mass);
  const double rest = static_cast<double>(p.rest_density);
  const double support = static_cast<double>(p.support);
  std::vector<ReferenceAcceleration> result(s.position.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto add = [&](const Vector3& term) {
      result[i].value = result[i].value + term;
      result[i].scale += length(term);
    };
    const double own = s.pressure_term[i];
    for (std::size_t j = 0; j < s.position.size(); ++j) {
      add(pair_push(s, i, s.position[j], s.velocity[j], mass, own, s.pressure_term[j]));
    }
    const ReferenceImage image = reference_image(s, s.position[i]);
    for (std::size_t b = 0; b < s.body_position.size(); ++b) {
      const Vector3& from = s.body_position[b];
      add(pair_push(s, i, from, s.body_velocity[b], rest * s.body_volume[b], image.factor * own,
                    0.0));
      add(-own * rest * s.body_volume[b] * kernel_value(length(s.position[i] - from), support) *
          image.gradient);
    }
    const ReferenceWalls walls = reference_walls(p, s.position[i], s.piston);
    add(-s.pressure_term[i] * rest * walls.gradient);
    add(vector(p.gravity_x, p.gravity_y, p.gravity_z));
    const Vector3 pull = vector(p.pull_x, p.pull_y, p.pull_z);
    const Vector3 way = vector(p.centre_x, p.centre_y, p.centre_z) - s.position[i];
    add({pull[0] * way[0], pull[1] * way[1], pull[2] * way[2]});
  }
  return result;
}

}  // namespace splash::sim
