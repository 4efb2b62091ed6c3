// SPDX-License-Identifier: MIT
// A body that the water moves: where it was when the last frame ended. Until the next one ends it
// is taken to go straight on, for those who look ahead.
#pragma once

#include "sim-server/bodies/motion/motion.hpp"

namespace splash::sim {

class FreeMotion : public Motion {
 public:
  /// `start`: when time begins.
  explicit FreeMotion(const BodyState& start) : start_(start), now_(start) {}

  /// Straight on for a tenth of a second at most; at or before the time that is known, what is
  /// known.
  [[nodiscard]] BodyState at(double seconds) const override;
  /// That it starts with: what it will reach is not known beforehand.
  [[nodiscard]] double fastest() const override;

  /// What the simulation found at `seconds`.
  void put(const BodyState& state, double seconds) noexcept {
    now_ = state;
    seconds_ = seconds;
  }
  /// Back to how it was when time began, at `seconds`.
  virtual void reset(double seconds) noexcept { put(start_, seconds); }
  /// It is still there at `seconds`, and goes on from then.
  void hold(double seconds) noexcept { seconds_ = seconds; }
  /// Stops it where it is.
  void zero_velocities() noexcept { now_.velocity = now_.spin = {0.0, 0.0, 0.0}; }

 private:
  BodyState start_;
  BodyState now_;
  double seconds_ = 0.0;
};

}  // namespace splash::sim
