// SPDX-License-Identifier: MIT
#include "tests/sim-server/detect/detect_reference.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

double volume_of_particle(const FluidParams& p) {
  return static_cast<double>(p.mass) / static_cast<double>(p.rest_density);
}

/// Share of the weight 1 - r^2 behind a plane at distance q [1]: of the ball's layers, each
/// pi / 2 (1 - s^2)^2, by Simpson's rule.
double share_behind(double q) {
  constexpr int kParts = 200;
  const double from = std::clamp(q, 0.0, 1.0);
  const double step = (1.0 - from) / kParts;
  double sum = 0.0;
  for (int k = 0; k <= kParts; ++k) {
    const double s = from + k * step;
    const double layer = (1.0 - s * s) * (1.0 - s * s);
    sum += layer * (k == 0 || k == kParts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0);
  }
  return 15.0 / 16.0 * sum * step / 3.0;
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
  return i;
}

}  // namespace

ReferenceTouch reference_touch(const FluidState& state, const std::vector<float>& water_density,
                               const Vector3& place) {
  const double support = static_cast<double>(state.params.support);
  const double volume = volume_of_particle(state.params);
  ReferenceTouch touch;
  for (std::size_t j = 0; j < state.position.size(); ++j) {
    const Vector3 away = place - state.position[j];
    if (dot(away, away) >= support * support) continue;
    const double weight = volume * kernel_value(length(away), support);
    touch.all_colour += weight;
    if (water_density[j] < static_cast<float>(kLeastDensity) * state.params.rest_density) {
      ++touch.passed_over;
      continue;
    }
    ++touch.seen;
    const Vector3 slope = volume * kernel_gradient(length(away), support) * away;
    touch.colour += weight;
    touch.gradient = touch.gradient + slope;
    touch.gradient_scale += length(slope);
    touch.water = touch.water + weight * state.velocity[j];
  }
  if (touch.colour > 0.0) touch.water = (1.0 / touch.colour) * touch.water;
  return touch;
}

double reference_mean_density(const FluidState& state, const std::vector<float>& water_density,
                              std::size_t i) {
  const double support = static_cast<double>(state.params.support);
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t j = 0; j < state.position.size(); ++j) {
    const double apart = length(state.position[i] - state.position[j]);
    if (apart >= support) continue;
    const double weight = kernel_value(apart, support);
    sum += weight * static_cast<double>(water_density[j]);
    weights += weight;
  }
  return sum / weights;
}

double reference_matter(const FluidState& state, const Vector3& place) {
  for (int k = 0; k < state.params.wall_count; ++k) {
    if (wall_distance(state.params, k, place, state.piston) <= 0.0) return 1.0;
  }
  const double support = static_cast<double>(state.params.support);
  double colour = reference_walls(state.params, place, state.piston).share;
  for (const Vector3& other : state.position) {
    const double apart = length(place - other);
    if (apart < support) colour += volume_of_particle(state.params) * kernel_value(apart, support);
  }
  return std::min(colour, 1.0);
}

ReferenceSum reference_upward(const FluidState& state, const std::vector<Vector3>& bubbles,
                              const Vector3& place) {
  const double support = static_cast<double>(state.params.support);
  const double volume = volume_of_particle(state.params);
  const double peak = plane_marginal(0.0, support);
  ReferenceSum sum;
  const auto add = [&](double term) {
    sum.value += term / peak;
    sum.scale += std::abs(term) / peak;
  };
  const auto add_point = [&](const Vector3& other, double weight) {
    const Vector3 away = place - other;
    add(weight * kernel_gradient(length(away), support) * away[2]);
  };
  for (const Vector3& other : state.position) add_point(other, volume);
  for (const Vector3& other : bubbles) add_point(other, volume);
  for (std::size_t b = 0; b < state.body_position.size(); ++b) {
    add_point(state.body_position[b], state.body_volume[b]);
  }
  add(reference_walls(state.params, place, state.piston).gradient[2]);
  return sum;
}

ReferenceEddies reference_eddies(const FluidState& state, std::size_t i, double reach) {
  const Vector3 place = state.position[i];
  const double norm = 15.0 / (8.0 * std::numbers::pi * reach * reach * reach);
  const auto weight = [&](const Vector3& other) {
    const Vector3 away = place - other;
    return std::max(1.0 - dot(away, away) / (reach * reach), 0.0);
  };
  double sum = 0.0;
  double squares = 0.0;
  Vector3 mean = {0.0, 0.0, 0.0};
  for (std::size_t j = 0; j < state.position.size(); ++j) {
    const double w = weight(state.position[j]);
    sum += w;
    mean = mean + w * state.velocity[j];
    squares += w * dot(state.velocity[j], state.velocity[j]);
  }
  mean = (1.0 / sum) * mean;
  double matter = norm * volume_of_particle(state.params) * sum;
  for (std::size_t b = 0; b < state.body_position.size(); ++b) {
    matter += norm * state.body_volume[b] * weight(state.body_position[b]);
  }
  const FluidParams& p = state.params;
  double open = 1.0;
  for (int k = 0; k < p.wall_count; ++k) {
    const double d = wall_distance(p, k, place, state.piston);
    if (p.slope >= 0 && k == 0 && wall_distance(p, p.slope, place, state.piston) < d) continue;
    if (p.slope >= 0 && k == p.slope && wall_distance(p, 0, place, state.piston) <= d) continue;
    open *= 1.0 - share_behind(d / reach);
  }
  return {0.5 * (squares / sum - dot(mean, mean)), open - matter};
}

Vector3 reference_water_velocity(const FluidState& state, const Vector3& place) {
  const double support = static_cast<double>(state.params.support);
  Vector3 sum = {0.0, 0.0, 0.0};
  double weights = 0.0;
  for (std::size_t j = 0; j < state.position.size(); ++j) {
    const double weight = kernel_value(length(place - state.position[j]), support);
    weights += weight;
    sum = sum + weight * state.velocity[j];
  }
  return weights > 0.0 ? (1.0 / weights) * sum : sum;
}

double reference_bubble_colour(const FluidParams& params, const std::vector<Vector3>& bubbles,
                               std::size_t i) {
  const double support = static_cast<double>(params.support);
  double colour = 0.0;
  for (std::size_t j = 0; j < bubbles.size(); ++j) {
    if (j == i) continue;
    colour += volume_of_particle(params) * kernel_value(length(bubbles[i] - bubbles[j]), support);
  }
  return colour;
}

std::vector<Vector3> as_floats(std::vector<Vector3> places) {
  for (Vector3& place : places) {
    for (double& x : place) x = static_cast<double>(static_cast<float>(x));
  }
  return places;
}

std::vector<int> reference_groups(const std::vector<Vector3>& places, double reach,
                                  const std::vector<bool>& seed) {
  std::vector<int> parent(places.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (length(places[i] - places[j]) >= reach) continue;
      const int a = root_of(parent, static_cast<int>(i));
      const int b = root_of(parent, static_cast<int>(j));
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<bool> seeded(places.size(), false);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (seed[i]) seeded[static_cast<std::size_t>(root_of(parent, static_cast<int>(i)))] = true;
  }
  std::vector<int> groups(places.size(), -1);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int root = root_of(parent, static_cast<int>(i));
    if (seeded[static_cast<std::size_t>(root)]) groups[i] = root;
  }
  return groups;
}

}  // namespace splash::sim
