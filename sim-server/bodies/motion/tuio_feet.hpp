// SPDX-License-Identifier: MIT
// Cursors of TUIO as feet: each that lives is the foot that waited nearest to where it appeared.
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "protocol/message.hpp"
#include "sim-server/bodies/motion/floor_motion.hpp"
#include "sim-server/bodies/motion/tuio_reader.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

class TuioFeet {
 public:
  explicit TuioFeet(const Scene& scene);

  /// Tells what each foot does now, once a frame is complete of a source that may speak. False: the
  /// scene has no use for such a message.
  bool take(const protocol::Message& message, double arrival, const GiveTouch& give,
            const LetSource& lets = {});

 private:
  /// The address, the source and its session number.
  using Name = std::tuple<std::string, std::string, std::int32_t>;
  struct Foot {
    TrackerSource settings;
    Quaternion rest = {0.0, 0.0, 0.0, 1.0};
    Vector3 last = {};                ///< where it stands, or stood [m]
    std::optional<Name> cursor = {};  ///< that it is
    double heard = 0.0;               ///< when its source last said that this lives [s]
  };

  [[nodiscard]] Vector3 place_of(const Foot& foot, const TuioCursor& cursor) const;
  [[nodiscard]] std::optional<Quaternion> rotation_of(const Foot& foot,
                                                      const TuioCursor& cursor) const;
  void follow(const TuioFrame& frame, double arrival, const GiveTouch& give);

  Vector3 room_ = {0.0, 0.0, 0.0};  ///< the surface's origin in the scene [m]
  Quaternion turn_ = {0.0, 0.0, 0.0, 1.0};
  std::vector<Foot> feet_;
  TuioReader reader_;
};

}  // namespace splash::sim
