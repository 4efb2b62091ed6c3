// SPDX-License-Identifier: MIT
#include "sim-server/show/read_water.hpp"

namespace splash::sim {

void read_water(Fluid& fluid, ShownWater& water) {
  Device& device = fluid.device();
  const PointArrays& points = fluid.particles();
  water.count = static_cast<std::size_t>(fluid.params().count);
  water.stride = static_cast<std::size_t>(points.stride);
  water.least_density = fluid.params().least_density;
  const std::size_t vectors = 2 * water.stride + water.count;
  water.position.resize(vectors);
  water.velocity.resize(vectors);
  water.id.resize(water.count);
  water.density.resize(water.count);
  water.moving.resize(water.count);
  points.position.enqueue_read(device, water.position);
  points.velocity.enqueue_read(device, water.velocity);
  points.id.enqueue_read(device, water.id);
  fluid.density().enqueue_read(device, water.density);
  fluid.moving().enqueue_read(device, water.moving);
  device.queue().finish();
}

}  // namespace splash::sim
