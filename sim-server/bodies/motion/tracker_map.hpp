// SPDX-License-Identifier: MIT
// Messages of trackers to poses of bodies: as the scene's `tracking` says, and those of /body/pose
// that name their body.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "sim-server/bodies/motion/pose_clock.hpp"
#include "sim-server/bodies/motion/pose_refusal.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// What a tracker's message made of a body.
struct MappedPose {
  std::size_t body = 0;  ///< index among the scene's
  PoseRefusal refusal = PoseRefusal::none;
  Vector3 position = {0.0, 0.0, 0.0};          ///< of the body's origin [m]
  Quaternion rotation = {0.0, 0.0, 0.0, 1.0};  ///< body to world, unit
};

/// A vector in the sender's axes, in the scene's before its room is turned.
[[nodiscard]] Vector3 in_scene_axes(const TrackerSource& source, const Vector3& theirs);

class TrackerMap {
 public:
  explicit TrackerMap(const Scene& scene);

  /// Calls `give` for each pose that the message completes, and for what is none. False: no source
  /// has such a message.
  bool take(const protocol::Message& message, const PoseStamp& stamp,
            const std::function<void(const MappedPose&)>& give);

  /// Whether a source's sender may well send this, too: its address begins as one of the source's.
  /// A tracker tells more than a scene has a use for.
  [[nodiscard]] bool is_of_sender(const std::string& address) const;

 private:
  /// A position and a rotation of one moment may come in two messages, in either order.
  struct Source {
    TrackerSource settings;
    Vector3 room = {0.0, 0.0, 0.0};          ///< the sender's origin in the scene [m]
    Quaternion turn = {0.0, 0.0, 0.0, 1.0};  ///< the sender's room to the scene
    Quaternion rest = {0.0, 0.0, 0.0, 1.0};  ///< the body's, where the sender tells no rotation
    std::optional<Vector3> position = {};  ///< in the scene's axes, its rotation not yet known [m]
    std::optional<Quaternion> rotation = {};  ///< same, its position not yet known
    PoseStamp stamp = {};                     ///< of the one that is known
  };

  /// Takes in a message that the source's addresses match; a pose once it is complete, or why it
  /// is refused.
  [[nodiscard]] static std::optional<MappedPose> read(Source& source,
                                                      const protocol::Message& message,
                                                      const PoseStamp& stamp, bool has_position,
                                                      bool has_rotation);
  [[nodiscard]] static MappedPose place(const Source& source);

  std::vector<Source> sources_;
  std::set<std::string> senders_;  ///< what their addresses begin with, up to the second /
};

}  // namespace splash::sim
