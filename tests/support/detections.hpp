// SPDX-License-Identifier: MIT
// What a run of the simulation found, frame after frame: collected, counted, as numbers.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "sim-server/detect/detection.hpp"

namespace splash::tests {

inline constexpr sim::PressureKind kBothSolvers[] = {sim::PressureKind::weakly_compressible,
                                                     sim::PressureKind::grid_projected};

inline void append(auto& all, const auto& more) {
  all.insert(all.end(), more.begin(), more.end());
}

inline void append_found(sim::Detections& all, const sim::Detections& more) {
  append(all.impacts, more.impacts);
  append(all.bubbles, more.bubbles);
  append(all.cavities, more.cavities);
}

[[nodiscard]] inline std::size_t count_of(const sim::Detections& found) {
  return found.impacts.size() + found.bubbles.size() + found.cavities.size();
}

/// All numbers of all events, one after the other.
[[nodiscard]] inline std::vector<double> numbers_of(const sim::Detections& found) {
  std::vector<double> all;
  const auto add = [&](std::initializer_list<double> some, const sim::Vector3& place) {
    append(all, some);
    append(all, place);
  };
  for (const sim::DetectedImpact& e : found.impacts) {
    add({e.time, static_cast<double>(e.body), e.speed, e.approach}, e.position);
  }
  for (const sim::DetectedBubble& e : found.bubbles) {
    add({e.time, static_cast<double>(e.particle), e.radius, e.epsilon}, e.position);
  }
  for (const sim::DetectedCavity& e : found.cavities) {
    add({e.time, static_cast<double>(e.bubbles), e.radius}, e.position);
  }
  return all;
}

}  // namespace splash::tests
