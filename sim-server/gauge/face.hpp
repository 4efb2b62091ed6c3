// SPDX-License-Identifier: MIT
// The face of a pressure sensor that is let into a wall or a body: a disc, weighted towards its
// middle.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// All that sensors can be let into. The slope of a sloped floor is not among it.
struct Surfaces {
  Tank tank;
  double slope_from = 0.0;  ///< x from which on the tank's floor is under a slope [m]
  std::span<const BodySettings> bodies;
  std::span<const BodyState> states;  ///< of all of them
  int only = -1;                      ///< the one body that counts; -1: all that there is
};

struct Face {
  Vector3 place = {0.0, 0.0, 0.0};   ///< its middle [m]
  Vector3 normal = {0.0, 0.0, 1.0};  ///< into the water, unit length
  double radius = 0.0;               ///< [m]
  int body = -1;                     ///< which one it is let into; -1: a wall
  double cover = 1.0;  ///< share of its weight that is on the surface: less at an edge [1]
  Vector3 middle = {0.0, 0.0, 0.0};  ///< of that share [m]
};

/// Weight of a place `r` [m] from the middle of a face: 3 / (pi a^2) (1 - (r/a)^2)^2, of integral 1
/// [1/m2].
[[nodiscard]] double face_weight(double r, double radius);

/// The face at `place` [m] if that is within `reach` [m] of a surface, of the nearest one.
[[nodiscard]] std::optional<Face> face_at(const Vector3& place, const Surfaces& surfaces,
                                          double reach, double radius);

/// Places that share a disc around the middle of a face evenly: each stands for as much of its
/// area, and the mean over them is that over the disc for what changes linearly across it. Those
/// beyond the tank are left out.
[[nodiscard]] std::vector<Vector3> disc_on(const Face& face, double radius, const Tank& tank);

}  // namespace splash::sim
