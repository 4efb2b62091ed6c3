// SPDX-License-Identifier: MIT
// How a cuboid heaves in a square tank by the linear theory of waves: potential flow, its added
// mass, the waves that it makes and the walls that send them back.
#pragma once

#include "tests/validation/series.hpp"

namespace splash::validation {

/// A cuboid of square plan in the middle of a square tank [m].
struct Heave {
  double half_width = 0.0;  ///< of the cuboid
  double draft = 0.0;       ///< at rest; its mass is that of the water there
  double half_tank = 0.0;
  double depth = 0.0;
  double edge = 0.0;  ///< of the cells, of which all of these are whole numbers
};

/// Times at which it passes the place where it floats, let go above it at 0, until `end` [s].
[[nodiscard]] Column heave_passages(const Heave& heave, double end);

}  // namespace splash::validation
