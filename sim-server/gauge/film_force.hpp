// SPDX-License-Identifier: MIT
// The push of the film between a body and the walls and bodies that it touches, in double
// precision: what fluid/free_bodies/body_film.cl says and computes for free bodies, for any body.
// What free bodies that touch each other share is left out.
#pragma once

#include <span>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/free_bodies/films.hpp"
#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// All that a body may touch.
struct Solids {
  const Scene& scene;
  Tank tank;                          ///< with the wave maker's wall where its piston is
  std::span<const BodyState> states;  ///< of all bodies
};

/// `water` has pressures; `points`: of all bodies; `skin`: of this one; `body`: its number.
[[nodiscard]] BodyForce film_force(const WaterState& water, const Solids& solids,
                                   std::span<const BodyPoint> points,
                                   std::span<const SkinFace> skin, std::size_t body);

}  // namespace splash::sim
