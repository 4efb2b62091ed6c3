// SPDX-License-Identifier: MIT
// Whether a body can get from one pose to the next. Poses too near in time are mistakes that would
// cost steps without end.
#pragma once

#include <string>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct PaceLimits {
  double speed = 20.0;  ///< [m/s]
  double spin = 100.0;  ///< [rad/s]
};
/// Recorded bodies as live ones: the fastest sprint's foot. Scripts may do what free bodies may.
inline constexpr PaceLimits kRecordedPace = {20.0, 100.0};
inline constexpr PaceLimits kScriptedPace = {100.0, 1000.0};

/// What is wrong with the way between two poses, the later one second; empty: nothing.
[[nodiscard]] std::string too_fast(const Keyframe& from, const Keyframe& to,
                                   const PaceLimits& limits);

}  // namespace splash::sim
