// SPDX-License-Identifier: MIT
#include "sim-server/fluid/settle.hpp"

#include <algorithm>

namespace splash::sim {
namespace {

/// Part of the time that comes first: particles slip past each other into a better packing.
constexpr double kLoose = 0.6;

/// Then all motion is stopped again and again after this long [s]: a quarter of the period in which
/// a column half a metre deep breathes, 4 H / c0, so that what it stores is taken as it comes out.
constexpr double kBetweenStops = 0.025;

constexpr int kTold = 8;  ///< steps between two words on how far it is

}  // namespace

void settle(Fluid& fluid, const std::vector<BodyStep>& bodies, double piston, double seconds,
            double dt, const Progress& tell) {
  std::vector<BodyStep> still = bodies;
  for (BodyStep& body : still) {
    body.vx = body.vy = body.vz = 0.0F;
    body.wx = body.wy = body.wz = body.speed = 0.0F;
  }
  fluid.set_bodies(still);
  const Step step = {dt, piston, 0.0, 0};
  const int steps = static_cast<int>(seconds / dt);
  const int between = std::max(1, static_cast<int>(kBetweenStops / dt));
  for (int k = 0; k < steps; ++k) {
    if (tell && k % kTold == 0) {
      fluid.device().queue().finish();
      tell(static_cast<double>(k) / steps);
    }
    fluid.prepare(step);
    fluid.advance(step);
    if (k > kLoose * steps && k % between == 0) fluid.still();
  }
  fluid.still();
}

}  // namespace splash::sim
