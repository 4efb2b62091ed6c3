// SPDX-License-Identifier: MIT
#include "sim-server/detect/cavities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/smoothing.hpp"

namespace splash::sim {
namespace {

constexpr int kUnlabelled = std::numeric_limits<int>::max();
/// Rounds enqueued between two looks at whether anything changed.
constexpr int kRoundsAtOnce = 4;

struct Group {
  int bubbles = 0;
  int cavity = kUnlabelled;  ///< smallest serial of a known cavity among its bubbles
  double volume = 0.0;       ///< [m3]
  Vector3 sum = {0.0, 0.0, 0.0};
};

double radius_of(const Group& group, const DetectSettings& settings) {
  if (settings.cavity_by_count) return cavity_radius(group.bubbles, settings);
  return std::min(std::cbrt(3.0 / (4.0 * std::numbers::pi) * group.volume),
                  settings.cavity_radius_max);
}

/// Whether a group makes a cavity.
bool suffices(const Group& group, const DetectSettings& settings) {
  if (settings.cavity_by_count) return group.bubbles >= settings.cavity_bubbles_min;
  return radius_of(group, settings) >= settings.cavity_radius_min;
}

}  // namespace

double cavity_radius(int bubbles, const DetectSettings& settings) {
  const double range = std::max(settings.cavity_bubbles_max - settings.cavity_bubbles_min, 1);
  const double part = std::clamp((bubbles - settings.cavity_bubbles_min) / range, 0.0, 1.0);
  return settings.cavity_radius_min +
         part * (settings.cavity_radius_max - settings.cavity_radius_min);
}

double bubble_volume(double colour, const FluidParams& params) {
  const auto unit = static_cast<double>(params.mass / params.rest_density);
  return unit /
         (std::max(colour, 0.0) + unit * kernel_value(0.0, static_cast<double>(params.support)));
}

std::vector<DetectedCavity> name_cavities(std::vector<PoolBubble>& pool,
                                          const std::vector<int>& label, double time,
                                          const DetectSettings& settings, int& next_cavity) {
  std::map<int, Group> groups;
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (label[i] < 0) continue;
    Group& group = groups[label[i]];
    ++group.bubbles;
    group.volume += pool[i].volume;
    if (pool[i].cavity >= 0) group.cavity = std::min(group.cavity, pool[i].cavity);
    for (std::size_t axis = 0; axis < 3; ++axis) group.sum[axis] += pool[i].position[axis];
  }
  std::vector<DetectedCavity> fresh;
  for (auto& [first, group] : groups) {
    if (group.cavity != kUnlabelled || !suffices(group, settings)) continue;
    group.cavity = next_cavity++;
    DetectedCavity cavity;
    cavity.time = time;
    cavity.bubbles = group.bubbles;
    cavity.radius = radius_of(group, settings);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cavity.position[axis] = group.sum[axis] / group.bubbles;
    }
    fresh.push_back(cavity);
  }
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (label[i] < 0) continue;
    const Group& group = groups[label[i]];
    if (group.cavity != kUnlabelled) pool[i].cavity = group.cavity;
  }
  return fresh;
}

Cavities::Cavities(Fluid& fluid, const cl::Program& program, const DetectSettings& settings,
                   std::size_t room, bool search_always)
    : fluid_(fluid),
      settings_(settings),
      search_always_(search_always),
      label_(fluid.device(), room),
      grown_(fluid.device(), room),
      changed_(fluid.device(), 1),
      seed_cavities_(program, "seed_cavities"),
      grow_cavities_(program, "grow_cavities") {}

std::vector<int> Cavities::grow(const Bubbles& bubbles) {
  Device& device = fluid_.device();
  const auto count = static_cast<std::size_t>(bubbles.carried());
  seed_cavities_.run(device.queue(), count, bubbles.carried(),
                     static_cast<float>(settings_.cavity_colour), bubbles.state_buffer().memory(),
                     label_.memory());
  bool changing = true;
  for (int rounds = kRoundsAtOnce; changing && rounds <= bubbles.carried() + kRoundsAtOnce;
       rounds += kRoundsAtOnce) {
    const std::array<int, 1> none = {0};
    changed_.write(device, none);
    for (int k = 0; k < kRoundsAtOnce; ++k) {
      grow_cavities_.run(device.queue(), count, fluid_.params_buffer().memory(),
                         bubbles.grid().cell_start(), bubbles.sorted().position.memory(),
                         bubbles.sorted().stride, bubbles.carried(), label_.memory(),
                         grown_.memory(), changed_.memory());
      std::swap(label_, grown_);
    }
    changing = changed_.read(device, 1).front() != 0;
    rounds_ = std::max(rounds_, rounds);
  }
  return label_.read(device, count);
}

std::vector<DetectedCavity> Cavities::search(double time, Bubbles& bubbles) {
  const std::vector<BubbleState>& states = bubbles.states();
  const float least = static_cast<float>(settings_.cavity_colour);
  const bool any_seed = std::any_of(states.begin(), states.end(),
                                    [least](const BubbleState& s) { return s.colour > least; });
  if (states.empty() || (!any_seed && !search_always_)) return {};
  ++searches_;
  const std::vector<int> grown = grow(bubbles);
  std::vector<int> label(bubbles.pool().size(), -1);
  for (std::size_t i = 0; i < states.size(); ++i) {
    PoolBubble& bubble = bubbles.pool()[static_cast<std::size_t>(states[i].id)];
    bubble.volume = bubble_volume(static_cast<double>(states[i].colour), fluid_.params());
    if (grown[i] != kUnlabelled) label[static_cast<std::size_t>(states[i].id)] = grown[i];
  }
  return name_cavities(bubbles.pool(), label, time, settings_, next_cavity_);
}

}  // namespace splash::sim
