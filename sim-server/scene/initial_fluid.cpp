// SPDX-License-Identifier: MIT
#include "sim-server/scene/initial_fluid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {

namespace {

using Counts = std::array<int, 3>;

Vector3 edges(const WaterBlock& block) {
  return block.upper - block.lower;
}

/// How far a lattice is from a cube of side `spacing` per particle: the number of particles counts
/// most, as it sets the mass of each, then the same spacing along every axis.
double lattice_cost(const Vector3& edge, const Counts& counts, double spacing) {
  constexpr double kNumberWeight = 30.0;
  double volume = 0.0;
  double shape = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double stretch = std::log(edge[i] / counts[i] / spacing);
    volume += stretch;
    shape += stretch * stretch;
  }
  return kNumberWeight * volume * volume + shape;
}

/// Whole numbers on both sides of `count`, none below one.
std::array<int, 2> around(double count) {
  const int below = std::max(1, static_cast<int>(std::floor(count)));
  return {below, below + 1};
}

/// Layers along each axis that fill the block. What rounding a thin axis takes or gives, the next
/// longer one makes up for, so that the number of particles is kept.
Counts lattice(const Vector3& edge, double spacing) {
  std::array<std::size_t, 3> axis = {0, 1, 2};
  std::sort(axis.begin(), axis.end(),
            [&](std::size_t a, std::size_t b) { return edge[a] < edge[b]; });
  const auto [thin, middle, wide] = axis;
  const double volume = spacing * spacing * spacing;
  Counts best = {};
  double lowest = std::numeric_limits<double>::infinity();
  for (const int thin_count : around(edge[thin] / spacing)) {
    const double thin_step = edge[thin] / thin_count;
    for (const int middle_count : around(edge[middle] / std::sqrt(volume / thin_step))) {
      const double area = thin_step * edge[middle] / middle_count;
      for (const int wide_count : around(edge[wide] * area / volume)) {
        Counts counts;
        counts[thin] = thin_count;
        counts[middle] = middle_count;
        counts[wide] = wide_count;
        const double cost = lattice_cost(edge, counts, spacing);
        if (cost < lowest) best = counts;
        lowest = std::min(cost, lowest);
      }
    }
  }
  return best;
}

/// Appends one block. On the slope each column of particles begins half a layer above it, so that
/// none is too close to the floor and the water's volume is kept within half a layer.
void fill(const Scene& scene, const WaterBlock& block, double spacing, std::vector<Vector3>& out) {
  const Vector3 edge = edges(block);
  const Counts counts = lattice(edge, spacing);
  const double dx = edge[0] / counts[0];
  const double dy = edge[1] / counts[1];
  const double dz = edge[2] / counts[2];
  for (int k = 0; k < counts[2]; ++k) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        const double x = block.lower[0] + (i + 0.5) * dx;
        const double bottom = std::max(block.lower[2], floor_height(scene, x));
        if (k >= std::lround((block.upper[2] - bottom) / dz)) continue;
        const Vector3 place = {x, block.lower[1] + (j + 0.5) * dy, bottom + (k + 0.5) * dz};
        if (is_filled(block, place)) out.push_back(place);
      }
    }
  }
}

}  // namespace

bool is_filled(const WaterBlock& block, const Vector3& place) {
  if (block.form == WaterForm::box) return true;
  Vector3 share = {};  // from the middle, in half edges
  for (std::size_t i = 0; i < 3; ++i) {
    const double half = 0.5 * (block.upper[i] - block.lower[i]);
    share[i] = (place[i] - block.lower[i]) / half - 1.0;
  }
  if (block.form == WaterForm::cylinder) share[1] = 0.0;
  return std::hypot(share[0], share[1], share[2]) <= 1.0;
}

bool is_displaced(const Scene& scene, std::span<const Keyframe> poses, const Vector3& place,
                  double spacing) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector3 local = rotate(inverse(poses[i].rotation), place - poses[i].position);
    if (distance_to(scene.bodies[i].shape, local) < 0.5 * spacing) return true;
  }
  return false;
}

std::vector<Vector3> initial_particles(const Scene& scene) {
  std::vector<Keyframe> poses;
  for (const auto& body : scene.bodies) poses.push_back(body.rest);
  return initial_particles(scene, poses);
}

std::vector<Vector3> initial_particles(const Scene& scene, std::span<const Keyframe> poses) {
  if (poses.size() != scene.bodies.size()) {
    throw std::invalid_argument("initial_particles: one pose for each body");
  }
  const double spacing = particle_spacing(scene);
  std::vector<Vector3> particles;
  for (const auto& block : scene.water) fill(scene, block, spacing, particles);
  std::erase_if(particles, [&](const Vector3& particle) {
    return is_displaced(scene, poses, particle, spacing);
  });
  return particles;
}

}  // namespace splash::sim
