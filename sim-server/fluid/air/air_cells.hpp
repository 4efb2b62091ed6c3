// SPDX-License-Identifier: MIT
// Air within a box: hollows that are open to the sky, and pockets that water has closed around. The
// box is divided into cells of about one spacing. A cell is air where the colour field sum_j V W of
// all matter at its middle is below a half and no solid is there; air is open when it is joined to
// the box's top through faces of cells that are air.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// `points` [m], followed by the images of those less than `reach` [m] from the floor or a side of
/// the tank; images of images fill the corners. The top is open.
[[nodiscard]] std::vector<Vector3> with_images(std::vector<Vector3> points, const Tank& tank,
                                               double reach);

class AirCells {
 public:
  /// `support` of the kernel; whole cells fill the box, their edges nearest to `spacing` [m].
  AirCells(const Vector3& lower, const Vector3& upper, double spacing, double support);

  /// Matter of that volume [m3] at a place [m].
  void add(const Vector3& place, double volume);
  /// Once all matter is there. `solid`: whether something solid is at a place.
  void fill(const std::function<bool(const Vector3&)>& solid);

  /// Volume of each pocket, from the bottom up [m3].
  [[nodiscard]] const std::vector<double>& pockets() const noexcept { return pockets_; }
  /// Volume of the open air [m3].
  [[nodiscard]] double open() const noexcept { return static_cast<double>(open_) * volume_; }
  /// Whether the middle of any cell of open air is such a place [m].
  [[nodiscard]] bool any_open(const std::function<bool(const Vector3&)>& is_such) const;

 private:
  enum class Cell { matter, air, open, enclosed };
  using Index = std::array<int, 3>;

  [[nodiscard]] std::size_t number(const Index& cell) const {
    const auto row = static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(count_[1]) +
                     static_cast<std::size_t>(cell[1]);
    return row * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(cell[0]);
  }
  [[nodiscard]] Vector3 middle(const Index& cell) const;
  [[nodiscard]] std::array<int, 2> range(std::size_t axis, double x) const;
  /// Cells of air joined to this one become `what`. How many they are; none where it is no air.
  std::size_t join(const Index& first, Cell what);
  template <class Visit>
  void for_each_cell(const Visit& visit) const;
  template <class Visit>
  void for_each_beside(const Index& cell, const Visit& visit) const;

  SmoothingKernel kernel_;
  double support_;                  ///< [m]
  Vector3 lower_;                   ///< [m]
  Vector3 edge_ = {0.0, 0.0, 0.0};  ///< of a cell [m]
  Index count_ = {0, 0, 0};
  double volume_ = 0.0;  ///< of a cell [m3]
  std::vector<double> colour_;
  std::vector<Cell> cells_;
  std::size_t open_ = 0;         ///< cells
  std::vector<double> pockets_;  ///< [m3]
};

}  // namespace splash::sim
