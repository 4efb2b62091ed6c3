// SPDX-License-Identifier: MIT
#include "sim-server/scene/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "sim-server/scene/tank_motion.hpp"

namespace splash::sim {

namespace {

/// Integral over [a, b] of max(0, p + q x), exact.
double positive_area(double a, double b, double p, double q) {
  if (b <= a) return 0.0;
  const double left = p + q * a;
  const double right = p + q * b;
  if (left >= 0.0 && right >= 0.0) return 0.5 * (left + right) * (b - a);
  if (left <= 0.0 && right <= 0.0) return 0.0;
  const double root = -p / q;
  return left > 0.0 ? 0.5 * left * (root - a) : 0.5 * right * (b - root);
}

/// Part of its box that a form fills [1].
double fullness(WaterForm form) {
  switch (form) {
    case WaterForm::cylinder:
      return std::numbers::pi / 4.0;
    case WaterForm::sphere:
      return std::numbers::pi / 6.0;
    case WaterForm::box:
      break;
  }
  return 1.0;
}

double block_volume(const Scene& scene, const WaterBlock& block) {
  const double height = block.upper[2] - block.lower[2];
  const double width = block.upper[1] - block.lower[1];
  double left = block.lower[0];
  double area = 0.0;
  if (!scene.slope.present) return fullness(block.form) * height * width * (block.upper[0] - left);
  // Up to where the slope reaches the block's underside nothing is cut; from there the depth falls
  // linearly.
  const double gradient = scene.slope.gradient;
  const double cut = scene.slope.foot + (block.lower[2] - scene.tank.lower[2]) / gradient;
  const double whole = std::clamp(cut, left, block.upper[0]);
  area += height * (whole - left);
  left = whole;
  area += positive_area(left, block.upper[0], height + gradient * cut, -gradient);
  return area * width;
}

/// Energy per mass between the places of the block's box where the central field has most and least
/// of it [J/kg].
double pull_drop(const FluidSettings& fluid, const WaterBlock& block) {
  double drop = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double below = block.lower[i] - fluid.pull_centre[i];
    const double above = block.upper[i] - fluid.pull_centre[i];
    const double far = std::max(std::abs(below), std::abs(above));
    const double near = below * above <= 0.0 ? 0.0 : std::min(std::abs(below), std::abs(above));
    drop += 0.5 * fluid.pull[i] * fluid.pull[i] * (far * far - near * near);
  }
  return drop;
}

/// Square of the speed that the central field gives to what is at rest at `x`, where it is nearest
/// to the field's centre in the tank [m2/s2].
double pulled(const Scene& scene, const Vector3& x) {
  const FluidSettings& fluid = scene.fluid;
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double centre = fluid.pull_centre[i];
    const double near = std::clamp(centre, scene.tank.lower[i], scene.tank.upper[i]) - centre;
    const double far = x[i] - centre;
    most += fluid.pull[i] * fluid.pull[i] * std::max(far * far - near * near, 0.0);
  }
  return most;
}

}  // namespace

double floor_height(const Scene& scene, double x) {
  if (!scene.slope.present) return scene.tank.lower[2];
  return scene.tank.lower[2] + scene.slope.gradient * std::max(0.0, x - scene.slope.foot);
}

bool is_outside(const Scene& scene, const Vector3& x) {
  const Tank& tank = scene.tank;
  if (x[0] < tank.lower[0] || x[0] > tank.upper[0]) return true;
  if (x[1] < tank.lower[1] || x[1] > tank.upper[1]) return true;
  return x[2] < floor_height(scene, x[0]);
}

double water_volume(const Scene& scene) {
  double volume = 0.0;
  for (const auto& block : scene.water) volume += block_volume(scene, block);
  return volume;
}

double particle_spacing(const Scene& scene) {
  if (scene.fluid.spacing > 0.0) return scene.fluid.spacing;
  return std::cbrt(water_volume(scene) / scene.fluid.particles);
}

WaterColumn water_column(const Scene& scene, const Vector3& place) {
  const double gap = particle_spacing(scene);
  WaterColumn column = {place[2], place[2]};
  // Each turn adds the blocks that touch what there is: as many turns as there are blocks, at most.
  for (std::size_t turn = 0; turn < scene.water.size(); ++turn) {
    for (const WaterBlock& block : scene.water) {
      const bool over = place[0] >= block.lower[0] && place[0] <= block.upper[0] &&
                        place[1] >= block.lower[1] && place[1] <= block.upper[1];
      if (!over || block.lower[2] > column.top + gap || block.upper[2] < column.bottom - gap) {
        continue;
      }
      column.bottom = std::min(column.bottom, block.lower[2]);
      column.top = std::max(column.top, block.upper[2]);
    }
  }
  column.bottom = std::max(column.bottom, floor_height(scene, place[0]));
  return column;
}

double water_depth(const Scene& scene) {
  double deepest = 0.0;
  for (const WaterBlock& block : scene.water) {
    const Vector3 middle = 0.5 * (block.lower + block.upper);
    // Where the floor rises it is deepest at its foot.
    const Vector3 foot = {block.lower[0], middle[1], middle[2]};
    for (const Vector3& place : {middle, foot}) {
      const WaterColumn column = water_column(scene, place);
      deepest = std::max(deepest, column.top - column.bottom);
    }
  }
  return deepest;
}

double longest_wave(const Scene& scene) {
  double energy = strongest_field(scene) * water_depth(scene);
  for (const WaterBlock& block : scene.water) {
    energy = std::max(energy, pull_drop(scene.fluid, block));
  }
  return std::sqrt(energy);
}

double fastest_piston(const WaveMaker& maker) {
  return maker.present ? std::numbers::pi * maker.stroke / maker.period : 0.0;
}

double fastest_fall(const Scene& scene) {
  const Vector3& g = scene.fluid.gravity;
  // Down to the tank's floor, or to a side: what the potential can give, whatever is in between.
  const auto gained = [&](const Vector3& from) {
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool open = i == 2 && g[i] > 0.0;
      const double way = (g[i] < 0.0 ? scene.tank.lower[i] : scene.tank.upper[i]) - from[i];
      if (!open) most += 2.0 * std::max(g[i] * way, 0.0);
    }
    return most;
  };
  double fastest2 = 0.0;
  for (const BodySettings& body : scene.bodies) {
    if (!is_free(body)) continue;
    const double start = length(body.motion.velocity);
    fastest2 = std::max(fastest2, start * start + gained(body.rest.position));
  }
  for (const WaterBlock& block : scene.water) {
    double fall2 = pulled(scene, 0.5 * (block.lower + block.upper));
    // Only water that nothing holds falls as a whole: what stands on the floor flows off.
    if (block.lower[2] > floor_height(scene, block.lower[0])) fall2 += gained(block.lower);
    fastest2 = std::max(fastest2, fall2);
  }
  return std::sqrt(fastest2);
}

double slowest_sound(const Scene& scene) {
  constexpr double kDenser = 1.0 / 16.0;
  const double flow = scene.flow.kind == FlowKind::uniform ? length(scene.flow.velocity) : 0.0;
  const double fastest = std::max({fastest_fall(scene), flow, fastest_piston(scene.wave_maker)});
  return std::max(longest_wave(scene), fastest / std::numbers::sqrt2) / std::sqrt(kDenser);
}

double suitable_sound_speed(const Scene& scene, double fastest_body, double sound_factor) {
  // Monaghan 1994: density stays within (v/c)^2 of rest, so c should be ten times the fastest
  // speed. Eight times that of the fastest wave the depth allows (1.6 % at the floor) is what two
  // CPU cores carry in real time; the floor covers bodies of up to 1.3 m/s, whatever the depth.
  // Faster ones, and what falls faster, move at a Mach number of 0.3 at most, where stagnation
  // compresses by 5 %: below that a flow counts as incompressible (Anderson, Fundamentals of
  // Aerodynamics).
  constexpr double kRatio = 8.0;
  constexpr double kLeast = 13.0;
  constexpr double kMach = 0.3;
  const double fastest = std::max(
      {fastest_body, fastest_fall(scene), fastest_piston(scene.wave_maker), fastest_wall(scene)});
  const double slow = std::max(kRatio * longest_wave(scene), kLeast);
  return std::max(sound_factor * slow, fastest / kMach);
}

double scene_sound_speed(const Scene& scene, double fastest_body) {
  if (scene.fluid.sound_speed > 0.0) return scene.fluid.sound_speed;
  return suitable_sound_speed(scene, fastest_body, StepPolicy::sound_factor(scene.fluid));
}

double stratification(const Scene& scene, double sound_speed) {
  const Vector3& g = scene.fluid.gravity;
  const bool falls_down = g[0] == 0.0 && g[1] == 0.0 && g[2] < 0.0;
  if (!falls_down || scene.fluid.solver != PressureKind::weakly_compressible) return 0.0;
  return -g[2] / (sound_speed * sound_speed);
}

double compression(const Scene& scene, double sound_speed) {
  return stratification(scene, sound_speed) * water_depth(scene) / 2.0;
}

}  // namespace splash::sim
