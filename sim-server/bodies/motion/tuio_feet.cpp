// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/tuio_feet.hpp"

#include <algorithm>
#include <numbers>

#include "sim-server/bodies/motion/tracker_map.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// A source that says nothing for so long has gone: the feet that were its cursors are free [s].
constexpr double kSilence = 3.0;

}  // namespace

TuioFeet::TuioFeet(const Scene& scene)
    : room_(scene.tracking.position),
      turn_(from_turn({0.0, 0.0, std::numbers::pi / 180.0 * scene.tracking.yaw})) {
  for (const TrackerSource& source : scene.tracking.sources) {
    if (!is_tuio(source.address)) continue;
    const Keyframe& rest = scene.bodies.at(source.body).rest;
    feet_.push_back({source, rest.rotation, rest.position});
  }
}

Vector3 TuioFeet::place_of(const Foot& foot, const TuioCursor& cursor) const {
  const Vector3 theirs = {foot.settings.floor[0] * cursor.x, foot.settings.floor[1] * cursor.y,
                          0.0};
  const auto turned = rotation_of(foot, cursor).value_or(foot.rest);
  return room_ + rotate(turn_, in_scene_axes(foot.settings, theirs)) +
         rotate(turned, foot.settings.mount.position);
}

/// About the surface's normal, which is upwards or, where its axes are mirrored, downwards.
std::optional<Quaternion> TuioFeet::rotation_of(const Foot& foot, const TuioCursor& cursor) const {
  if (!cursor.angle) return std::nullopt;
  const Vector3 x = in_scene_axes(foot.settings, {1.0, 0.0, 0.0});
  const Vector3 y = in_scene_axes(foot.settings, {0.0, 1.0, 0.0});
  const Quaternion turned = from_turn(*cursor.angle * cross(x, y));
  return unit(compose(turn_, compose(turned, foot.rest)));
}

bool TuioFeet::take(const protocol::Message& message, double arrival, const GiveTouch& give,
                    const LetSource& lets) {
  const bool wanted = std::any_of(feet_.begin(), feet_.end(), [&](const Foot& foot) {
    return foot.settings.address == message.address;
  });
  if (!wanted) return false;
  if (const auto frame = reader_.take(message, arrival, lets)) follow(*frame, arrival, give);
  return true;
}

void TuioFeet::follow(const TuioFrame& frame, double arrival, const GiveTouch& give) {
  const auto is_of = [&](const Foot& foot) {
    return foot.cursor && std::get<0>(*foot.cursor) == frame.address &&
           std::get<1>(*foot.cursor) == frame.source;
  };
  for (Foot& foot : feet_) {
    if (!is_of(foot) || frame.cursors.contains(std::get<2>(*foot.cursor))) continue;
    foot.cursor.reset();
    give({.body = foot.settings.body, .down = false});
  }
  for (const auto& [id, cursor] : frame.cursors) {
    const Name name = {frame.address, frame.source, id};
    Foot* its = nullptr;
    double least = 0.0;
    for (Foot& foot : feet_) {
      if (foot.cursor == name) {
        its = &foot;
        break;
      }
      const bool free = !foot.cursor || arrival - foot.heard > kSilence;
      const bool may = free && foot.settings.address == frame.address &&
                       (foot.settings.name.empty() || foot.settings.name == frame.source);
      if (!may) continue;
      Vector3 way = place_of(foot, cursor) - foot.last;
      way[2] = 0.0;
      if (its != nullptr && length(way) >= least) continue;
      its = &foot;
      least = length(way);
    }
    if (its == nullptr) continue;  // more cursors than feet
    its->cursor = name;
    its->heard = arrival;
    its->last = place_of(*its, cursor);
    give({its->settings.body, true, its->last, rotation_of(*its, cursor)});
  }
}

}  // namespace splash::sim
