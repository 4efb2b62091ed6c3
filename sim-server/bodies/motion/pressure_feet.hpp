// SPDX-License-Identifier: MIT
// Feet on a pressure-sensing floor. A load where no foot stands is a foot that comes down: the one
// that waits nearest. From then on the loads next to it are its own, until they carry next to
// nothing. What lies between two feet that stand side by side is shared out by the lever between
// them, so that either is felt to leave.
//
// A load moves below a foot as it rolls from heel to toe; the foot itself moves only where its load
// would leave its sole.
#pragma once

#include <vector>

#include "protocol/message.hpp"
#include "sim-server/bodies/motion/tile_loads.hpp"
#include "sim-server/bodies/motion/touch.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

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
