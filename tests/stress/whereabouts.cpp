// SPDX-License-Identifier: MIT
#include "tests/stress/whereabouts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim-server/fluid/health/health.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::stress {
namespace {

using sim::operator-;

sim::Vector3 place_of(const sim::Snapshot& water, std::size_t stride, std::size_t i) {
  return {static_cast<double>(water.position[i]), static_cast<double>(water.position[stride + i]),
          static_cast<double>(water.position[2 * stride + i])};
}

std::size_t stride_of(sim::Simulation& simulation) {
  return static_cast<std::size_t>(simulation.fluid().params().capacity);
}

}  // namespace

bool nobody_lost(sim::Simulation& simulation) {
  const sim::Snapshot water = simulation.fluid().snapshot();
  const sim::HealthLimits box = sim::health_limits(simulation.fluid().params());
  std::vector<int> ids = water.id;
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] != static_cast<int>(i)) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t at = axis * stride_of(simulation) + i;
      const bool inside =
          water.position[at] >= box.lower[axis] && water.position[at] <= box.upper[axis];
      if (!inside || !std::isfinite(water.velocity[at])) return false;
    }
  }
  return true;
}

double deepest_inside(sim::Simulation& simulation) {
  const sim::Snapshot water = simulation.fluid().snapshot();
  const std::vector<sim::BodySettings>& bodies = simulation.scene().bodies;
  double deepest = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const sim::BodyState now = simulation.bodies().state(b, simulation.seconds());
    for (std::size_t i = 0; i < water.id.size(); ++i) {
      const sim::Vector3 way = place_of(water, stride_of(simulation), i) - now.position;
      const sim::Vector3 own = sim::rotate(sim::inverse(now.rotation), way);
      deepest = std::max(deepest, -sim::distance_to(bodies[b].shape, own));
    }
  }
  return deepest;
}

double mean_height(sim::Simulation& simulation) {
  const sim::Snapshot water = simulation.fluid().snapshot();
  double sum = 0.0;
  for (std::size_t i = 0; i < water.id.size(); ++i) {
    sum += place_of(water, stride_of(simulation), i)[2];
  }
  return sum / static_cast<double>(water.id.size());
}

}  // namespace splash::stress
