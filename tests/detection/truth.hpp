// SPDX-License-Identifier: MIT
// When and how fast a body meets water at rest, from its motion and shape alone: its lowest point
// against the level. Knows nothing of the water or of what the detectors see.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "sim-server/bodies/motion/motion.hpp"

namespace splash::detection {

/// The body's state at a time [s].
using Path = std::function<sim::BodyState(double)>;

/// The lowest point in the world [m].
[[nodiscard]] sim::Vector3 lowest_point(const sim::Shape& shape, const sim::BodyState& state);

/// A body goes down through the level.
struct Entry {
  std::size_t body = 0;
  double time = 0.0;    ///< [s]
  double until = 0.0;   ///< may be told until then: parts that roll in one after the other [s]
  double down = 0.0;    ///< speed of its lowest point [m/s]
  double clear = 0.0;   ///< how far it had been above the level since the last time [m]
  bool wanted = false;  ///< must be told once; else it may be
};

/// Whether an entry must, may or must not be told depends on its speed: a body slower than
/// `impact_speed` is silent, and around that limit either is right.
struct Limits {
  double impact_speed = 0.05;  ///< [m/s]
  double clear = 0.005;        ///< what never rose so far above the level may stay silent [m]
  double momentum = 0.005;     ///< of an impact, by the added mass of the largest face [m/s]
  double face = 0.05;          ///< of an impact, by the area of the largest face [1]
};

/// Entries between 0 and `end` [s], each `wanted` or not; what must stay silent is left out.
[[nodiscard]] std::vector<Entry> entries_of(std::size_t body, const sim::Shape& shape,
                                            const Path& path, double level, double end,
                                            const Limits& limits);

}  // namespace splash::detection
