// SPDX-License-Identifier: MIT
// One case through the whole simulation, faster than real time, and scored.
#pragma once

#include <functional>
#include <optional>

#include "sim-server/device/device.hpp"
#include "tests/detection/sweeps.hpp"

namespace splash::detection {

struct Outcome {
  Case item;
  Score score;
  int particles = 0;
  double processor = 0.0;  ///< time of all cores, with set-up and settling [s]
};

/// What is true of a case's bodies, but for those that the water moves.
[[nodiscard]] std::vector<Entry> truth_of(const Case& item);

/// `solver` in place of the scene's, if there is one; `progress` gets the share done [0, 1].
[[nodiscard]] Outcome run_case(sim::Device& device, const Case& item,
                               std::optional<sim::PressureKind> solver = {},
                               const std::function<void(double)>& progress = {});

}  // namespace splash::detection
