// SPDX-License-Identifier: MIT
// What the tiles of a floor carry: readings of their force sensors to a force and a place for each.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "protocol/message.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Returns whether a message counts whose first reading is of sensor `first`. An empty function
/// lets all messages count.
using LetTiles = std::function<bool(std::int32_t first)>;

/// What a tile carries.
struct TileLoad {
  double force = 0.0;  ///< [N]
  Vector3 place = {};  ///< its centre of pressure, in the scene [m]
};

/// Sensors are numbered from 0: those of tile 0, then of tile 1, as the tiles are
/// (configs/rigs/tiles36.yaml). Four of a tile are its corners at -x -y, +x -y, -x +y, +x +y.
class TileLoads {
 public:
  explicit TileLoads(const TrackingSettings& tracking);

  /// /tile/pressure first f...: takes the readings in. True: with these a scan is complete, or they
  /// begin another one.
  bool take(const protocol::Message& message, const LetTiles& lets = {});
  /// Tiles that carry more than nothing, as of the last readings.
  [[nodiscard]] std::vector<TileLoad> loads() const;

 private:
  FloorSettings floor_;
  Vector3 origin_;
  Quaternion turn_;
  std::vector<double> readings_;  ///< [N]
  std::size_t next_ = 0;          ///< sensor that comes next in a scan
};

}  // namespace splash::sim
