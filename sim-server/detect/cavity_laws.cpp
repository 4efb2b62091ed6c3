// SPDX-License-Identifier: MIT
#include "sim-server/detect/cavity_laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::sim {
namespace {

constexpr double kAtmosphere = 101325.0;  // [Pa]
constexpr double kHeatRatio = 1.4;        // of air [1]
constexpr double kMinnaert = 3.26;        // f0 r of large bubbles near the surface [m/s]
constexpr double kRayleigh = 0.915;       // collapse of an empty sphere, in r sqrt(rho / p) [1]
constexpr double kLeastExcitation = 0.002;
constexpr double kMostExcitation = 0.1;

}  // namespace

double closing_time(double radius, double gravity) {
  return 2.285 * std::sqrt(radius / gravity);
}

double closed_volume(double radius, double speed, double gravity, double coefficient) {
  const double root = speed / std::sqrt(gravity * radius);  // of Fr
  return coefficient * radius * radius * radius * root * (1.0 + 0.26 * root);
}

double sphere_radius(double volume) {
  return std::cbrt(0.75 * volume / std::numbers::pi);
}

double ring_excitation(double volume, double closing, double depth, double density,
                       double gravity) {
  const double radius = sphere_radius(volume);
  const double rate = 2.0 * std::numbers::pi * kMinnaert / radius;
  const double fastest = volume * std::sqrt(gravity * depth) / (kRayleigh * radius);
  const double sealed = density * gravity * depth / (3.0 * kHeatRatio * kAtmosphere);
  const double collapse = std::min(std::abs(closing), fastest) / (3.0 * volume * rate);
  return std::clamp(std::hypot(sealed, collapse), kLeastExcitation, kMostExcitation);
}

double ring_life(double radius, double depth, double gravity) {
  return depth / (0.71 * std::sqrt(2.0 * gravity * radius));
}

}  // namespace splash::sim
