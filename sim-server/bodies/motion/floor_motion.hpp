// SPDX-License-Identifier: MIT
// A foot on a floor that tells where it is touched, and nothing of what is above it. While it is
// touched the foot stands there; then it rises. The next touch finds it anywhere: it comes down
// from just above the water, so that it meets the water within a hundredth of a second of the
// touch.
#pragma once

#include <functional>
#include <mutex>
#include <optional>

#include "sim-server/bodies/motion/posed_motion.hpp"

namespace splash::sim {

/// What a floor says of a body that stands on it.
struct FloorTouch {
  std::size_t body = 0;                     ///< index among the scene's
  bool down = false;                        ///< false: it has left the floor
  Vector3 place = {};                       ///< where it stands, while it does [m]
  std::optional<Quaternion> rotation = {};  ///< body to world, where that is known
};
using GiveTouch = std::function<void(const FloorTouch& touch)>;

/// How a foot comes and goes.
struct FloorSteps {
  double hover = 0.0;  ///< above where it stands, out of the water: it falls from there [m]
  double lift = 0.12;  ///< above that it waits for the next touch [m]
  double fall = 1.0;   ///< [m/s]
  double rise = 0.6;   ///< [m/s]
};

class FloorMotion : public PosedMotion {
 public:
  /// `stands`: the pose of the foot on the floor; of its place the first two parts are those where
  /// it waits for its first touch.
  FloorMotion(const Keyframe& stands, const FloorSteps& steps);

  /// The foot stands at `place`, of which the height is left out [m]; without a rotation as it did.
  void touch(const Vector3& place, const std::optional<Quaternion>& rotation, double arrival);
  /// Nothing touches the floor any more.
  void lift(double arrival);

  /// Refused: it takes no poses.
  PoseRefusal push(const Vector3& position, const Quaternion& rotation,
                   const PoseStamp& stamp) override;
  void begin(const PlayedFrame& frame) override;
  [[nodiscard]] BodyState at(double seconds) const override;

 private:
  /// What the floor said last.
  struct Touch {
    bool down = false;
    Vector3 place = {};  ///< [m]
    Quaternion rotation = {0.0, 0.0, 0.0, 1.0};
    double arrival = 0.0;  ///< our clock [s]
    double lifted = 0.0;   ///< the same, when it was no longer touched [s]
  };
  /// Whether the foot is to stand, at `wall`.
  [[nodiscard]] static bool is_down(const Touch& touch, double wall);

  Keyframe stands_;
  FloorSteps steps_;
  std::mutex mutex_;
  Touch touch_;  ///< under mutex_
  bool down_ = false;
  double seconds_ = 0.0;                   ///< simulated time at the frame's start [s]
  double length_ = 0.0;                    ///< of the frame [s]
  BodyState now_;                          ///< then
  Quaternion end_ = {0.0, 0.0, 0.0, 1.0};  ///< its rotation at the frame's end
};

}  // namespace splash::sim
