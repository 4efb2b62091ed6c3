// SPDX-License-Identifier: MIT
// A scene before its time begins, in cells a particle spacing wide: water, solid or air.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

enum class Matter : std::uint8_t { air, water, solid };

/// Cells around all water and some to each side. What a cell is, its middle says: solid outside the
/// tank, in the slope and where a body displaces water; else water in a block that reaches half a
/// cell farther on all sides, but not through the gate, so that blocks that almost touch do touch;
/// else air.
class WaterCells {
 public:
  /// `poses` of the bodies, one each; their times are ignored.
  WaterCells(const Scene& scene, std::span<const Keyframe> poses);

  /// No cell: beyond all that are looked at.
  static constexpr std::int64_t kNone = -1;

  [[nodiscard]] std::int64_t count() const noexcept { return counts_[0] * counts_[1] * counts_[2]; }
  [[nodiscard]] Matter at(std::int64_t cell) const {
    return matter_[static_cast<std::size_t>(cell)];
  }
  /// Its middle [m].
  [[nodiscard]] Vector3 middle(std::int64_t cell) const;
  /// The cells that share a face with this one; the gate keeps cells apart.
  [[nodiscard]] std::array<std::int64_t, 6> beside(std::int64_t cell) const;
  /// The cell of water whose middle is nearest to a place, of those around it on its side of the
  /// gate; or kNone.
  [[nodiscard]] std::int64_t water_near(const Vector3& place) const;

 private:
  using Index = std::array<std::int64_t, 3>;
  [[nodiscard]] std::int64_t number(const Index& index) const noexcept;
  [[nodiscard]] Index index_of(std::int64_t cell) const noexcept;

  Index counts_ = {};
  Vector3 lower_ = {};
  double width_ = 0.0;  ///< of a cell: a particle spacing [m]
  Gate gate_;
  std::vector<Matter> matter_;
};

}  // namespace splash::sim
