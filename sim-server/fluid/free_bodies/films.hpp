// SPDX-License-Identifier: MIT
// Films of water between free bodies and what they touch (free_bodies/body_film.cl): whether there
// may be any in a frame, and what they do to the bodies. Where none is near anything, no kernel
// runs.
#pragma once

#include <cstdint>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/params/boundary_point.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/time_step.hpp"

namespace splash::sim {

class Fluid;

class Films {
 public:
  Films() = default;
  /// `program`: that of the free bodies; `bodies`: the free ones; `skin`: of them, in any order.
  /// Bodies without skin have no films.
  Films(Device& device, const cl::Program& program, const std::vector<FreeBody>& bodies,
        const std::vector<SkinFace>& skin);

  /// What a step knows of the free bodies.
  struct Now {
    const Buffer<FreeBody>& bodies;
    const Buffer<float>& pressure;  ///< p / rho^2 of each particle
    Buffer<float>& reach;           ///< what particles and bodies do to each other
    const Buffer<int>& reached;
  };
  /// Finds what the films do in this step.
  void press(Fluid& fluid, const Step& step, const Now& now);
  /// Whether there may be any in this step: then push() says what they do.
  [[nodiscard]] bool pressed() const noexcept { return pressed_; }
  /// Of each free body, force and torque about its centre [N], [N m].
  [[nodiscard]] const Buffer<float>& push() const noexcept { return push_; }
  /// What the next step depends on, for checkpoints.
  [[nodiscard]] const cl::Buffer& kept() const noexcept { return kept_.memory(); }
  /// Forgets the films of the last step.
  void forget(Device& device) { kept_.enqueue_clear(device); }
  /// Steps in which films were looked for.
  [[nodiscard]] std::uint64_t steps() const noexcept { return steps_; }

 private:
  /// Whether a free body may come near a wall or another body within the frame that `step` opens.
  [[nodiscard]] bool any_near(const Fluid& fluid, const Step& step) const;

  std::vector<int> free_;  ///< numbers of the free bodies
  bool pressed_ = false;
  std::uint64_t steps_ = 0;
  int skin_stride_ = 0;
  Buffer<float> skin_;
  Buffer<int> skin_from_;
  Buffer<float> rims_;
  Buffer<float> parts_;
  Buffer<float> kept_;  ///< of each free body, p0 of the last step [Pa], and whether it had a film
  Buffer<int> lists_;
  Buffer<float> push_;
  Kernel measure_rims_;
  Kernel press_films_;
  Kernel sum_films_;
};

}  // namespace splash::sim
