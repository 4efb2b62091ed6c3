// SPDX-License-Identifier: MIT
#include "sim-server/serve/place_notice.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// A hand beside the tank is nothing to wonder at: not within the tank's largest edge of it, nor
/// within this [m].
constexpr double kBeside = 2.0;
/// But nobody reaches so far below the floor that the water stands on [m].
constexpr double kBelow = 0.25;

std::string length_text(double metres) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), metres < 10.0 ? "%.2f m" : "%.1f m", metres);
  return text.data();
}

}  // namespace

std::optional<std::string> far_off(const Tank& tank, const Vector3& place) {
  const double below = tank.lower[2] - place[2];
  double edge = kBeside;
  Vector3 outside = {};
  for (std::size_t i = 0; i < 3; ++i) {
    edge = std::max(edge, tank.upper[i] - tank.lower[i]);
    outside[i] = std::max({tank.lower[i] - place[i], place[i] - tank.upper[i], 0.0});
  }
  if (length(outside) > edge) return length_text(length(outside)) + " outside of the tank";
  if (below > kBelow) return length_text(below) + " below the tank's floor";
  return std::nullopt;
}

std::string in_metres(const Vector3& place) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%.2f %.2f %.2f m", place[0], place[1], place[2]);
  return text.data();
}

}  // namespace splash::sim
