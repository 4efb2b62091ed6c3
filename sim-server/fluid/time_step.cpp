// SPDX-License-Identifier: MIT
#include "sim-server/fluid/time_step.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"
#include "sim-server/scene/step_policy.hpp"

namespace splash::sim {
namespace {

constexpr double kLongest = 10.0e-3;  ///< [s]
constexpr double kForceCfl = 0.25;
constexpr double kViscous = 0.125;
/// However much longer a scene asks steps to be: beyond 0.160 nothing is stable
/// (step_limit_test.cpp).
constexpr double kMostViscous = 0.13;
/// Violent moments do not stretch a frame beyond this many steps: the push limit, which is about
/// accuracy, gives way; the acoustic one, which is about stability, never does.
constexpr double kLeastShare = 0.25;

}  // namespace

double largest_time_step(const FluidParams& params, double speed, double acceleration,
                         double factor) {
  const double support = static_cast<double>(params.support);
  const double h = static_cast<double>(params.length);
  const double nu = static_cast<double>(params.viscous + params.artificial) / 10.0;
  const double rubbing = h * h / std::max(nu, 1.0e-12);
  const double viscous = std::min(factor * kViscous, kMostViscous) * rubbing;
  if (params.solver == SPLASH_GRID_PROJECTED) {
    const double way =
        kGridAdvectiveCfl * static_cast<double>(params.spacing) / std::max(speed, 1.0e-9);
    // It knows no artificial viscosity.
    const double water = h * h / std::max(static_cast<double>(params.viscous) / 10.0, 1.0e-12);
    return std::min({std::min(factor, kLargestGridCfl) * way, factor * kLongest, kViscous * water});
  }
  const double sound = static_cast<double>(params.sound_speed);
  const double acoustic = kAcousticCfl * support / (sound + speed);
  const double push = kForceCfl * std::sqrt(h / std::max(acceleration, 1.0e-9));
  return std::min(factor * std::min(acoustic, std::max(push, kLeastShare * acoustic)), viscous);
}

double longest_possible_step(const FluidParams& params) {
  return StepPolicy::kLargestFactor * largest_time_step(params, 0.0, 0.0, 1.0);
}

FrameSteps steps_of_frame(double frame, double largest) {
  const int count = std::max(1, static_cast<int>(std::lround(frame / largest)));
  return {count, largest};
}

}  // namespace splash::sim
