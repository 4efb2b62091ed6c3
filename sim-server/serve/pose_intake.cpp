// SPDX-License-Identifier: MIT
#include "sim-server/serve/pose_intake.hpp"

#include <cstdio>
#include <string>

#include "sim-server/bodies/motion/floor_motion.hpp"

namespace splash::sim {
namespace {

constexpr double kLinePeriod = 1.0;  ///< between two lines on refused poses [s]

double as_double(float value) {
  return static_cast<double>(value);
}

/// "'hand'", or its number where the scene has no such body.
std::string name_of(const Scene& scene, std::int32_t body) {
  const auto index = static_cast<std::size_t>(body);
  if (index >= scene.bodies.size()) return std::to_string(body);
  return "'" + scene.bodies[index].name + "'";
}

}  // namespace

PoseRefusal PoseIntake::give(const protocol::BodyPose& pose, const PoseMoment& moment) const {
  const auto bodies = simulation_.scene().bodies.size();
  if (static_cast<std::size_t>(pose.body) >= bodies) return PoseRefusal::no_body;
  PosedMotion* body = simulation_.live_body(pose.body);
  if (body == nullptr) return PoseRefusal::not_tracked;
  const Vector3 position = {as_double(pose.position.x), as_double(pose.position.y),
                            as_double(pose.position.z)};
  const Quaternion rotation = {as_double(pose.qx), as_double(pose.qy), as_double(pose.qz),
                               as_double(pose.qw)};
  return body->push(position, rotation, {moment.arrival, moment.sent});
}

void PoseIntake::take(const protocol::BodyPose& pose, const PoseMoment& moment) {
  note(pose.body, give(pose, moment), moment.arrival);
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

bool PoseIntake::track(const protocol::Message& message, const PoseMoment& moment) {
  const GiveTouch touch = [&](const FloorTouch& told) { stand(told, moment.arrival); };
  if (surfaces_.take(message, moment.arrival, touch) || floor_.take(message, touch)) return true;
  const PoseStamp stamp = {moment.arrival, moment.sent};
  const bool taken = trackers_.take(message, stamp, [&](const MappedPose& pose) {
    const auto body = static_cast<std::int32_t>(pose.body);
    PoseRefusal refusal = pose.refusal;
    PosedMotion* const live = simulation_.live_body(body);
    if (refusal == PoseRefusal::none && live != nullptr) {
      refusal = live->push(pose.position, pose.rotation, stamp);
    }
    note(body, refusal, moment.arrival);
  });
  return taken || trackers_.is_of_sender(message.address);
}

void PoseIntake::note(std::int32_t body, PoseRefusal refusal, double now) {
  if (refusal == PoseRefusal::none) return;
  ++counts_[static_cast<std::size_t>(refusal)];
  say(body, refusal, now);
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
  if (tell_) tell_(name, reason);
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
