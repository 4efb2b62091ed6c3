// SPDX-License-Identifier: MIT
// Feet on a pressure-sensing floor. A load where no foot stands is a foot that comes down: the one
// that waits nearest. From then on the loads next to it are its own, until they carry next to
// nothing. What lies between two feet that stand side by side is shared out by the lever between
// them, so that either is felt to leave.
//
// A load moves below a foot as it rolls from heel to toe; the foot itself moves only where its load
// would leave its sole.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "protocol/message.hpp"
#include "sim-server/bodies/motion/floor_motion.hpp"
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

/// Readings of a floor's force sensors to a force and a place for each tile.
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

class PressureFeet {
 public:
  explicit PressureFeet(const Scene& scene);

  /// Tells what each foot does now, once a scan of the floor is complete, of the readings that
  /// count. False: no message of a floor, or of one that the scene has no use for.
  bool take(const protocol::Message& message, const GiveTouch& give, const LetTiles& lets = {});
  /// The same for loads.
  void follow(const std::vector<TileLoad>& loads, const GiveTouch& give);

 private:
  struct Foot {
    std::size_t body = 0;
    Vector3 along = {};  ///< its length's direction on the floor, unit
    double half = 0.0;   ///< half of its length [m]
    double wide = 0.0;   ///< half of its width [m]
    Vector3 place = {};  ///< of its middle, while it stands or where it stood [m]
    Vector3 load = {};   ///< of what it carries [m]
    bool down = false;
    double force = 0.0;   ///< in this scan [N]
    Vector3 moment = {};  ///< of it [N m]
    double near = 0.0;    ///< of the loads that are nearer to it than to any other [N]
  };

  [[nodiscard]] Foot* nearest(const Vector3& place, double reach, const Foot* but);
  void share_out(const TileLoad& load, std::vector<TileLoad>& left);
  void put_down(const std::vector<TileLoad>& left);
  void move(Foot& foot) const;

  FloorSettings floor_;
  TileLoads tiles_;
  std::vector<Foot> feet_;
};

}  // namespace splash::sim
