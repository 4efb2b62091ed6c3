// SPDX-License-Identifier: MIT
// What is done about a frame that was not sound: first it is computed again from the last sound
// state, with steps of half the length, up to three times. Then the water around the fault is
// stopped where it last was sound, and time goes on. When that does not help either, the scene
// begins anew. So every fault ends, and soon.
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

  /// Of the largest stable step, that the next try is computed with [1].
  [[nodiscard]] double step_share() const noexcept { return share_; }
  /// Frames given up in a row until now.
  [[nodiscard]] int given_up() const noexcept { return given_up_; }
  /// Tries of the present frame that failed.
  [[nodiscard]] int failed_tries() const noexcept { return failed_; }

  /// The try was not sound.
  [[nodiscard]] Remedy failed() noexcept;
  /// The frame was sound: steps grow again, by and by.
  void succeeded() noexcept;

 private:
  double share_ = 1.0;
  int failed_ = 0;
  int given_up_ = 0;
};

}  // namespace splash::sim
