// SPDX-License-Identifier: MIT
#include "sim-server/scene/initial_fluid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "sim-server/scene/resolution.hpp"

namespace splash::sim {

namespace {

using Counts = std::array<int, 3>;

Vector3 edges(const WaterBlock& block) {
  Vector3 edge;
  for (std::size_t i = 0; i < 3; ++i) edge[i] = block.upper[i] - block.lower[i];
  return edge;
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

/// Layers along each axis that fill the block: the best of the roundings around the ideal.
Counts lattice(const Vector3& edge, double spacing) {
  constexpr int kReach = 2;
  Counts ideal;
  for (std::size_t i = 0; i < 3; ++i) {
    ideal[i] = std::max(1, static_cast<int>(std::lround(edge[i] / spacing)));
  }
  Counts best = ideal;
  for (int dz = -kReach; dz <= kReach; ++dz) {
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const Counts counts = {ideal[0] + dx, ideal[1] + dy, ideal[2] + dz};
        if (*std::min_element(counts.begin(), counts.end()) < 1) continue;
        if (lattice_cost(edge, counts, spacing) < lattice_cost(edge, best, spacing)) best = counts;
      }
    }
  }
  return best;
}

/// A world point in the frame of a body.
Vector3 to_body(const Keyframe& pose, const Vector3& point) {
  // v' = q* v q for a unit q: v + 2 u x (u x v) - 2 w (u x v), u the vector part.
  const auto& q = pose.rotation;
  const Vector3 v = {point[0] - pose.position[0], point[1] - pose.position[1],
                     point[2] - pose.position[2]};
  const auto cross = [](const Vector3& a, const Vector3& b) -> Vector3 {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vector3 u = {q[0], q[1], q[2]};
  const Vector3 uv = cross(u, v);
  const Vector3 uuv = cross(u, uv);
  Vector3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = v[i] + 2.0 * (uuv[i] - q[3] * uv[i]);
  return result;
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
        out.push_back({x, block.lower[1] + (j + 0.5) * dy, bottom + (k + 0.5) * dz});
      }
    }
  }
}

double box_distance(const Vector3& half, const Vector3& point) {
  Vector3 over;
  for (std::size_t i = 0; i < 3; ++i) over[i] = std::abs(point[i]) - half[i];
  const double inside = std::min(0.0, std::max({over[0], over[1], over[2]}));
  for (double& part : over) part = std::max(part, 0.0);
  return std::hypot(over[0], over[1], over[2]) + inside;
}

double cylinder_distance(double radius, double half_length, const Vector3& point) {
  const double side = std::hypot(point[0], point[1]) - radius;
  const double cap = std::abs(point[2]) - half_length;
  return std::hypot(std::max(side, 0.0), std::max(cap, 0.0)) + std::min(0.0, std::max(side, cap));
}

}  // namespace

double distance_to(const Shape& shape, const Vector3& point) {
  const Vector3 half = {0.5 * shape.size[0], 0.5 * shape.size[1], 0.5 * shape.size[2]};
  switch (shape.kind) {
    case ShapeKind::sphere:
      return std::hypot(point[0], point[1], point[2]) - half[0];
    case ShapeKind::cylinder:
      return cylinder_distance(half[0], half[2], point);
    case ShapeKind::box:
      break;
  }
  return box_distance(half, point);
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
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Vector3 local = to_body(poses[i], particle);
      if (distance_to(scene.bodies[i].shape, local) < 0.5 * spacing) return true;
    }
    return false;
  });
  return particles;
}

}  // namespace splash::sim
