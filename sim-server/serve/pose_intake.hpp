// SPDX-License-Identifier: MIT
// Passes poses from the wire to the bodies that they move, each body's from one sender at a time,
// and what floors say to the feet on them, each source and each sensor from one sender at a time.
// Refused poses are counted by reason and reported to stderr and to viewers, once a second at most.
#pragma once

#include <array>
#include <atomic>
#include <bitset>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/event.hpp"
#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"
#include "sim-server/bodies/motion/pose_refusal.hpp"
#include "sim-server/bodies/motion/pressure_feet.hpp"
#include "sim-server/bodies/motion/tracker_map.hpp"
#include "sim-server/bodies/motion/tuio_feet.hpp"
#include "sim-server/listen/control.hpp"
#include "sim-server/serve/report.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// A sender of poses that says nothing for longer than this has ended [s].
inline constexpr double kSenderEnds = 0.5;
/// The same of a floor, of which nobody may touch anything for a while [s].
inline constexpr double kFloorEnds = 3.0;

/// The senders of one body's poses, or of one floor. Of those that send, the one that began last is
/// followed. What sends again after a silence begins anew.
class PoseSenders {
 public:
  /// `ends`: the silence after which a sender has ended [s].
  explicit PoseSenders(double ends = kSenderEnds) : ends_(ends) {}

  /// Whether a pose that `from` sends at `now` [s] moves the body: no other sender began later.
  [[nodiscard]] bool lets(const protocol::Endpoint& from, double now) const;
  /// A pose of `from` came. Returns whom the body follows in its place, the first time that these
  /// two are seen to send at once; empty: nobody, or that was told.
  std::optional<protocol::Endpoint> hear(const protocol::Endpoint& from, double now);
  /// Whose last pose the body followed; empty: it takes none.
  void follow(const std::optional<protocol::Endpoint>& followed) { followed_ = followed; }
  [[nodiscard]] bool is_followed() const noexcept { return followed_.has_value(); }
  /// When any of them sent last [s].
  [[nodiscard]] double heard() const;
  [[nodiscard]] bool are_silent(double now) const { return now - heard() > ends_; }
  /// Until `from` sends again the others have the body; then it begins anew.
  void forget(const protocol::Endpoint& from);

 private:
  struct Sender {
    protocol::Endpoint from;
    double began = 0.0;                           ///< its first pose since a silence [s]
    double heard = 0.0;                           ///< its last one [s]
    std::optional<protocol::Endpoint> told = {};  ///< the other one of the last line on it
  };
  double ends_;  ///< [s]
  std::vector<Sender> senders_;
  std::optional<protocol::Endpoint> followed_;
  double next_line_ = -std::numeric_limits<double>::infinity();  ///< [s]
};

class PoseIntake {
 public:
  /// A line on a pose that was refused, for viewers. On the thread that listens.
  using Tell = std::function<void(const std::string& reason)>;

  explicit PoseIntake(const Simulation& simulation, Tell tell = {})
      : simulation_(simulation),
        tell_(std::move(tell)),
        trackers_(simulation.scene()),
        surfaces_(simulation.scene()),
        floor_(simulation.scene()),
        senders_(simulation.scene().bodies.size()) {}

  /// Takes a pose. Called on the control thread.
  void take(const protocol::BodyPose& pose, const PoseMoment& moment);
  /// Takes a message that is no command, on the same thread. Returns false when no sender that the
  /// scene's `tracking` names may have sent it.
  bool track(const protocol::Message& message, const PoseMoment& moment);

  /// Lets poses move a body that has a motion of its own, or no longer. Whose poses move a body is
  /// settled anew: the next pose of `from` takes it, and who lets go leaves it to the others. On
  /// the same thread. Returns the reason why it cannot; empty: it did.
  [[nodiscard]] std::string grab(std::int32_t body, bool on, const protocol::Endpoint& from);

  /// The number of poses that were refused here. May be called from any thread.
  [[nodiscard]] std::uint64_t refused() const noexcept;
  /// The refused poses by reason, those included that the control port refused.
  [[nodiscard]] NamedCounts refusals(const ControlCounts& wire) const;

 private:
  void stand(const FloorTouch& touch, double arrival) const;
  /// What two senders both send, in the words of the line on it.
  struct Shared {
    std::string what;
    std::string name;    ///< short, for viewers
    std::string until;   ///< the sender that began last is followed
    std::string remedy;  ///< beside stopping one of them
  };
  /// Returns whether the floor follows the sender `moment.from`. When a second sender begins,
  /// `tell` is called with the sender that is refused and the one that is followed.
  [[nodiscard]] bool follows(PoseSenders& senders, const PoseMoment& moment,
                             const std::function<void(const protocol::Endpoint& waits,
                                                      const protocol::Endpoint& moves)>& tell);
  [[nodiscard]] bool follows_source(const std::string& address, const std::string& source,
                                    const PoseMoment& moment);
  [[nodiscard]] bool follows_tiles(std::int32_t first, const PoseMoment& moment);
  [[nodiscard]] PoseRefusal give(std::int32_t body, const Vector3& position,
                                 const Quaternion& rotation, const PoseMoment& moment);
  void note(std::int32_t body, PoseRefusal refusal, double now);
  void say(std::int32_t body, PoseRefusal refusal, double now);
  /// Of a body that a pose puts far from the water, once until it comes near.
  void say_far(std::int32_t body, const Vector3& place, double now);
  void say_both(const Shared& shared, const protocol::Endpoint& waits,
                const protocol::Endpoint& moves) const;

  const Simulation& simulation_;
  Tell tell_;
  TrackerMap trackers_;
  TuioFeet surfaces_;
  PressureFeet floor_;
  std::vector<PoseSenders> senders_;                  ///< of each body
  std::map<std::int32_t, PoseSenders> tile_senders_;  ///< by the first sensor of their messages
  std::map<std::pair<std::string, std::string>, PoseSenders> source_senders_;  ///< of TUIO
  std::array<std::atomic<std::uint64_t>, kPoseRefusals> counts_ = {};
  std::bitset<256> reported_;  ///< bodies that no pose can move
  std::bitset<256> far_;       ///< bodies that were told to be far from the water
  double next_line_ = 0.0;     ///< monotonic [s]
  double next_far_line_ = 0.0;
  double next_tiles_line_ = 0.0;
};

}  // namespace splash::sim
