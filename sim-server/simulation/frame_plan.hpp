// SPDX-License-Identifier: MIT
// Plans a frame: which of its computations can be skipped, decided from the last frame's statistics
// and the bodies' motions.
#pragma once

#include <cstdint>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct FramePlan {
  bool steps = true;     ///< something may move
  bool contacts = true;  ///< a body may meet the water
  bool bubbles = true;   ///< the water may entrap bubbles, or bubbles are alive
};

/// The number of frames in which a computation was skipped.
struct SkipTotals {
  std::uint64_t idle = 0;  ///< nothing was computed
  std::uint64_t contacts = 0;
  std::uint64_t bubbles = 0;
  std::uint64_t cavities = 0;
  int kernel_parts =
      0;  ///< not frames: parts that the kernels were built without (fluid/params/parts.hpp)
  double asleep_sum = 0.0;  ///< of the share of the particles that slept, over all frames [1]
};

/// Whether any of the bodies comes within the kernel's support of the water's bounding box, which
/// may have grown by `margin` [m] since.
[[nodiscard]] bool near_water(const std::vector<BodyStep>& bodies, const FluidStats& water,
                              double margin);
/// The same for bodies that move.
[[nodiscard]] bool moving_near_water(const std::vector<BodyStep>& bodies, const FluidStats& water);

/// When all water sleeps, where its cells cannot do so one by one.
struct WholeSleep {
  double speed = 0.0;  ///< slower water is at rest [m/s]; 0: it never sleeps as a whole
  double after = 0.0;  ///< after so long in which nothing is at it [s]
};

class FramePlanner {
 public:
  FramePlanner(const SkipSettings& skip, double bubble_speed, int particles,
               const WholeSleep& whole = {})
      : skip_(skip), bubble_speed_(bubble_speed), particles_(particles), whole_(whole) {}

  /// `bodies`: those of all steps of the next frame; `last`: the statistics of the last frame,
  /// which lasts `frame` seconds; `driven`: the wave maker moves, or a free body moved recently;
  /// `bubbles`: the number of bubble particles alive.
  [[nodiscard]] FramePlan plan(const std::vector<BodyStep>& bodies, const FluidStats& last,
                               double frame, bool driven, std::size_t bubbles);
  /// Water slower than this makes no bubbles [m/s].
  void set_bubble_speed(double speed) noexcept { bubble_speed_ = speed; }
  /// Makes the next plan compute everything, as after a failure.
  void forget() noexcept { known_ = false; }

 private:
  /// Whether water that sleeps as a whole does. `disturbed`: something is at it in this frame of
  /// `frame` seconds.
  [[nodiscard]] bool all_sleep(const FluidStats& last, double frame, bool disturbed);

  SkipSettings skip_;
  double bubble_speed_ = 0.0;
  int particles_ = 0;
  WholeSleep whole_;
  double rested_ = 0.0;       ///< for how long nothing was at the water, by `whole_` [s]
  bool known_ = false;        ///< the last frame's statistics are known
  bool calm_before_ = false;  ///< the last frame searched for bubbles and all water was slow
};

}  // namespace splash::sim
