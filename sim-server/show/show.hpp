// SPDX-License-Identifier: MIT
// The simulation for viewers: read back from the device while somebody looks, and only then.
#pragma once

#include <functional>
#include <vector>

#include "protocol/frame_stream.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/live_rows.hpp"
#include "sim-server/show/state_frame.hpp"

namespace splash::sim {

class Show {
 public:
  /// Listens; `rows` tells the scene's live ones, from any thread. Throws std::runtime_error that
  /// says what to do.
  Show(const protocol::FrameStreamSettings& settings, const Scene& scene, const Fluid& fluid,
       std::function<std::vector<LiveRow>()> rows);

  /// Between two frames: shows what `state` tells and the water, if somebody waits for it, 60 times
  /// a second and a simulated second at most, but 30 times a second where simulated time goes
  /// slower. `now`: monotonic [s]; `seconds`: simulated [s].
  void frame(double now, double seconds, Fluid& fluid, const std::function<ShownState()>& state);

  /// So often the water was read back.
  [[nodiscard]] std::uint64_t shown() const noexcept { return shown_; }
  [[nodiscard]] protocol::Endpoint local() const noexcept { return stream_.local(); }

 private:
  protocol::FrameStream stream_;
  ShownWater water_;
  double next_ = 0.0;   ///< monotonic [s]
  double last_ = -1.0;  ///< simulated time that was shown [s]
  std::uint64_t shown_ = 0;
};

}  // namespace splash::sim
