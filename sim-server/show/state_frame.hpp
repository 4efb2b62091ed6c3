// SPDX-License-Identifier: MIT
// The state of a scene as a viewer gets it (view-server/README.md, SPS1): places in 16 bits an axis
// on a box around all particles.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/frame.hpp"
#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// What was read of the water: each vector as the device keeps it, in the grid's order.
struct ShownWater {
  std::size_t count = 0;
  std::size_t stride = 0;       ///< between the x, y and z parts of a vector
  float least_density = 0.0F;   ///< less is spray [kg/m3]
  std::vector<float> position;  ///< [m]
  std::vector<float> velocity;  ///< [m/s]
  std::vector<int> id;
  std::vector<float> density;  ///< [kg/m3]
  std::vector<int> moving;     ///< 0: asleep
};

enum BodyFlag : std::uint32_t { kBodyFree = 1, kBodyTracked = 2, kBodyGrabbed = 4 };
enum ParticleFlag : std::uint8_t { kBubble = 1, kAsleep = 2, kSpray = 4 };

struct ShownBody {
  BodyState state;
  std::uint32_t flags = 0;  ///< of BodyFlag
};

struct ShownState {
  double moment = 0.0;   ///< when it sounds, Unix time [s]
  double seconds = 0.0;  ///< simulated time [s]
  std::int64_t steps = 0;
  std::vector<ShownBody> bodies;
  std::vector<Vector3> bubbles;  ///< [m]
};

inline constexpr double kShownSpeed = 8.0;  ///< faster particles are shown at this speed [m/s]

[[nodiscard]] protocol::ViewFrame state_frame(const ShownWater& water, const ShownState& state);

// What viewers and files are shown of the water, as the device holds it.

/// Reads the water back from the device, between two frames; waits.
void read_water(Fluid& fluid, ShownWater& water);

}  // namespace splash::sim
