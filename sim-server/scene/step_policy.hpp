// SPDX-License-Identifier: MIT
// How much longer or shorter than by default the steps of a scene are. The scene's
// time_step_factor, what the solver bears, the speed of sound and the machine's load all have a
// part in it; this is the one place that knows them all.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

class StepPolicy {
 public:
  /// The range of the scene's time_step_factor [1]. A step that is longer than the default one by
  /// more than kLargestFactor is taken for a fault (longest_possible_step, fluid/time_step.hpp).
  static constexpr double kLeastFactor = 0.05;
  static constexpr double kLargestFactor = 2.0;

  /// The most by which a solver's steps may exceed the default at one speed of sound, found with
  /// still water and dam breaks (sim-server/fluid/README, "How long a step may be") [1].
  [[nodiscard]] static double stable_factor(PressureKind solver) noexcept;
  /// The part of the default speed of sound that the scene's time_step_factor leaves: longer steps
  /// than stable_factor are bought with slower sound, which costs compression and not stability
  /// [1]. It does not apply to a speed of sound that the scene names.
  [[nodiscard]] static double sound_factor(const FluidSettings& fluid) noexcept;

  explicit StepPolicy(const FluidSettings& fluid) noexcept;

  /// What the default limits on a step are multiplied by at present [1].
  [[nodiscard]] double factor() const noexcept { return stretch_ * factor_; }
  /// How much longer steps may become under load, where they still are stable and sound is as fast
  /// as before; 1 for scenes that ask for longer steps themselves [1].
  [[nodiscard]] double largest_stretch() const noexcept { return largest_stretch_; }
  /// Makes steps `stretch` times as long as without load, largest_stretch() at most [1].
  void set_stretch(double stretch) noexcept;
  /// Whether a scene file that asks for kLargestFactor gets longer steps than load makes.
  [[nodiscard]] bool scene_may_ask_for_more() const noexcept { return scene_may_ask_; }

 private:
  double factor_;           ///< of the scene, without load [1]
  double largest_stretch_;  ///< [1]
  double stretch_ = 1.0;    ///< by load [1]
  bool scene_may_ask_;
};

}  // namespace splash::sim
