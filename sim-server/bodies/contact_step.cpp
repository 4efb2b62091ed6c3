// SPDX-License-Identifier: MIT
#include "sim-server/bodies/contact_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {

double longest_contact_step(const std::vector<BodySettings>& bodies, double gravity) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double rounding = kNever;
  int meet = 0;
  bool free = false;
  for (const BodySettings& body : bodies) {
    if (body.shape.kind == ShapeKind::mesh) continue;  // they go through all others
    ++meet;
    free = free || is_free(body);
    if (!has_edges(body.shape)) continue;  // as round as it can be
    const Vector3& size = body.shape.size;
    const double least = 0.5 * std::min({size[0], size[1], size[2]});
    rounding = std::min(rounding, static_cast<double>(SPLASH_ROUNDED) * least);
  }
  return free && meet > 1 && gravity > 0.0 ? std::sqrt(0.5 * rounding / gravity) : kNever;
}

}  // namespace splash::sim
