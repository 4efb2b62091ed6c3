// SPDX-License-Identifier: MIT
// All gauges of a scene: which numbers they give, and reading them off the fluid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/gauge/wall_push.hpp"
#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

class Gauges {
 public:
  /// `scene` has at least one probe.
  explicit Gauges(const Scene& scene);

  /// `time`, then name_quantity for each number; units are in sim-server/gauge/README.md.
  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
  /// Whether a sample is due at the end of a frame.
  [[nodiscard]] bool is_due(double seconds) const noexcept;
  /// One number per column, for the state at `seconds`; waits for the device. Where pressures are
  /// asked for, density is computed once more: the state goes on as if nobody had looked.
  [[nodiscard]] std::vector<double> read(double seconds, Fluid& fluid, const Bodies& bodies);
  /// The same of a state on the host.
  [[nodiscard]] std::vector<double> read(double seconds, const WaterState& water,
                                         const Bodies& bodies) const;

 private:
  void add(const GaugeSettings& probe, double seconds, const WaterState& water,
           const Bodies& bodies, std::vector<double>& row) const;

  Scene scene_;
  std::vector<std::string> columns_;
  bool pressures_ = false;
  std::optional<WallPush> wall_push_;  ///< from the first pressure that is read
  double next_ = 0.0;                  ///< when the next sample is due [s]
};

}  // namespace splash::sim
