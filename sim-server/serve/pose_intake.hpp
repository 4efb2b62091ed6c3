// SPDX-License-Identifier: MIT
// Poses from the wire to the bodies that they move. What is not taken is counted by its reason and
// said, to stderr and viewers, but not over and over.
#pragma once

#include <array>
#include <atomic>
#include <bitset>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "protocol/event.hpp"
#include "protocol/message.hpp"
#include "sim-server/bodies/motion/pose_refusal.hpp"
#include "sim-server/bodies/motion/pressure_feet.hpp"
#include "sim-server/bodies/motion/tracker_map.hpp"
#include "sim-server/bodies/motion/tuio_feet.hpp"
#include "sim-server/listen/control.hpp"
#include "sim-server/serve/report.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

class PoseIntake {
 public:
  /// What is said of a body and why its pose was refused, for viewers. On the thread that listens.
  using Tell = std::function<void(const std::string& body, const std::string& reason)>;

  explicit PoseIntake(const Simulation& simulation, Tell tell = {})
      : simulation_(simulation),
        tell_(std::move(tell)),
        trackers_(simulation.scene()),
        surfaces_(simulation.scene()),
        floor_(simulation.scene()) {}

  /// On the thread that listens, for each pose as it comes.
  void take(const protocol::BodyPose& pose, const PoseMoment& moment);
  /// Same, for each message that is no command; false: no sender that
  /// the scene's `tracking` names may have sent it.
  bool track(const protocol::Message& message, const PoseMoment& moment);

  /// All that were refused here. From any thread.
  [[nodiscard]] std::uint64_t refused() const noexcept;
  /// By reason, with what was refused at the wire already.
  [[nodiscard]] NamedCounts refusals(const ControlCounts& wire) const;

 private:
  void stand(const FloorTouch& touch, double arrival) const;
  [[nodiscard]] PoseRefusal give(const protocol::BodyPose& pose, const PoseMoment& moment) const;
  void note(std::int32_t body, PoseRefusal refusal, double now);
  void say(std::int32_t body, PoseRefusal refusal, double now);

  const Simulation& simulation_;
  Tell tell_;
  TrackerMap trackers_;
  TuioFeet surfaces_;
  PressureFeet floor_;
  std::array<std::atomic<std::uint64_t>, kPoseRefusals> counts_ = {};
  std::bitset<256> said_;   ///< of bodies that no pose can move
  double next_line_ = 0.0;  ///< monotonic [s]
};

}  // namespace splash::sim
