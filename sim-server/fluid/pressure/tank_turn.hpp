// SPDX-License-Identifier: MIT
// Forces on water in a tank that turns (tank_turn.cl); scenes whose tank does not are spared it.
#pragma once

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/tank_turn.h"
#include "sim-server/scene/tank_motion.hpp"

namespace splash::sim {

class Fluid;

/// Of a step of `dt` [s].
[[nodiscard]] TankTurn turn_of(const TankState& tank, const Vector3& pivot, double dt);

class TankTurning {
 public:
  explicit TankTurning(Device& device);

  /// In the steps to come, until it is set anew.
  void set(Device& device, const TankTurn& turn);
  /// Changes the velocities of the state that a step works on.
  void push(Fluid& fluid);

 private:
  Kernel turn_water_;
  Buffer<TankTurn> turn_;
  TankTurn uploaded_ = {};
};

}  // namespace splash::sim
