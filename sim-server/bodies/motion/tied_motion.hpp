// SPDX-License-Identifier: MIT
// A body that hangs on a device by a spring: the water moves it, poses move what draws it.
#pragma once

#include "sim-server/bodies/motion/free_motion.hpp"
#include "sim-server/bodies/motion/live_motion.hpp"
#include "sim-server/bodies/motion/posed_motion.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

/// The device's end of the spring. It rests until poses come. Where they jump, it goes over to them
/// along a smooth way, so that the spring never pulls at once.
class Tether : public PosedMotion {
 public:
  /// `centre`: where the spring holds the body, its centre of mass, from where poses say that it is
  /// [m]. All other states are of that centre.
  Tether(const Keyframe& rest, const LiveGap& gap, double delay_limit, const Vector3& centre)
      : centre_(centre), hand_(rest, {}, gap, delay_limit) {}

  PoseRefusal push(const Vector3& position, const Quaternion& rotation,
                   const PoseStamp& stamp) override {
    return hand_.push(position + rotate(unit(rotation), centre_), rotation, stamp);
  }
  void begin(const PlayedFrame& frame) override;
  [[nodiscard]] BodyState at(double seconds) const override;
  /// From `seconds` on it begins where the body is.
  void begin_at(const BodyState& body, double seconds);
  /// Whether it moves within the frame that begins at `seconds`.
  [[nodiscard]] bool moves(double seconds, double frame) const;

 private:
  void go_over(const BodyState& from, double seconds);

  Vector3 centre_;
  LiveMotion hand_;
  Vector3 way_ = {};    ///< back from the poses to where it was when it last began to go over [m]
  Vector3 turn_ = {};   ///< the same of its rotation [rad]
  double since_ = 0.0;  ///< when that was [s]
  double takes_ = 0.0;  ///< the way over [s]
};

class TiedMotion : public FreeMotion {
 public:
  TiedMotion(const BodyState& start, const LiveGap& gap, double delay_limit,
             const Vector3& centre = {0.0, 0.0, 0.0})
      : FreeMotion(start),
        tether_({0.0, start.position, start.rotation}, gap, delay_limit, centre) {}

  [[nodiscard]] Tether& tether() noexcept { return tether_; }
  /// The spring is slack, too.
  void reset(double seconds) noexcept override {
    FreeMotion::reset(seconds);
    tether_.begin_at(at(seconds), seconds);
  }

 private:
  Tether tether_;
};

}  // namespace splash::sim
