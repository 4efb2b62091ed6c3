// SPDX-License-Identifier: MIT
#include "sim-server/gauge/water_state.hpp"

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

}  // namespace splash::sim
