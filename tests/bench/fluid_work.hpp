// SPDX-License-Identifier: MIT
// What water asks of a device, counted from where its particles and bodies are: a step, and a frame
// of a scene with what is done once in it besides (sleep, stats, detectors, the copy of the state).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/fluid_block.hpp"

namespace splash::bench {

/// Where the particles are, as the kernels see them.
struct Places {
  sim::FluidParams params = {};
  std::vector<float> position;  ///< x, y, z parts
  std::vector<int> cell_start;
  int used = 0;                       ///< cells up to the last that has a particle
  std::vector<float> body_position;   ///< of the bodies' points, likewise
  std::vector<int> body_start;        ///< of them, as cell_start
  std::vector<sim::BodyStep> bodies;  ///< in this step
};

/// Between the halves of `step`. Waits.
[[nodiscard]] Places places_of(sim::Fluid& fluid, const sim::Step& step);
/// After half a step.
[[nodiscard]] Places places_of(Block& block);

/// Of all launches of a kernel in a step.
struct Work {
  double launches = 1.0;
  double bytes = 0.0;
  double operations = 0.0;  ///< of all lanes; two to an instruction
  double runs = 0.0;        ///< of points, looked up and gone through

  Work& operator+=(const Work& other);
  [[nodiscard]] Work times(double factor) const;
};

/// What a device can do at most.
struct Limits {
  double bandwidth = 0.0;   ///< [B/s]
  double arithmetic = 0.0;  ///< two to an instruction, fused or not [1/s]
  double runs = 0.0;        ///< looked up and gone through, of a length that is not foreseen [1/s]
  double launch = 0.0;      ///< that a launch takes of the host [s]
};

/// Of all launches of a kernel, by the rule at the head of fluid_limits.cpp [s].
[[nodiscard]] double expected(const Work& work, const Limits& limits);

/// Of all kernels that a step runs, with the state equation and bodies that go their way: bytes as
/// if every array went through memory once, operations of the formulas.
[[nodiscard]] std::map<std::string, Work> work_of(const Places& places,
                                                  const sim::Profile& profile);

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
  double stirred = 0.0;  ///< particles that may be in eddies fast enough for it
};

/// Computes a frame and looks at it; waits in its midst. Throws std::runtime_error for a frame that
/// is idle or has to be done again.
[[nodiscard]] FrameSeen see_frame(sim::Simulation& simulation);

/// Of all its kernels, for the whole frame.
[[nodiscard]] std::map<std::string, Work> frame_work(const FrameSeen& seen,
                                                     const sim::Profile& profile);
/// What the copies of the state move [B].
[[nodiscard]] double copied_bytes(const FrameSeen& seen);

}  // namespace splash::bench
