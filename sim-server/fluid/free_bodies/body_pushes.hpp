// SPDX-License-Identifier: MIT
// What the water does to bodies that go their own way, found on the device while somebody wants to
// feel it (free_bodies/body_push.cl). Of the weakly compressible water alone: the other solver's
// pressures are spread over the solves of a step.
#pragma once

#include <string>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/program.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/divergence_free/solve_state.h"
#include "sim-server/fluid/step.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

class Fluid;

/// Of the water on a body, the mean over a frame.
struct BodyPush {
  int body = 0;                      ///< index among the scene's
  Vector3 force = {0.0, 0.0, 0.0};   ///< [N]
  Vector3 torque = {0.0, 0.0, 0.0};  ///< about its centre [N m]
  Vector3 by_speed = {0.0, 0.0,
                      0.0};  ///< what a speed along an axis adds to the force there [N s/m]
  Vector3 by_spin = {0.0, 0.0, 0.0};  ///< what a spin adds to the torque [N m s]
};

class BodyPushes {
 public:
  /// `bodies`: at least one; of each its number and its size count.
  BodyPushes(Fluid& fluid, const std::vector<FreeBody>& bodies);

  /// A frame begins.
  void begin(Fluid& fluid);
  /// Between the fluid's prepare and advance of a step.
  void add(Fluid& fluid, const Step& step);
  void enqueue_read(Fluid& fluid);
  /// Once the queue is finished; of a frame of so many seconds.
  [[nodiscard]] std::vector<BodyPush> pushes(double seconds) const;

 private:
  std::vector<FreeBody> list_;
  int count_ = 0;
  std::size_t groups_ = 0;  ///< of particles
  Buffer<FreeBody> bodies_;
  Buffer<float> reach_;
  Buffer<int> reached_;
  Buffer<float> parts_;
  Buffer<float> sums_;
  Buffer<SolveState> no_solve_;
  std::vector<float> read_;
  Kernel reach_bodies_;
  Kernel weigh_water_;
  Kernel sum_pushes_;
};

}  // namespace splash::sim
