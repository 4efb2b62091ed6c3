// SPDX-License-Identifier: MIT
// A body that follows a motion of its own until it is grabbed. While it is held and poses come it
// goes over to them, and back when it is let go or when they stay out; on either way it moves
// along a smooth blend of the two.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "sim-server/bodies/motion/live_motion.hpp"
#include "sim-server/bodies/motion/posed_motion.hpp"

namespace splash::sim {

class GrabbedMotion : public PosedMotion {
 public:
  explicit GrabbedMotion(std::unique_ptr<Motion> own) : own_(std::move(own)) {}

  /// Refused as not_tracked while it is not grabbed.
  PoseRefusal push(const Vector3& position, const Quaternion& rotation,
                   const PoseStamp& stamp) override;
  void begin(const PlayedFrame& frame) override;
  [[nodiscard]] BodyState at(double seconds) const override;
  void grab(bool on) override;
  void restart(double seconds) override { begun_ = seconds; }
  [[nodiscard]] bool is_held() const noexcept override { return held_; }
  [[nodiscard]] bool is_tracked() const noexcept override { return false; }

  [[nodiscard]] double fastest() const override { return own_->fastest(); }
  [[nodiscard]] std::vector<double> moments() const override { return own_->moments(); }

 private:
  /// The share of the poses in where the body is.
  struct Share {
    double value = 0.0;  ///< [1]
    double rate = 0.0;   ///< [1/s]
  };
  [[nodiscard]] Share share(double seconds) const;
  [[nodiscard]] BodyState own(double seconds) const { return own_->at(seconds - begun_); }
  void turn_over(double seconds, bool held);

  std::unique_ptr<Motion> own_;
  double begun_ = 0.0;  ///< simulated time at which its own motion began [s]
  std::mutex mutex_;
  bool grabbed_ = false;              ///< under mutex_, as the next three
  bool grabbed_anew_ = false;         ///< since the last frame began
  double last_pose_ = 0.0;            ///< our clock [s]
  std::unique_ptr<LiveMotion> hand_;  ///< null until it was first grabbed

  std::atomic<bool> held_{false};
  double since_ = 0.0;  ///< simulated time when it last turned over [s]
  double takes_ = 0.0;  ///< the way over [s]
  double from_ = 0.0;   ///< the share then [1]
};

}  // namespace splash::sim
