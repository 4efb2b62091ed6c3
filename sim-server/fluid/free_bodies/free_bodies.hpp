// SPDX-License-Identifier: MIT
// Bodies that the water moves, as much as they move it: the stages of a step that only a scene with
// such bodies has (free_bodies/body_*.cl). They are enqueued with the others; where the bodies go
// is known on the device alone until the frame ends.
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

/// Where a free body is when a frame ends, and what the water did to it in the last step.
struct FreeBodyEnd {
  BodyStep step = {};
  Vector3 force = {0.0, 0.0, 0.0};   ///< [N]
  Vector3 torque = {0.0, 0.0, 0.0};  ///< about its centre [N m]
  Vector3 tug = {0.0, 0.0, 0.0};     ///< of its spring, in the frame [N s]
  Vector3 twist = {0.0, 0.0, 0.0};   ///< about its centre [N m s]
};

class FreeBodies {
 public:
  /// `defines`: that its kernels are built with (parts.hpp); `bodies`: at least one, of
  /// `body_count` that are there; `skin`: of these, in any order; `pairs`: whose friction is one of
  /// their own.
  FreeBodies(Device& device, const FluidParams& params, const std::vector<std::string>& defines,
             const std::vector<FreeBody>& bodies, const std::vector<SkinFace>& skin, int body_count,
             const std::vector<PairFriction>& pairs);

  /// Where the devices are that bodies hang on by springs: an entry for each free body, of a
  /// frame's first step, then of the next one. Without it none may hang on any.
  void hang(Device& device, const std::vector<Anchor>& anchors);

  /// Finds what water is in reach of the bodies; the bodies answer to the forces of the present
  /// pressures, to what rubs and to gravity, and so do the accelerations of that water.
  void answer(Fluid& fluid, const Step& step);

  /// After the particles have moved: none is left in a body, and the bodies move on.
  void move(Fluid& fluid, const Step& step);

  void enqueue_read(Fluid& fluid);
  /// Once the queue is finished: one for each, after the last step.
  [[nodiscard]] std::vector<FreeBodyEnd> ends() const;
  [[nodiscard]] const std::vector<FreeBody>& bodies() const noexcept { return list_; }
  [[nodiscard]] const Buffer<FreeBody>& on_device() const noexcept { return bodies_; }
  /// What the water gave each in this step so far, its momentum and angular momentum.
  [[nodiscard]] const Buffer<float>& felt() const noexcept { return felt_; }
  /// Where the devices are, and what springs gave bodies in this frame so far.
  [[nodiscard]] const Buffer<Anchor>& anchors() const noexcept { return anchors_; }
  [[nodiscard]] const Buffer<float>& tugs() const noexcept { return tugs_; }
  [[nodiscard]] Films& films() noexcept { return films_; }

 private:
  /// What the bodies answer to, and where the change of the water's velocities goes.
  struct Occasion {
    const Buffer<float>* pressure = nullptr;  ///< p / rho^2 that pushes
    double pushing = 0.0;                     ///< for so long [s]
    double rubbing = 0.0;                     ///< what rubs acts for so long [s]
    double falling = 0.0;                     ///< gravity acts for so long [s]
    double factor = 1.0;                      ///< the velocities' changes are added times this
    const Buffer<float>* velocity = nullptr;  ///< to these
  };
  void answer(Fluid& fluid, const Step& step, const Occasion& occasion);

  std::vector<FreeBody> list_;
  int count_ = 0;
  std::size_t next_ = 0;  ///< where the bodies of the coming step begin among the fluid's
  Buffer<FreeBody> bodies_;
  Buffer<float> answer_;
  Buffer<std::byte> contacts_;
  Buffer<KeptPush> kept_pushes_;
  Buffer<float> friction_;
  Buffer<float> felt_;
  Buffer<float> force_;
  Buffer<float> tugs_;
  Buffer<Anchor> anchors_;
  std::vector<Anchor> uploaded_;
  std::vector<BodyStep> steps_read_;
  std::vector<float> force_read_;
  std::vector<float> tugs_read_;
  BodyReach reach_;
  Films films_;
  Kernel answer_bodies_;
  Kernel carry_water_;
  Kernel keep_out_of_free_;
  Kernel move_bodies_;
};

}  // namespace splash::sim
