// SPDX-License-Identifier: MIT
// The skin of a body: places all over its true surface, edges, corners and tips among them, each
// with its outward normal and the part of the surface that it stands for.
#pragma once

#include <vector>

#include "sim-server/fluid/params/boundary_point.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct SkinPoint {
  Vector3 place = {0.0, 0.0, 0.0};   ///< in body axes, from its centre [m]
  Vector3 normal = {0.0, 0.0, 1.0};  ///< unit vector out of the body, in body axes
  double area = 0.0;                 ///< of the surface that it stands for [m2]
  int owner = 0;                     ///< index of the body
};

/// Points no farther from the next than about `spacing` [m]. At an edge each face has points of
/// its own.
[[nodiscard]] std::vector<SkinPoint> sample_skin(const Shape& shape, int owner, double spacing);

/// The skins of all bodies of a scene, body after body: half a particle's spacing between points,
/// or as much as it takes for no more than about 4,000.
[[nodiscard]] std::vector<SkinPoint> sample_skins(const std::vector<BodySettings>& bodies,
                                                  double particle_spacing);

/// The skin that a film presses on (fluid/free_bodies/body_film.cl): its areas close, and enclose
/// the volume of the shape.
[[nodiscard]] std::vector<SkinFace> film_skin(const Shape& shape, int owner,
                                              double particle_spacing);

/// Of these bodies, of which the numbers count.
[[nodiscard]] std::vector<SkinFace> film_skins(const std::vector<BodySettings>& bodies,
                                               const std::vector<FreeBody>& of,
                                               double particle_spacing);
/// Of all bodies that the water moves.
[[nodiscard]] std::vector<SkinFace> film_skins(const std::vector<BodySettings>& bodies,
                                               double particle_spacing);

/// The largest area that each body shows along one of its own axes [m2].
[[nodiscard]] std::vector<double> faces_of(const std::vector<SkinPoint>& skin, std::size_t bodies);

}  // namespace splash::sim
