// SPDX-License-Identifier: MIT
#include "sim-server/fluid/set_up.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/lattice.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/step_policy.hpp"

namespace splash::sim {
namespace {

/// Spray may rise this far above the tank before it shares the topmost cells [m].
constexpr double kHeadroom = 0.5;

/// Index of the slope among the walls: after the floor and the four sides.
constexpr int kSlopeWall = 5;

WallPlane wall(double nx, double ny, double nz, double offset) {
  return {static_cast<float>(nx), static_cast<float>(ny), static_cast<float>(nz),
          static_cast<float>(offset)};
}

/// Cells over the tank and its headroom, with a margin cell on each side.
void lay_grid(const Scene& scene, double support, FluidParams& params) {
  const Vector3 lower = scene.tank.lower;
  Vector3 upper = scene.tank.upper;
  upper[2] += kHeadroom;
  const auto cells = [&](std::size_t axis) {
    return static_cast<int>(std::ceil((upper[axis] - lower[axis]) / support)) + 2;
  };
  params.cells_x = cells(0);
  params.cells_y = cells(1);
  params.cells_z = cells(2);
  const double total =
      static_cast<double>(SPLASH_SLICES) * params.cells_x * params.cells_y * params.cells_z;
  if (total > 64.0e6) {
    throw std::runtime_error("the tank needs " + std::to_string(static_cast<long long>(total)) +
                             " grid cells, 64 million are allowed; make the tank smaller or the "
                             "particle spacing larger");
  }
  params.origin_x = static_cast<float>(lower[0] - support);
  params.origin_y = static_cast<float>(lower[1] - support);
  params.origin_z = static_cast<float>(lower[2] - support);
}

/// As kernels know it.
int number_of(PressureKind solver) {
  switch (solver) {
    case PressureKind::weakly_compressible:
      return SPLASH_WEAKLY_COMPRESSIBLE;
    case PressureKind::grid_projected:
      return SPLASH_GRID_PROJECTED;
  }
  return SPLASH_WEAKLY_COMPRESSIBLE;
}

/// To where a particle of a standing column comes by the weight of what is above it. `stratified`:
/// the water's stratification [1/m].
double sunk(const Scene& scene, double stratified, const Vector3& x) {
  const WaterColumn column = water_column(scene, x);
  const double z = x[2] - column.bottom;
  const double above = column.top - x[2];
  return x[2] - stratified * std::max(z, 0.0) * std::max(above, 0.0) / 2.0;
}

void set_pull(const FluidSettings& fluid, FluidParams& p) {
  const auto squared = [&](std::size_t axis) {
    return static_cast<float>(fluid.pull[axis] * fluid.pull[axis]);
  };
  p.pull_x = squared(0);
  p.pull_y = squared(1);
  p.pull_z = squared(2);
  p.centre_x = static_cast<float>(fluid.pull_centre[0]);
  p.centre_y = static_cast<float>(fluid.pull_centre[1]);
  p.centre_z = static_cast<float>(fluid.pull_centre[2]);
}

}  // namespace

double scene_support(const Scene& scene) {
  return kSupportSpacings * particle_spacing(scene);
}

std::vector<WallPlane> tank_walls(const Scene& scene) {
  const Vector3& a = scene.tank.lower;
  const Vector3& b = scene.tank.upper;
  std::vector<WallPlane> walls = {wall(0, 0, 1, a[2]), wall(1, 0, 0, a[0]), wall(-1, 0, 0, -b[0]),
                                  wall(0, 1, 0, a[1]), wall(0, -1, 0, -b[1])};
  if (scene.slope.present) {
    // The plane z = lower.z + gradient (x - foot).
    const double scale = 1.0 / std::hypot(scene.slope.gradient, 1.0);
    walls.push_back(wall(-scene.slope.gradient * scale, 0.0, scale,
                         (a[2] - scene.slope.gradient * scene.slope.foot) * scale));
  }
  return walls;
}

WallPlane gate_wall(const Gate& gate, bool left) {
  const double side = left ? -1.0 : 1.0;
  return wall(side, 0, 0, side * gate.x);
}

std::vector<Vector3> settled(const Scene& scene, std::vector<Vector3> particles, double sound_speed,
                             const std::vector<SupportState>& support_states) {
  const double stratified = stratification(scene, sound_speed);
  if (stratified == 0.0) return particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const bool hangs = i < support_states.size() && support_states[i] == SupportState::free_falling;
    if (!hangs) particles[i][2] = sunk(scene, stratified, particles[i]);
  }
  return particles;
}

FluidParams make_params(const Scene& scene, const std::vector<Vector3>& particles) {
  return make_params(scene, particles, scene_sound_speed(scene));
}

FluidParams make_params(const Scene& scene, const std::vector<Vector3>& particles,
                        double sound_speed) {
  const double spacing = particle_spacing(scene);
  const double support = scene_support(scene);
  FluidParams p = {};
  p.count = static_cast<int>(particles.size());
  lay_grid(scene, support, p);
  p.support = static_cast<float>(support);
  p.inverse_support = static_cast<float>(1.0 / support);
  p.inverse_cell = p.inverse_support;
  p.length = static_cast<float>(kLengthOfSupport * support);
  p.least_density = static_cast<float>(kLeastDensity * scene.fluid.density);
  p.torn_density = static_cast<float>(kTornDensity * scene.fluid.density);
  p.kernel_norm = static_cast<float>(kernel_norm(support));
  const double volume = particle_volume(scene);
  p.mass =
      static_cast<float>((1.0 + compression(scene, sound_speed)) * scene.fluid.density * volume);
  p.rest_density = static_cast<float>(scene.fluid.density);
  p.sound_speed = static_cast<float>(sound_speed);
  p.viscous = static_cast<float>(10.0 * scene.fluid.viscosity);
  p.artificial =
      static_cast<float>(scene.fluid.artificial * sound_speed * kLengthOfSupport * support);
  p.gravity_x = static_cast<float>(scene.fluid.gravity[0]);
  p.gravity_y = static_cast<float>(scene.fluid.gravity[1]);
  p.gravity_z = static_cast<float>(scene.fluid.gravity[2]);
  set_pull(scene.fluid, p);
  p.spacing = static_cast<float>(spacing);
  p.layer_weight = static_cast<float>(volume / (spacing * spacing));
  p.speed_limit = static_cast<float>(sound_speed);
  p.solver = number_of(scene.fluid.solver);
  p.wave_speed = static_cast<float>(longest_wave(scene));
  p.advective_cfl = static_cast<float>(kGridAdvectiveCfl *
                                       std::min(StepPolicy(scene.fluid).factor(), kLargestGridCfl));
  const auto walls = tank_walls(scene);
  p.pockets = scene.fluid.air_pockets ? 1 : 0;
  p.wall_count = static_cast<int>(walls.size());
  std::copy(walls.begin(), walls.end(), p.walls);
  p.piston = scene.wave_maker.present ? 1 : -1;
  p.slope = scene.slope.present ? kSlopeWall : -1;
  return p;
}

PistonState piston_at(const WaveMaker& maker, double seconds) {
  if (!maker.present || seconds <= 0.0) return {};
  const double omega = 2.0 * std::numbers::pi / maker.period;
  return {maker.stroke / 2.0 * (1.0 - std::cos(omega * seconds)),
          maker.stroke / 2.0 * omega * std::sin(omega * seconds)};
}

Tank tank_at(const Scene& scene, double seconds) {
  Tank tank = scene.tank;
  tank.lower[0] += piston_at(scene.wave_maker, seconds).offset;
  return tank;
}

}  // namespace splash::sim
