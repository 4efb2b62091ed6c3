// SPDX-License-Identifier: MIT
// The air around a body, from the water's level down: filled from the sky, cell by cell
// (fluid/air_cells.hpp). Bodies and walls are solid; their matter counts in the colour field as the
// water does that they displace.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/fluid/air_cells.hpp"

namespace splash::sim {

/// Where a body is and what it shows.
struct BodyExtent {
  BodyState state;
  Vector3 lower = {0.0, 0.0, 0.0};  ///< corners of the box around it [m]
  Vector3 upper = {0.0, 0.0, 0.0};
  double radius = 0.0;  ///< of the disc with the area that it shows from below [m]
};

class BodyAir {
 public:
  /// `skin`: of all bodies; `volume`: of a particle [m3].
  BodyAir(const Scene& scene, const std::vector<SkinPoint>& skin, double volume);

  /// Where all particles are [m].
  using ReadWater = std::function<std::vector<Vector3>()>;
  /// From now on the bodies are where they are at `time` [s]. `bodies` must outlive what is asked.
  void move_to(double time, const Bodies& bodies);
  /// The water at that time; by default there is none.
  void read(const ReadWater& read_water) { water_ = read_water(); }

  [[nodiscard]] const BodyExtent& extent(std::size_t body) const { return extents_[body]; }
  /// Height of the floor below the body [m].
  [[nodiscard]] double floor_below(std::size_t body) const;
  /// Height to which the water around the body would stand if it were level [m]. Other bodies are
  /// taken for air.
  [[nodiscard]] double level_around(std::size_t body) const;
  /// The air within 2 R of the body, below `level` [m]. Cells lie on one lattice, whatever the body
  /// and the time.
  [[nodiscard]] std::unique_ptr<AirCells> fill(std::size_t body, double level) const;
  /// How far the nearest of a pocket's cells is from the body [m].
  [[nodiscard]] double distance(std::size_t body, const AirCells::Pocket& pocket) const;

 private:
  [[nodiscard]] BodyExtent extent_of(std::size_t body, const BodyState& state) const;
  [[nodiscard]] bool is_solid(const Vector3& place) const;
  [[nodiscard]] double depth_in(std::size_t body, const Vector3& place) const;

  Scene scene_;
  std::vector<std::vector<SkinPoint>> skin_;  ///< of each body
  double spacing_;                            ///< [m]
  double support_;                            ///< [m]
  double volume_;                             ///< of a particle [m3]
  Tank tank_;
  const Bodies* bodies_ = nullptr;
  std::vector<BodyExtent> extents_;
  std::vector<Vector3> water_;  ///< [m]
};

}  // namespace splash::sim
