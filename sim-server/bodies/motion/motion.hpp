// SPDX-License-Identifier: MIT
// Where a body is at a time, whatever moves it.
#pragma once

#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// A rigid body's pose and velocities in the world.
struct BodyState {
  Vector3 position = {0.0, 0.0, 0.0};          ///< of its centre [m]
  Quaternion rotation = {0.0, 0.0, 0.0, 1.0};  ///< body to world, unit
  Vector3 velocity = {0.0, 0.0, 0.0};          ///< of its centre [m/s]
  Vector3 spin = {0.0, 0.0, 0.0};              ///< angular velocity in the world [rad/s]
};

class Motion {
 public:
  virtual ~Motion() = default;
  /// The state at `seconds` of simulated time; always finite, the rotation of unit length.
  [[nodiscard]] virtual BodyState at(double seconds) const = 0;
  /// The largest speed that its centre will ever have, where that is known beforehand, else 0
  /// [m/s].
  [[nodiscard]] virtual double fastest() const { return 0.0; }
  /// Moments from 0 on that, one after the other, tell its whole way, where that is known
  /// beforehand [s].
  [[nodiscard]] virtual std::vector<double> moments() const { return {}; }
};

}  // namespace splash::sim
