// SPDX-License-Identifier: MIT
// What the water does to bodies that go their own way, found on the device while somebody wants to
// feel it: by the particles' pushes (free_bodies/body_push.cl), or by the pressures of a solver
// whose particles do not push.
#pragma once

#include <string>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/free_bodies/body_reach.hpp"
#include "sim-server/fluid/free_bodies/films.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

class Fluid;

/// Of the water on a body, or of the spring on the device that the body hangs on: the mean over a
/// frame.
struct BodyPush {
  int body = 0;                        ///< index among the scene's
  Vector3 velocity = {0.0, 0.0, 0.0};  ///< of the body, or of that device, at the frame's end [m/s]
  Vector3 spin = {0.0, 0.0, 0.0};      ///< [rad/s]
  Vector3 force = {0.0, 0.0, 0.0};     ///< [N]
  Vector3 torque = {0.0, 0.0, 0.0};    ///< about its centre [N m]
  Vector3 by_speed = {0.0, 0.0,
                      0.0};  ///< what a speed along an axis adds to the force there [N s/m]
  Vector3 by_spin = {0.0, 0.0, 0.0};  ///< what a spin adds to the torque [N m s]
};

class BodyPushes {
 public:
  /// `bodies`: at least one; of each its number and its size count, and its mass is 0. `skin`: of
  /// these, in any order; without it no film of water pushes them.
  BodyPushes(Fluid& fluid, const std::vector<FreeBody>& bodies, const std::vector<SkinFace>& skin);

  /// A frame begins. `wanted`: of each body, in their order, whether somebody feels it.
  void begin(Fluid& fluid, const std::vector<bool>& wanted);
  /// Between the fluid's accelerate and move of a step.
  void add(Fluid& fluid, const Step& step);
  void enqueue_read(Fluid& fluid);
  /// Once the queue is finished; of a frame of so many seconds.
  [[nodiscard]] std::vector<BodyPush> pushes(double seconds) const;
  [[nodiscard]] const std::vector<FreeBody>& bodies() const noexcept { return list_; }

 private:
  /// Of the particles, with their films.
  void add_particles(Fluid& fluid, const Step& step);

  std::vector<FreeBody> list_;
  std::vector<bool> wanted_;
  int count_ = 0;
  Buffer<FreeBody> bodies_;
  Buffer<float> sums_;
  std::vector<float> read_;

  // Of particles that push.
  BodyReach reach_;
  Films films_;
  Kernel sum_pushes_;
};

}  // namespace splash::sim
