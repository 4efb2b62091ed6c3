// SPDX-License-Identifier: MIT
// The gauges of a scene, and the file that they are written to.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// What the tank's walls do to the water: the forces that sensors in walls feel, computed on the
/// device by the formula that moves the particles.
class WallPush {
 public:
  /// Builds the kernel; throws std::runtime_error for the device.
  explicit WallPush(Fluid& fluid);

  /// On each particle, in the fluid's order [m/s2]; waits. The fluid is prepared, with walls where
  /// `step` has them.
  [[nodiscard]] std::vector<Vector3> read(Fluid& fluid, const Step& step);

 private:
  Kernel push_by_walls_;
  Buffer<float> push_;
};

/// All gauges of a scene: which numbers they give, and reading them off the fluid. With the grid
/// solver the forces on bodies are those of Simulation::measure_forces(), zero without it.
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

/// Gauges written to a CSV file, a line per sample.
class GaugeFile {
 public:
  /// Opens the file and writes the columns' names. Throws std::invalid_argument when the scene
  /// names no gauges, program::WriteError when the file cannot be written.
  GaugeFile(const std::filesystem::path& path, const Scene& scene);

  /// Writes a sample if one is due at `seconds`, the end of a frame. Throws program::WriteError.
  void note(double seconds, Fluid& fluid, const Bodies& bodies);
  /// Begins a new file at the same path, with the columns' names. Throws program::WriteError.
  void reopen();

 private:
  /// A line.
  template <class Values>
  void write(const Values& values);

  std::filesystem::path path_;
  Gauges gauges_;
  std::ofstream out_;
};

}  // namespace splash::sim
