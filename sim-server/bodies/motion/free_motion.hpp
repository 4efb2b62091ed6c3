// SPDX-License-Identifier: MIT
// A body that the water moves: where it was when the last frame ended. Until the next one ends it
// is taken to go straight on, for those who look ahead.
#pragma once

#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

class FreeMotion : public Motion {
 public:
  /// `start`: when time begins.
  explicit FreeMotion(const BodyState& start) : start_(start), now_(start) {}

  /// Straight on for a tenth of a second at most; at or before the time that is known, what is
  /// known.
  [[nodiscard]] BodyState at(double seconds) const override {
    constexpr double kLookAhead = 0.1;  // more than the steps of any frame [s]
    BodyState state = now_;
    const double since = seconds - seconds_;
    // Not the other way round: a time that is no number is the present one.
    if (!(since > 0.0)) return state;
    state.position = now_.position + (since < kLookAhead ? since : kLookAhead) * now_.velocity;
    return state;
  }
  /// That it starts with: what it will reach is not known beforehand.
  [[nodiscard]] double fastest() const override { return length(start_.velocity); }

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
