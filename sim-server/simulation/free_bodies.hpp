// SPDX-License-Identifier: MIT
// The free bodies of a scene between frames: what the device made of them, and those that hang on
// devices by springs: where the devices are, for the kernels (fluid/boundary/body_spring.h), and
// what they feel.
#pragma once

#include <optional>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/bodies/motion/tied_motion.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/free_bodies/body_pushes.hpp"
#include "sim-server/fluid/free_bodies/free_bodies.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Returns a fault when a free body has NaN or infinity in its state, its centre is beyond a side
/// or the floor of the tank, or it is ten times as fast as sound. To be called after the frame's
/// last step, number `step`.
[[nodiscard]] std::optional<Diagnosis> look_at_free_bodies(Fluid& fluid, int step);

/// Copies the states that the bodies have at `seconds` from the device.
void bring_free_bodies(Fluid& fluid, Bodies& bodies, double seconds);

class HungBodies {
 public:
  /// `live`: of each body, what poses move; a tether for those that hang on one.
  HungBodies(const std::vector<BodySettings>& bodies, const std::vector<PosedMotion*>& live);

  [[nodiscard]] bool empty() const noexcept { return tethers_.empty(); }
  /// Of each free body in so many steps from `seconds` on; of those on no device: anything.
  [[nodiscard]] std::vector<Anchor> anchors(double seconds, int steps, double dt) const;
  /// Whether a device moves within a frame.
  [[nodiscard]] bool move(double seconds, double frame) const;
  /// What the devices felt in the frame that ended at `seconds`.
  [[nodiscard]] std::vector<BodyPush> pushes(const std::vector<FreeBodyEnd>& ends, double seconds,
                                             double frame) const;

 private:
  struct Hung {
    std::size_t free = 0;  ///< index among the free bodies
    FreeBody body = {};
    const Tether* tether = nullptr;
    Vector3 centre = {0.0, 0.0, 0.0};  ///< of its mass, from the origin that devices know [m]
  };
  std::size_t free_count_ = 0;
  std::vector<Hung> tethers_;
};

}  // namespace splash::sim
