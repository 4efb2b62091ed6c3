// SPDX-License-Identifier: MIT
#include "sim-server/bodies/mass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {

double mass_of(const BodySettings& body) {
  if (body.motion.mass > 0.0) return body.motion.mass;
  return body.motion.density * volume_of(body.shape);
}

std::vector<FreeBody> free_bodies(const std::vector<BodySettings>& bodies) {
  std::vector<FreeBody> all;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodySettings& body = bodies[b];
    if (!is_free(body)) continue;
    const double mass = mass_of(body);
    const bool own = body.motion.inertia[0] > 0.0;
    const Vector3 inertia = own ? body.motion.inertia : inertia_of(body.shape, mass);
    const Quaternion axes = own ? Quaternion{0.0, 0.0, 0.0, 1.0} : principal_axes(body.shape);
    // It turns on its spring as fast as it swings on it, on the mean over its axes.
    const double lever2 = (inertia[0] + inertia[1] + inertia[2]) / (3.0 * mass);
    const double spring = body.motion.stiffness;
    const double damper = body.motion.damping;
    all.push_back({static_cast<int>(b), static_cast<float>(mass), static_cast<float>(inertia[0]),
                   static_cast<float>(inertia[1]), static_cast<float>(inertia[2]),
                   static_cast<float>(length(body.shape.size) / 2.0),
                   static_cast<float>(body.motion.restitution),
                   static_cast<float>(body.motion.friction), static_cast<float>(axes[0]),
                   static_cast<float>(axes[1]), static_cast<float>(axes[2]),
                   static_cast<float>(axes[3]), static_cast<float>(spring),
                   static_cast<float>(damper), static_cast<float>(lever2 * spring),
                   static_cast<float>(lever2 * damper), body.motion.held});
  }
  return all;
}

std::vector<FreeBody> felt_bodies(const std::vector<BodySettings>& bodies,
                                  const std::set<std::size_t>& measured) {
  std::vector<FreeBody> all;
  const auto add = [&](std::size_t body) {
    FreeBody felt = {};
    felt.body = static_cast<int>(body);
    felt.size = static_cast<float>(length(bodies[body].shape.size) / 2.0);
    all.push_back(felt);
  };
  for (const std::size_t body : measured) add(body);
  for (const bool tracked : {true, false}) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const bool follows = bodies[b].motion.kind == MotionKind::osc && !is_tied(bodies[b]);
      if (measured.contains(b) || (tracked ? !follows : !is_grabbable(bodies[b]))) continue;
      if (all.size() < static_cast<std::size_t>(kFreeBodiesMax)) add(b);
    }
  }
  return all;
}

double longest_contact_step(const std::vector<BodySettings>& bodies, double gravity) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double of_free = kNever;  // least rounding of free bodies with edges [m]
  double of_others = kNever;
  int free = 0;
  for (const BodySettings& body : bodies) {
    if (!has_edges(body.shape)) continue;  // a ball has neither side nor top
    const Vector3& size = body.shape.size;
    const double least = 0.5 * std::min({size[0], size[1], size[2]});
    double& rounding = is_free(body) ? of_free : of_others;
    rounding = std::min(rounding, static_cast<double>(SPLASH_ROUNDED) * least);
    free += is_free(body) ? 1 : 0;
  }
  const bool meet = free > 1 || (free == 1 && of_others < kNever);
  const double rounding = std::min(of_free, of_others);
  return meet && gravity > 0.0 ? std::sqrt(0.5 * rounding / gravity) : kNever;
}

}  // namespace splash::sim
