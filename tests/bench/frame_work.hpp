// SPDX-License-Identifier: MIT
// What a frame of a scene asks of a device: its steps, and what is done once besides: sleep,
// stats, detectors, the copy of the state.
#pragma once

#include <map>
#include <string>

#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/fluid_work.hpp"
#include "tests/bench/opencl_ledger.hpp"

namespace splash::bench {

/// What decides the work of a frame of a scene whose bodies go their way.
struct FrameSeen {
  Places places;  ///< in its last step
  int steps = 0;
  bool sleeps = false;   ///< water may
  bool looks = false;    ///< for spawns of bubbles
  double skin = 0.0;     ///< points of bodies that look at the water
  double near = 0.0;     ///< particles in bodies' boxes
  double bubbles = 0.0;  ///< that are carried
  double fast = 0.0;     ///< particles that may entrap air
};

/// Computes a frame and looks at it; waits in its midst. Throws std::runtime_error for a frame that
/// is idle or has to be done again.
[[nodiscard]] FrameSeen see_frame(sim::Simulation& simulation);

/// Of all its kernels, for the whole frame.
[[nodiscard]] std::map<std::string, Work> frame_work(const FrameSeen& seen,
                                                     const sim::Profile& profile);
/// And of the commands that are none.
[[nodiscard]] Commands frame_commands(const FrameSeen& seen);
/// What the copies of the state move [B].
[[nodiscard]] double copied_bytes(const FrameSeen& seen);

}  // namespace splash::bench
