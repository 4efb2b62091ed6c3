// SPDX-License-Identifier: MIT
// A rigid body as points: a lattice that fills its shape as the water it displaces would, so that
// density and pressure at its surface are those of the fluid. Its surface are the points in the
// lowest levels of its own colour field c_r (paper, section 5.1.2).
#pragma once

#include <vector>

#include "sim-server/fluid/params/boundary_point.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct BodyPoint : BoundaryPoint {
  Vector3 skin = {0.0, 0.0, 0.0};  ///< the place carried outwards to the true surface, if the
                                   ///< point is in the outermost layer [m]
  double colour = 0.0;             ///< c_r: 1 deep inside, less towards the surface [1]
  bool surface = false;
};

/// The points of one shape, none farther from its neighbour than `spacing` [m], with colour and
/// surface marked for a kernel of that support [m]. A shape thinner than the spacing keeps
/// one layer.
[[nodiscard]] std::vector<BodyPoint> sample_shape(const Shape& shape, int owner, double spacing,
                                                  double support);

/// The points of all bodies of a scene, body after body.
[[nodiscard]] std::vector<BodyPoint> sample_bodies(const std::vector<BodySettings>& bodies,
                                                   double spacing, double support);

}  // namespace splash::sim
