// SPDX-License-Identifier: MIT
#include "sim-server/detect/air_account.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::sim {
namespace {

constexpr double kRecent = 0.1;             ///< [s]
constexpr double kEddiesLast = 1.0;         ///< [s]
constexpr double kLargestOfLittle = 0.008;  ///< [m]

}  // namespace

double bubble_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

double AirAccount::own_loss(double lost, double work, double frame) {
  given_ = given_ * std::exp(-frame / kEddiesLast) + work;
  const double of_bodies = std::min(lost, given_);
  given_ -= of_bodies;
  return lost - of_bodies;
}

void AirAccount::begin(double air, double frame) {
  recent_ = recent_ * std::exp(-frame / kRecent) + air;
}

double AirAccount::largest(const DetectSettings& settings) const {
  const double least = std::max(kLargestOfLittle, 2.0 * settings.radius_min);
  const double pocket = std::cbrt(0.75 / std::numbers::pi * recent_);
  return std::min(std::max(pocket, least), settings.radius_max);
}

void AirAccount::keep(double most) {
  owed_ = std::min(owed_, most);
}

}  // namespace splash::sim
