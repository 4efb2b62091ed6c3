// SPDX-License-Identifier: MIT
// What a body shows of itself as it moves, the water's level around it, and the air at it: filled
// from the sky down, cell by cell (fluid/air/air_cells.hpp). Bodies and walls are solid; their
// matter counts in the colour field as the water does that they displace.
#pragma once

#include <functional>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/fluid/air/air_cells.hpp"

namespace splash::sim {

/// Where a body is and what it shows.
struct BodyExtent {
  BodyState state;
  Vector3 lower = {0.0, 0.0, 0.0};  ///< corners of the box around it [m]
  Vector3 upper = {0.0, 0.0, 0.0};
  Vector3 along = {0.0, 0.0, -1.0};  ///< unit vector of its motion
  Vector3 front = {0.0, 0.0, 0.0};   ///< middle of the skin that faces its motion [m]
  double radius = 0.0;     ///< of the disc with the area that it shows along its motion [m]
  double thickness = 0.0;  ///< its volume by that area [m]
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
  /// Of its area across the motion, the share where all of the body is nearer to its front than a
  /// distance [m], [1].
  [[nodiscard]] std::function<double(double)> free_behind(std::size_t body) const;
  /// Height of the floor below the body [m].
  [[nodiscard]] double floor_below(std::size_t body) const;
  /// Height to which the water around the body would stand if it were level [m]. Other bodies are
  /// taken for air.
  [[nodiscard]] double level_around(std::size_t body) const;
  /// Whether air that lies at least `below` [m] under the height `level` [m] joins the air above
  /// the water.
  /// Only air counts that is within the body's radius of the body, or of the straight line between
  /// `from` [m] and the body's front.
  [[nodiscard]] bool is_open_to(std::size_t body, const Vector3& from, double level,
                                double below) const;

 private:
  [[nodiscard]] AirCells fill(std::size_t body, const Vector3& from, double level) const;
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
