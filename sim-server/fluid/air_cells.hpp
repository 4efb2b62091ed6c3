// SPDX-License-Identifier: MIT
// Air within a box: hollows that are open to the sky, and pockets that water has closed around. The
// box is divided into cells of about one spacing. A cell is air where the colour field sum_j V W of
// all matter at its middle is below a half and no solid is there; air is open when it is joined to
// the box's top through faces of cells that are air.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "sim-server/fluid/smoothing.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

class AirCells {
 public:
  /// `support` of the kernel; whole cells fill the box, their edges nearest to `spacing` [m].
  AirCells(const Vector3& lower, const Vector3& upper, double spacing, double support);

  /// Matter of that volume [m3] at a place [m].
  void add(const Vector3& place, double volume);
  /// Once all matter is there. `solid`: whether something solid is at a place.
  void fill(const std::function<bool(const Vector3&)>& solid);

  /// What the colour field lacks to one, around each pocket: the kernel weighs one, so that is the
  /// air, however small the pocket. Cells within the support belong to the nearest air.
  void measure();

  struct Pocket {
    double volume = 0.0;               ///< of its cells [m3]
    double air = 0.0;                  ///< by the colour field, once that was measured [m3]
    Vector3 centre = {0.0, 0.0, 0.0};  ///< [m]
    std::vector<Vector3> cells;        ///< their middles [m]
    bool at_side = false;              ///< reaches a side or the bottom of the box
  };
  /// All of them, from the bottom up.
  [[nodiscard]] const std::vector<Pocket>& pockets() const noexcept { return pockets_; }
  /// Volume of the open air [m3].
  [[nodiscard]] double open() const noexcept { return static_cast<double>(open_) * volume_; }
  /// Whether the cell there is open air; false outside the box.
  [[nodiscard]] bool is_open(const Vector3& place) const { return at(place) == kOpen; }
  /// Of which pocket it is, by its number among them; -1: of none.
  [[nodiscard]] int pocket_at(const Vector3& place) const { return std::max(at(place), -1); }

 private:
  /// What a cell is; that of a pocket has its number.
  static constexpr int kMatter = -4;
  static constexpr int kAir = -3;
  static constexpr int kOpen = -2;
  using Index = std::array<int, 3>;

  [[nodiscard]] std::size_t number(const Index& cell) const {
    const auto row = static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(count_[1]) +
                     static_cast<std::size_t>(cell[1]);
    return row * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(cell[0]);
  }
  [[nodiscard]] Vector3 middle(const Index& cell) const;
  [[nodiscard]] Index index(const Vector3& place) const;
  [[nodiscard]] std::array<int, 2> range(std::size_t axis, double x) const;
  [[nodiscard]] int at(const Vector3& place) const;
  /// Cells joined to this one become `what`; nothing where it is no air.
  std::vector<Index> join(const Index& first, int what);
  void add_pocket(const std::vector<Index>& joined);
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
  std::vector<int> cells_;
  std::size_t open_ = 0;  ///< cells
  std::vector<Pocket> pockets_;
};

}  // namespace splash::sim
