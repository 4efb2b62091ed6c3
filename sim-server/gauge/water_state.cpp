// SPDX-License-Identifier: MIT
#include "sim-server/gauge/water_state.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

void read_images(Fluid& fluid, WaterState& water) {
  const std::size_t count = water.position.size();
  water.image.assign(count, 1.0);
  water.slope.assign(count, {0.0, 0.0, 0.0});
  if (fluid.boundary().body_count() == 0) return;
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  const std::vector<float> parts = fluid.body_images().read(fluid.device(), 4 * stride);
  for (std::size_t i = 0; i < count; ++i) {
    water.image[i] = static_cast<double>(parts[i]);
    water.slope[i] = vector_at(parts, stride, stride + i);
  }
}

void read_pressures(Fluid& fluid, WaterState& water) {
  const std::size_t count = water.position.size();
  const std::vector<float> density = fluid.density().read(fluid.device(), count);
  const std::vector<float> term = fluid.pressure_term().read(fluid.device(), count);
  const std::vector<float> peak = fluid.peak_density().read(fluid.device(), count);
  water.density.assign(density.begin(), density.end());
  water.peak_density.assign(peak.begin(), peak.end());
  water.pressure.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    water.pressure[i] = static_cast<double>(term[i]) * water.density[i] * water.density[i];
  }
  read_images(fluid, water);
}

constexpr auto kStretchStiffness = static_cast<double>(SPLASH_STRETCH_STIFFNESS);

}  // namespace

Vector3 WaterState::field_at(const Vector3& place) const {
  Vector3 field = gravity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    field[axis] -= pull[axis] * (place[axis] - pull_centre[axis]);
  }
  return field;
}

double WaterState::potential_at(const Vector3& place) const {
  double potential = -dot(gravity, place);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double way = place[axis] - pull_centre[axis];
    potential += 0.5 * pull[axis] * way * way;
  }
  return potential;
}

WaterState read_water(Fluid& fluid, bool pressures) {
  const FluidParams& p = fluid.params();
  const Snapshot snapshot = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(p.capacity);
  const std::size_t count = snapshot.id.size();
  WaterState water;
  water.position = as_vectors(snapshot.position, stride, count);
  water.velocity = as_vectors(snapshot.velocity, stride, count);
  if (pressures) read_pressures(fluid, water);
  water.mass = static_cast<double>(p.mass);
  water.spacing = static_cast<double>(p.spacing);
  water.support = static_cast<double>(p.support);
  water.rest_density = static_cast<double>(p.rest_density);
  // What keeps the spacing of grid-projected water is no energy of it.
  water.sound_speed = p.solver == SPLASH_GRID_PROJECTED ? 0.0 : static_cast<double>(p.sound_speed);
  // As in leapfrog, velocities belong to the middle of the step and positions to its end. Only the
  // grid's steps are long enough for this to matter.
  water.lag = p.solver == SPLASH_GRID_PROJECTED ? 0.5 * fluid.last_step() : 0.0;
  water.viscous = static_cast<double>(p.viscous);
  water.artificial = static_cast<double>(p.artificial);
  water.point_weight = static_cast<double>(p.layer_weight) / water.spacing;
  water.gravity = vector(p.gravity_x, p.gravity_y, p.gravity_z);
  water.pull = vector(p.pull_x, p.pull_y, p.pull_z);
  water.pull_centre = vector(p.centre_x, p.centre_y, p.centre_z);
  return water;
}

double compression_energy(const WaterState& water, double density, double peak) {
  const double sound2 = water.sound_speed * water.sound_speed;
  const double stretch = std::max(peak - density, 0.0) / water.rest_density;
  if (density <= water.rest_density) return 0.5 * kStretchStiffness * sound2 * stretch * stretch;
  const double push = water.rest_density / density - 1.0;
  // ln(rho/rho0) = -log1p(push): no difference of numbers close to one.
  return sound2 * (push - std::log1p(push));
}

Energies energies(const WaterState& water) {
  Energies sum;
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    sum.kinetic += 0.5 * water.mass * dot(water.velocity[i], water.velocity[i]);
    sum.potential +=
        water.mass * water.potential_at(water.position[i] - water.lag * water.velocity[i]);
    sum.compression +=
        water.mass * compression_energy(water, water.density[i], water.peak_density[i]);
  }
  return sum;
}

Momentum momentum(const WaterState& water) {
  Momentum result;
  double square = 0.0;
  for (const Vector3& v : water.velocity) {
    result.sum = result.sum + water.mass * v;
    square += dot(v, v);
    result.fastest = std::max(result.fastest, length(v));
  }
  result.rms =
      std::sqrt(square / std::max<double>(1.0, static_cast<double>(water.velocity.size())));
  return result;
}

Spread spread(const WaterState& water) {
  Spread result;
  if (water.position.empty()) return result;
  const double share = 1.0 / static_cast<double>(water.position.size());
  for (const Vector3& x : water.position) result.centre = result.centre + share * x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double square = 0.0;
    for (const Vector3& x : water.position) {
      const double from = x[axis] - result.centre[axis];
      square += from * from;
    }
    result.deviation[axis] = std::sqrt(share * square);
  }
  return result;
}

}  // namespace splash::sim
