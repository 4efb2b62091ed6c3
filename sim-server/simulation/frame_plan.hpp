// SPDX-License-Identifier: MIT
// What a frame needs: looked up from the last frame's statistics and from where the bodies go.
#pragma once

#include <cstdint>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct FramePlan {
  bool steps = true;     ///< anything may move
  bool contacts = true;  ///< a body may meet the water
  bool bubbles = true;   ///< water may make bubbles, or bubbles live
};

/// Frames that went without.
struct SkipTotals {
  std::uint64_t idle = 0;  ///< nothing was computed
  std::uint64_t contacts = 0;
  std::uint64_t bubbles = 0;
  std::uint64_t cavities = 0;
  int kernel_parts =
      0;  ///< not frames: parts that the kernels were built without (fluid/params/parts.hpp)
  double asleep_sum = 0.0;  ///< of the share of the particles that slept, over all frames [1]
};

/// Whether any of the bodies comes within the support of the box around the water; the box may have
/// grown by `margin` [m] since.
[[nodiscard]] bool near_water(const std::vector<BodyStep>& bodies, const FluidStats& water,
                              double margin);
/// Same, of bodies that move.
[[nodiscard]] bool moving_near_water(const std::vector<BodyStep>& bodies, const FluidStats& water);

class FramePlanner {
 public:
  FramePlanner(const SkipSettings& skip, double bubble_speed, int particles)
      : skip_(skip), bubble_speed_(bubble_speed), particles_(particles) {}

  /// `bodies`: those of all steps of the coming frame; `last`: the statistics of the last one, of
  /// `frame` seconds; `driven`: the wave maker moves, or a free body did not long ago; `bubbles`:
  /// how many live.
  [[nodiscard]] FramePlan plan(const std::vector<BodyStep>& bodies, const FluidStats& last,
                               double frame, bool driven, std::size_t bubbles);
  /// Water slower than this makes no bubbles [m/s].
  void set_bubble_speed(double speed) noexcept { bubble_speed_ = speed; }
  /// After a failure nothing is taken for granted.
  void forget() noexcept { known_ = false; }

 private:
  SkipSettings skip_;
  double bubble_speed_ = 0.0;
  int particles_ = 0;
  bool known_ = false;        ///< there has been the statistics
  bool calm_before_ = false;  ///< the last frame looked for bubbles and all water was slow
};

}  // namespace splash::sim
