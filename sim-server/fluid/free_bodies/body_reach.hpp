// SPDX-License-Identifier: MIT
// What bodies and the particles in their reach do to each other (free_bodies/body_reach.cl), and
// the sums of it over the particles: of bodies that the water moves, and of those that only feel
// it.
#pragma once

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/time_step.hpp"

namespace splash::sim {

class Fluid;

struct BodyReach {
  BodyReach() = default;
  /// `program`: that of the free bodies; `bodies`: how many.
  BodyReach(Device& device, const cl::Program& program, const FluidParams& params,
            std::size_t bodies);

  /// Finds the particles in reach of `bodies`, and what they do to each other.
  void find(Fluid& fluid, const Step& step, const Buffer<FreeBody>& bodies);
  /// Sums up what these `pressure`s, p / rho^2, do in `pushing` seconds, and rubbing in `rubbing`.
  void weigh(Fluid& fluid, const Step& step, const Buffer<FreeBody>& bodies,
             const Buffer<float>& pressure, double pushing, double rubbing);

  std::size_t count = 0;   ///< of bodies
  std::size_t groups = 0;  ///< of particles
  Buffer<float> reach;
  Buffer<int> reached;
  Buffer<float> parts;  ///< of the sums
  Kernel reach_bodies;
  Kernel weigh_water;
};

}  // namespace splash::sim
