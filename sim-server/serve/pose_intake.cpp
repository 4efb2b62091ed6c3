// SPDX-License-Identifier: MIT
#include "sim-server/serve/pose_intake.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "program/text.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// Senders are remembered for so long, to be told of when they come back [s]; so many at most: some
/// programs send each pose from another port.
constexpr double kRemembered = 5.0;
constexpr std::size_t kMost = 16;
constexpr double kLinePeriod = 1.0;  ///< between two lines of a kind [s]

/// TUIO sources whose senders are remembered: as many as its reader knows.
constexpr std::size_t kMostSources = 16;

constexpr const char* kWhatPosesAre =
    "Poses are in metres, x y z with z up, from the tank's origin; `unit`, `axes`, `position` and "
    "`yaw` of the scene's `tracking` map what a sender means otherwise (configs/README.md).";

double as_double(float value) {
  return static_cast<double>(value);
}

/// "'hand'", or its number where the scene has no such body.
std::string name_of(const Scene& scene, std::int32_t body) {
  const auto index = static_cast<std::size_t>(body);
  if (index >= scene.bodies.size()) return std::to_string(body);
  return "'" + scene.bodies[index].name + "'";
}

PoseStamp stamp_of(const PoseMoment& moment) {
  const std::uint64_t sender = std::uint64_t{moment.from.address} << 16U | moment.from.port;
  return {moment.arrival, moment.sent, sender};
}

/// Whether it was no pose at all: what sends those moves nothing, and keeps nobody else from it.
bool is_no_pose(PoseRefusal refusal) {
  return refusal == PoseRefusal::not_finite || refusal == PoseRefusal::no_rotation ||
         refusal == PoseRefusal::too_far;
}

/// A hand beside the tank is nothing to wonder at: not within the tank's largest edge of it, nor
/// within this [m].
constexpr double kBeside = 2.0;
/// But nobody reaches so far below the floor that the water stands on [m].
constexpr double kBelow = 0.25;

std::string length_text(double metres) {
  return program::format("%.*f m", metres < 10.0 ? 2 : 1, metres);
}

/// What is said of a body that poses put where no water can be meant: the sender's unit, axes or
/// origin are likely to be others than the scene's. "39.4 m outside of the tank" or "0.85 m below
/// the tank's floor"; empty: the place [m] is none to wonder at.
std::optional<std::string> far_off(const Tank& tank, const Vector3& place) {
  const double below = tank.lower[2] - place[2];
  double edge = kBeside;
  Vector3 outside = {};
  for (std::size_t i = 0; i < 3; ++i) {
    edge = std::max(edge, tank.upper[i] - tank.lower[i]);
    outside[i] = std::max({tank.lower[i] - place[i], place[i] - tank.upper[i], 0.0});
  }
  if (length(outside) > edge) return length_text(length(outside)) + " outside of the tank";
  if (below > kBelow) return length_text(below) + " below the tank's floor";
  return std::nullopt;
}

/// "0.30 1.20 -0.85 m".
std::string in_metres(const Vector3& place) {
  return program::format("%.2f %.2f %.2f m", place[0], place[1], place[2]);
}

}  // namespace

bool PoseSenders::lets(const protocol::Endpoint& from, double now) const {
  const auto sends = [&](const Sender& sender) { return now - sender.heard <= ends_; };
  const auto own = std::find_if(senders_.begin(), senders_.end(),
                                [&](const Sender& sender) { return sender.from == from; });
  if (own == senders_.end() || !sends(*own)) return true;
  return std::none_of(senders_.begin(), senders_.end(), [&](const Sender& other) {
    return sends(other) && other.began > own->began;
  });
}

std::optional<protocol::Endpoint> PoseSenders::hear(const protocol::Endpoint& from, double now) {
  std::erase_if(senders_, [now](const Sender& sender) { return now - sender.heard > kRemembered; });
  const auto own = std::find_if(senders_.begin(), senders_.end(),
                                [&](const Sender& sender) { return sender.from == from; });
  if (own == senders_.end()) {
    if (senders_.size() == kMost) {
      senders_.erase(
          std::min_element(senders_.begin(), senders_.end(),
                           [](const Sender& a, const Sender& b) { return a.heard < b.heard; }));
    }
    senders_.push_back({from, now, now});
    return std::nullopt;
  }
  if (now - own->heard > ends_) own->began = now;
  own->heard = now;
  const bool is_told = followed_ == from || own->told == followed_ || now < next_line_;
  if (!followed_ || is_told) return std::nullopt;
  own->told = followed_;
  next_line_ = now + kLinePeriod;
  return followed_;
}

double PoseSenders::heard() const {
  double last = -std::numeric_limits<double>::infinity();
  for (const Sender& sender : senders_) last = std::max(last, sender.heard);
  return last;
}

void PoseSenders::forget(const protocol::Endpoint& from) {
  std::erase_if(senders_, [&](const Sender& sender) { return sender.from == from; });
}

PoseRefusal PoseIntake::give(std::int32_t body, const Vector3& position, const Quaternion& rotation,
                             const PoseMoment& moment) {
  const auto index = static_cast<std::size_t>(body);
  if (index >= senders_.size()) return PoseRefusal::no_body;
  PosedMotion* const live = simulation_.live_body(body);
  if (live == nullptr) return PoseRefusal::not_tracked;
  PoseSenders& senders = senders_[index];
  const bool moves = senders.lets(moment.from, moment.arrival);
  PoseRefusal refusal =
      senders.is_followed() ? PoseRefusal::other_sender : PoseRefusal::not_tracked;
  if (moves) refusal = live->push(position, rotation, stamp_of(moment));
  if (moves && refusal == PoseRefusal::too_far) say_far(body, position, moment.arrival);
  if (moves && is_no_pose(refusal)) return refusal;
  if (const auto rival = senders.hear(moment.from, moment.arrival)) {
    const std::string name = name_of(simulation_.scene(), body);
    say_both({"poses of body " + name, name, "lets go or is silent for 0.5 s",
              "let it move another body"},
             moves ? *rival : moment.from, moves ? moment.from : *rival);
  }
  if (moves) {
    const bool follows = refusal != PoseRefusal::not_tracked;
    senders.follow(follows ? std::optional(moment.from) : std::nullopt);
    if (follows) say_far(body, position, moment.arrival);
  }
  return refusal;
}

void PoseIntake::take(const protocol::BodyPose& pose, const PoseMoment& moment) {
  const Vector3 position = {as_double(pose.position.x), as_double(pose.position.y),
                            as_double(pose.position.z)};
  const Quaternion rotation = {as_double(pose.qx), as_double(pose.qy), as_double(pose.qz),
                               as_double(pose.qw)};
  note(pose.body, give(pose.body, position, rotation, moment), moment.arrival);
}

std::string PoseIntake::grab(std::int32_t body, bool on, const protocol::Endpoint& from) {
  const auto index = static_cast<std::size_t>(body);
  if (index >= senders_.size()) {
    return "the scene has " + std::to_string(senders_.size()) + " bodies, from 0";
  }
  PosedMotion* const live = simulation_.live_body(body);
  if (live == nullptr) return "the water moves this body";
  live->grab(on);
  senders_[index].forget(from);
  return {};
}

void PoseIntake::stand(const FloorTouch& touch, double arrival) const {
  auto* const foot =
      dynamic_cast<FloorMotion*>(simulation_.live_body(static_cast<std::int32_t>(touch.body)));
  if (foot == nullptr) return;
  if (touch.down) {
    foot->touch(touch.place, touch.rotation, arrival);
  } else {
    foot->lift(arrival);
  }
}

bool PoseIntake::follows(PoseSenders& senders, const PoseMoment& moment,
                         const std::function<void(const protocol::Endpoint& waits,
                                                  const protocol::Endpoint& moves)>& tell) {
  const bool moves = senders.lets(moment.from, moment.arrival);
  if (const auto rival = senders.hear(moment.from, moment.arrival)) {
    tell(moves ? *rival : moment.from, moves ? moment.from : *rival);
  }
  if (moves) senders.follow(moment.from);
  if (!moves) ++counts_[static_cast<std::size_t>(PoseRefusal::other_sender)];
  return moves;
}

bool PoseIntake::follows_source(const std::string& address, const std::string& source,
                                const PoseMoment& moment) {
  const std::pair key = {address, source};
  if (!source_senders_.contains(key)) {
    std::erase_if(source_senders_,
                  [&](const auto& entry) { return entry.second.are_silent(moment.arrival); });
    if (source_senders_.size() == kMostSources) {
      source_senders_.erase(std::min_element(
          source_senders_.begin(), source_senders_.end(),
          [](const auto& a, const auto& b) { return a.second.heard() < b.second.heard(); }));
    }
  }
  PoseSenders& senders = source_senders_.try_emplace(key, kFloorEnds).first->second;
  return follows(senders, moment, [&](const auto& waits, const auto& moves) {
    say_both({"TUIO's " + address + " as source '" + source + "'", "TUIO", "is silent for 3 s",
              "give it another source name"},
             waits, moves);
  });
}

bool PoseIntake::follows_tiles(std::int32_t first, const PoseMoment& moment) {
  PoseSenders& senders = tile_senders_.try_emplace(first, kFloorEnds).first->second;
  return follows(senders, moment, [&](const auto& waits, const auto& moves) {
    if (moment.arrival < next_tiles_line_) return;  // that of another sensor said it
    next_tiles_line_ = moment.arrival + kLinePeriod;
    say_both({"the floor's sensor " + std::to_string(first), "the floor", "is silent for 3 s",
              "let it send other sensors"},
             waits, moves);
  });
}

bool PoseIntake::track(const protocol::Message& message, const PoseMoment& moment) {
  const GiveTouch touch = [&](const FloorTouch& told) { stand(told, moment.arrival); };
  const LetSource lets_source = [&](const std::string& address, const std::string& source) {
    return follows_source(address, source, moment);
  };
  const LetTiles lets_tiles = [&](std::int32_t first) { return follows_tiles(first, moment); };
  const bool of_floor = surfaces_.take(message, moment.arrival, touch, lets_source) ||
                        floor_.take(message, touch, lets_tiles);
  if (of_floor) return true;
  const bool taken = trackers_.take(message, stamp_of(moment), [&](const MappedPose& pose) {
    const auto body = static_cast<std::int32_t>(pose.body);
    const bool is_pose = pose.refusal == PoseRefusal::none;
    note(body, is_pose ? give(body, pose.position, pose.rotation, moment) : pose.refusal,
         moment.arrival);
  });
  return taken || trackers_.is_of_sender(message.address);
}

void PoseIntake::note(std::int32_t body, PoseRefusal refusal, double now) {
  if (refusal == PoseRefusal::none) return;
  ++counts_[static_cast<std::size_t>(refusal)];
  if (refusal != PoseRefusal::other_sender) say(body, refusal, now);  // for that: say_both
}

void PoseIntake::say(std::int32_t body, PoseRefusal refusal, double now) {
  const bool for_good = refusal == PoseRefusal::no_body || refusal == PoseRefusal::not_tracked;
  if (for_good) {
    const auto index = static_cast<std::size_t>(body);
    if (reported_[index]) return;
    reported_[index] = true;
  } else if (now < next_line_) {
    return;
  } else {
    next_line_ = now + kLinePeriod;
  }
  const std::string name = name_of(simulation_.scene(), body);
  const std::string reason(describe(refusal));
  std::fprintf(stderr, "sim-server: a pose of body %s was refused: %s (%llu refused so far)\n",
               name.c_str(), reason.c_str(), static_cast<unsigned long long>(refused()));
  if (tell_) tell_(name + ": " + reason);
}

void PoseIntake::say_far(std::int32_t body, const Vector3& place, double now) {
  const auto index = static_cast<std::size_t>(body);
  const auto far = far_off(simulation_.scene().tank, place);
  if (!far || far_[index] || now < next_far_line_) {
    far_[index] = far_[index] && far;
    return;
  }
  far_[index] = true;
  next_far_line_ = now + kLinePeriod;
  const std::string name = name_of(simulation_.scene(), body);
  std::fprintf(stderr, "sim-server: poses put body %s at %s, %s. %s\n", name.c_str(),
               in_metres(place).c_str(), far->c_str(), kWhatPosesAre);
  if (tell_) tell_(name + " is " + *far + ": metres? z up?");
}

void PoseIntake::say_both(const Shared& shared, const protocol::Endpoint& waits,
                          const protocol::Endpoint& moves) const {
  const std::string first = to_string(waits);
  const std::string last = to_string(moves);
  std::fprintf(stderr,
               "sim-server: %s and %s both send %s: it follows %s, which began last, until that "
               "%s. Stop one of them, or %s.\n",
               first.c_str(), last.c_str(), shared.what.c_str(), last.c_str(), shared.until.c_str(),
               shared.remedy.c_str());
  // A reason is cut behind 64 characters, which both addresses have to come before.
  if (tell_) tell_(first + " yields to " + last + " on " + shared.name);
}

std::uint64_t PoseIntake::refused() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& count : counts_) sum += count;
  return sum;
}

NamedCounts PoseIntake::refusals(const ControlCounts& wire) const {
  NamedCounts named;
  for (std::size_t i = 1; i < kPoseRefusals; ++i) {
    const auto reason = static_cast<PoseRefusal>(i);
    std::uint64_t count = counts_[i];
    if (reason == PoseRefusal::malformed) count += wire.malformed_poses;
    if (reason == PoseRefusal::no_rotation) count += wire.no_rotations;
    named.emplace_back(std::string(key_of(reason)), count);
  }
  return named;
}

}  // namespace splash::sim
