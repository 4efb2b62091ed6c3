// SPDX-License-Identifier: MIT
// The water as files for ParaView: legacy VTK, binary, one for each moment, and water.vtk.series,
// which has them all with their times.
#pragma once

#include <filesystem>
#include <string>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/show/state_frame.hpp"

namespace splash::sim {

class VtkFiles {
 public:
  static constexpr double kPeriod = 1.0 / 25.0;  ///< simulated, from one file to the next [s]

  /// Makes the folder where there is none. Throws program::WriteError.
  explicit VtkFiles(const std::filesystem::path& folder);

  /// Writes the water if that is due at `seconds`, the end of a frame. Throws program::WriteError.
  void note(double seconds, Fluid& fluid);

 private:
  void write_series();

  std::filesystem::path folder_;
  ShownWater water_;
  std::string listed_;  ///< the series so far
  int files_ = 0;
  double next_ = 0.0;  ///< [s]
};

/// What a file holds: each particle's place [m], in the order of their ids, its velocity [m/s],
/// density [kg/m3], and 1 where it is spray.
[[nodiscard]] std::string vtk_text(const ShownWater& water, double seconds);

}  // namespace splash::sim
