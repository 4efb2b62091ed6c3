// SPDX-License-Identifier: MIT
// A tank that is shaken, rocked or turned, as what is in it feels it: in the tank's own axes
// gravity turns, and the tank's acceleration and its turning act on everything (Landau & Lifshitz,
// Mechanics, article 39):
//   f = R^T g - a - w' x r - w x (w x r) - 2 w x v
// with R the tank's rotation, dR/dt = R [w]x, r from the pivot, a the pivot's acceleration.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// What acts in the tank's axes at one instant.
struct TankState {
  Vector3 gravity = {0.0, 0.0, 0.0};    ///< R^T g - a [m/s2]
  Vector3 spin = {0.0, 0.0, 0.0};       ///< w [rad/s]
  Vector3 spin_rate = {0.0, 0.0, 0.0};  ///< w' [rad/s2]
};

class TankMotion {
 public:
  TankMotion(const TankMotionSettings& settings, const Vector3& gravity)
      : settings_(settings), gravity_(gravity) {}

  /// `seconds` since the scene began. The tank's turns are summed up from there in steps of a
  /// millisecond; calls that go on in time are the quickest, and their order changes nothing.
  [[nodiscard]] TankState at(double seconds);

 private:
  [[nodiscard]] TankState driven(double seconds) const;

  TankMotionSettings settings_;
  Vector3 gravity_;
  long known_ = 0;                            ///< milliseconds up to which turns are summed
  Quaternion turned_ = {0.0, 0.0, 0.0, 1.0};  ///< there: tank to world
};

/// Whether the tank ever turns.
[[nodiscard]] bool turns(const TankMotionSettings& settings);

/// No acceleration of the tank's pivot is larger, none of its turns faster: bounds of both.
struct TankBounds {
  double acceleration = 0.0;  ///< [m/s2]
  double spin = 0.0;          ///< [rad/s]
  double spin_rate = 0.0;     ///< [rad/s2]
};
[[nodiscard]] TankBounds bounds_of(const TankMotionSettings& settings);

/// The strongest that gravity and the tank's motion ever act together on what rests in it [m/s2].
[[nodiscard]] double strongest_field(const Scene& scene);
/// What rests in the world passes the tank's walls at this speed at most, where the tank turns
/// [m/s].
[[nodiscard]] double fastest_wall(const Scene& scene);

}  // namespace splash::sim
