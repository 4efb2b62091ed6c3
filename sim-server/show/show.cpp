// SPDX-License-Identifier: MIT
#include "sim-server/show/show.hpp"

#include "sim-server/show/scene_frame.hpp"

namespace splash::sim {
namespace {

/// No screen shows more [s].
constexpr double kPeriod = 1.0 / 60.0;

}  // namespace

Show::Show(const protocol::FrameStreamSettings& settings, const Scene& scene, const Fluid& fluid)
    : stream_(settings, scene_frame(scene, fluid.params().count,
                                    static_cast<double>(fluid.params().spacing))) {}

void Show::frame(double now, Fluid& fluid, const std::function<ShownState()>& state) {
  if (now < next_ || !stream_.wanted()) return;
  next_ = now + kPeriod;
  read(fluid);
  stream_.offer(state_frame(water_, state()));
  ++shown_;
}

void Show::read(Fluid& fluid) {
  const PointArrays& points = fluid.particles();
  water_.count = static_cast<std::size_t>(fluid.params().count);
  water_.stride = static_cast<std::size_t>(points.stride);
  water_.least_density = fluid.params().least_density;
  const std::size_t vectors = 2 * water_.stride + water_.count;
  water_.position.resize(vectors);
  water_.velocity.resize(vectors);
  water_.id.resize(water_.count);
  water_.density.resize(water_.count);
  water_.moving.resize(water_.count);
  Device& device = fluid.device();
  points.position.enqueue_read(device, water_.position);
  points.velocity.enqueue_read(device, water_.velocity);
  points.id.enqueue_read(device, water_.id);
  fluid.density().enqueue_read(device, water_.density);
  fluid.moving().enqueue_read(device, water_.moving);
  device.queue().finish();
}

}  // namespace splash::sim
