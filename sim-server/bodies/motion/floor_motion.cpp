// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/floor_motion.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// A touch that is lost for less is the same one [s].
constexpr double kBridges = 0.020;
/// A floor that says nothing for so long is switched off: nobody stands on it [s].
constexpr double kSilence = 3.0;
/// The foot follows its touch with this time constant [s], no faster than a sprinter's [m/s].
constexpr double kFollows = 0.020;
constexpr double kFastest = 12.0;
/// A foot in the air that is touched farther from where it was comes down there [m].
constexpr double kElsewhere = 0.05;
constexpr double kPlace = 100.0;  ///< no coordinate is beyond [m]
/// Of a frame a foot goes on for so many lengths where the next one does not begin.
constexpr double kGoesOn = 2.0;

}  // namespace

FloorMotion::FloorMotion(const Keyframe& stands, const FloorSteps& steps)
    : stands_(stands), steps_(steps) {
  stands_.rotation = unit(stands_.rotation);
  now_.position = stands_.position + Vector3{0.0, 0.0, steps_.hover + steps_.lift};
  now_.rotation = end_ = stands_.rotation;
  touch_.rotation = stands_.rotation;
}

void FloorMotion::touch(const Vector3& place, const std::optional<Quaternion>& rotation,
                        double arrival) {
  const bool sound = std::abs(place[0]) <= kPlace && std::abs(place[1]) <= kPlace;
  if (!sound) return;  // nor is what is no number
  const std::scoped_lock lock(mutex_);
  touch_.down = true;
  touch_.place = place;
  touch_.arrival = arrival;
  if (rotation) touch_.rotation = unit(*rotation);
}

void FloorMotion::lift(double arrival) {
  const std::scoped_lock lock(mutex_);
  if (!touch_.down) return;
  touch_.down = false;
  touch_.lifted = arrival;
}

PoseRefusal FloorMotion::push(const Vector3& /*position*/, const Quaternion& /*rotation*/,
                              const PoseStamp& /*stamp*/) {
  return PoseRefusal::not_tracked;
}

bool FloorMotion::is_down(const Touch& touch, double wall) {
  if (touch.down) return wall - touch.arrival < kSilence;
  return touch.lifted > 0.0 && wall - touch.lifted < kBridges;
}

void FloorMotion::begin(const PlayedFrame& frame) {
  Touch touch;
  {
    const std::scoped_lock lock(mutex_);
    touch = touch_;
  }
  now_ = at(frame.seconds);
  now_.rotation = end_;
  seconds_ = frame.seconds;
  length_ = frame.length;
  const double floor = stands_.position[2];
  const double hover = floor + steps_.hover;
  const bool was_down = down_;
  down_ = is_down(touch, frame.wall);
  Vector3 way = {0.0, 0.0, 0.0};
  if (down_) {
    way = touch.place - now_.position;
    way[2] = 0.0;
    if (!was_down && (now_.position[2] > hover || splash::sim::length(way) > kElsewhere)) {
      now_.position = {touch.place[0], touch.place[1], hover};
      now_.rotation = touch.rotation;
      way = {0.0, 0.0, 0.0};
    }
    const double most = kFastest * frame.length;
    way = (1.0 - std::exp(-frame.length / kFollows)) * way;
    const double far = splash::sim::length(way);
    if (far > most) way = (most / far) * way;
    way[2] = std::max(floor - now_.position[2], -steps_.fall * frame.length);
    end_ = touch.rotation;
  } else {
    way[2] = std::min(hover + steps_.lift - now_.position[2], steps_.rise * frame.length);
    end_ = now_.rotation;
  }
  const double rate = frame.length > 0.0 ? 1.0 / frame.length : 0.0;
  now_.velocity = rate * way;
  now_.spin = rate * to_turn(compose(end_, inverse(now_.rotation)));
}

BodyState FloorMotion::at(double seconds) const {
  BodyState state = now_;
  const double since = std::clamp(seconds - seconds_, 0.0, kGoesOn * length_);
  state.position = now_.position + since * now_.velocity;
  state.rotation = unit(compose(from_turn(since * now_.spin), now_.rotation));
  return state;
}

}  // namespace splash::sim
