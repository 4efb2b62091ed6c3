// SPDX-License-Identifier: MIT
// What a test needs to run one detector on a small water: the detectors' kernels, and bubbles put
// where the test wants them.
#pragma once

#include <vector>

#include "sim-server/detect/bubbles.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {

/// The kernels as the detector builds them.
[[nodiscard]] cl::Program detect_program(Device& device);

/// Places the bodies and brings neighbours and densities up to date, as before a detection.
/// Returns the step to detect in.
Step prepare(Water& water);

/// A body of water that hangs in the middle of a large tank, out of reach of its walls: a lattice
/// of 0.2 x 0.2 x 0.1 m around (0.5, 0.5, 0.5), and one more particle (the last id) that a test
/// moves about.
[[nodiscard]] Water hanging_block();
inline constexpr double kBlockBottom = 0.45;  ///< [m]
inline constexpr double kBlockTop = 0.55;     ///< [m]

/// Bubbles at these places, born at `born`.
void fill_pool(Bubbles& bubbles, const std::vector<Vector3>& places, double born = 0.0);

/// Carries and looks for spawns, and waits for it.
void detect(Water& water, Bubbles& bubbles, double frame);

}  // namespace splash::sim
