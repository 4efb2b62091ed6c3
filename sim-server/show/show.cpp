// SPDX-License-Identifier: MIT
#include "sim-server/show/show.hpp"

#include <utility>

#include "sim-server/show/scene_frame.hpp"
#include "sim-server/show/state_frame.hpp"

namespace splash::sim {
namespace {

/// No screen shows more [s].
constexpr double kPeriod = 1.0 / 60.0;
/// So much longer a viewer of slow water waits for simulated time to go on [s].
constexpr double kPatience = kPeriod;

}  // namespace

Show::Show(const protocol::FrameStreamSettings& settings, const Scene& scene, const Fluid& fluid,
           std::function<std::vector<LiveRow>()> rows)
    : stream_(settings,
              [scene, count = fluid.params().count,
               spacing = static_cast<double>(fluid.params().spacing),
               rows = std::move(rows)] { return scene_frame(scene, count, spacing, rows()); }) {}

void Show::frame(double now, double seconds, Fluid& fluid,
                 const std::function<ShownState()>& state) {
  const bool soon = seconds > last_ && seconds < last_ + kPeriod && now < next_ + kPatience;
  if (now < next_ || soon || !stream_.wanted()) return;
  next_ = now + kPeriod;
  last_ = seconds;
  read_water(fluid, water_);
  stream_.offer(state_frame(water_, state()));
  ++shown_;
}

}  // namespace splash::sim
