// SPDX-License-Identifier: MIT
// Decides how a frame with a fault is recovered. First it is computed again from the last good
// state with steps of half the length, up to three times. Then the water around the fault is
// stopped in its last good state, and time goes on. When that does not help either, the scene
// restarts. So recovery always ends, and soon.
#pragma once

namespace splash::sim {

enum class Remedy {
  retry,  ///< compute the frame once more
  calm,   ///< give the frame up; stop the water around the fault
  reset,  ///< give the frame up; begin with the scene's first state
};

class Recovery {
 public:
  static constexpr int kTries = 3;          ///< of a frame, besides the first
  static constexpr int kFramesGivenUp = 3;  ///< in a row, the last of which is the scene's reset

  /// The part of the largest stable step that the next try is computed with [1].
  [[nodiscard]] double step_share() const noexcept { return share_; }
  /// The number of frames given up in a row.
  [[nodiscard]] int given_up() const noexcept { return given_up_; }
  /// The number of failed tries of the present frame.
  [[nodiscard]] int failed_tries() const noexcept { return failed_; }

  /// Takes note of a try with a fault. Returns what to do about it.
  [[nodiscard]] Remedy failed() noexcept;
  /// Takes note of a frame without a fault: steps grow again gradually.
  void succeeded() noexcept;

 private:
  double share_ = 1.0;
  int failed_ = 0;
  int given_up_ = 0;
};

}  // namespace splash::sim
