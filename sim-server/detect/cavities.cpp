// SPDX-License-Identifier: MIT
#include "sim-server/detect/cavities.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace splash::sim {
namespace {

/// Rounds enqueued between two looks at whether anything changed.
constexpr int kRoundsAtOnce = 4;

struct Group {
  int bubbles = 0;
  int cavity = SPLASH_UNLABELLED;  ///< smallest serial of a known cavity among its bubbles
  Vector3 sum = {0.0, 0.0, 0.0};
};

}  // namespace

double cavity_radius(int bubbles, const DetectSettings& settings) {
  const double range = std::max(settings.cavity_bubbles_max - settings.cavity_bubbles_min, 1);
  const double part = std::clamp((bubbles - settings.cavity_bubbles_min) / range, 0.0, 1.0);
  return settings.cavity_radius_min +
         part * (settings.cavity_radius_max - settings.cavity_radius_min);
}

std::vector<DetectedCavity> name_cavities(std::vector<PoolBubble>& pool,
                                          const std::vector<int>& label, double time,
                                          const DetectSettings& settings, int& next_cavity) {
  std::map<int, Group> groups;
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (label[i] < 0) continue;
    Group& group = groups[label[i]];
    ++group.bubbles;
    if (pool[i].cavity >= 0) group.cavity = std::min(group.cavity, pool[i].cavity);
    for (std::size_t axis = 0; axis < 3; ++axis) group.sum[axis] += pool[i].position[axis];
  }
  std::vector<DetectedCavity> fresh;
  for (auto& [first, group] : groups) {
    if (group.cavity != SPLASH_UNLABELLED || group.bubbles < settings.cavity_bubbles_min) continue;
    group.cavity = next_cavity++;
    DetectedCavity cavity;
    cavity.time = time;
    cavity.bubbles = group.bubbles;
    cavity.radius = cavity_radius(group.bubbles, settings);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cavity.position[axis] = group.sum[axis] / group.bubbles;
    }
    fresh.push_back(cavity);
  }
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (label[i] < 0) continue;
    const Group& group = groups[label[i]];
    if (group.cavity != SPLASH_UNLABELLED) pool[i].cavity = group.cavity;
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
  seed_cavities_.run(device.queue(), count,
                     {{"bubble_count", bubbles.carried()},
                      {"least_colour", static_cast<float>(settings_.cavity_colour)},
                      {"state", bubbles.state_buffer()},
                      {"label", label_}});
  bool changing = true;
  for (int rounds = kRoundsAtOnce; changing && rounds <= bubbles.carried() + kRoundsAtOnce;
       rounds += kRoundsAtOnce) {
    const std::array<int, 1> none = {0};
    changed_.write(device, none);
    for (int k = 0; k < kRoundsAtOnce; ++k) {
      grow_cavities_.run(device.queue(), count,
                         {{"p", fluid_.params_buffer()},
                          {"bubble_start", bubbles.grid().cell_start()},
                          {"position", bubbles.sorted().position},
                          {"stride", bubbles.sorted().stride},
                          {"bubble_count", bubbles.carried()},
                          {"label", label_},
                          {"grown", grown_},
                          {"changed", changed_}});
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
    if (grown[i] != SPLASH_UNLABELLED) label[static_cast<std::size_t>(states[i].id)] = grown[i];
  }
  return name_cavities(bubbles.pool(), label, time, settings_, next_cavity_);
}

}  // namespace splash::sim
