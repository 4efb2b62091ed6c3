// SPDX-License-Identifier: MIT
#include "sim-server/detect/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim-server/detect/added_mass.hpp"
#include "sim-server/detect/cavity_laws.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

constexpr double kGravity = 9.81;  // [m/s2]

/// Points this near to the first one look at the same water: what they see of it is averaged
/// [spacings].
constexpr double kTogether = 0.5;

/// Water in a direction this much upward lies on the body: vertical part of the unit vector.
constexpr double kLyingOn = 0.3;

/// Skin that is dry for this long is out of the water, wherever it is [s].
constexpr double kClearFor = 0.5;

/// Least part of the body's own speed at which the surfaces must close: water that flees from it or
/// moves with it is not hit; and least part of the closing speed that must be the body's own, or it
/// is the water that comes [1].
constexpr double kShareOfOwn = 0.5;
constexpr double kOwnShare = 0.3;

/// A blow goes on while skin gets wet, with pauses of up to this, or of what it takes to go in by a
/// spacing [s]. What follows within it is a blow of its own only if it is so many times heavier
/// [1].
constexpr double kPause = 0.020;
constexpr double kHeavier = 4.0;

/// Least part of its largest face that must get wet at once, and the speed at which that face would
/// give the water as much momentum [1], [m/s].
constexpr double kLeastFace = 0.05;
constexpr double kLeastSpeed = 0.003;

/// Skin that looks at the water by less than this passes along it: cosine.
constexpr double kFacing = 0.5;

/// Less matter behind the surface is a drop or a sheet [1].
constexpr float kBacked = 0.25F;

/// The wetting is looked at in steps of this part of the time R / u in which a face of the radius R
/// goes in [1].
constexpr double kStep = 0.1;

/// Air cushions the blow of a flat face for about this long [s].
constexpr double kCushion = 0.001;

/// Unit vector into the water under all of the chosen points: that of their summed gradients.
Vector3 mean_inward(const std::vector<SurfacePoint>& points,
                    const std::vector<std::size_t>& chosen) {
  Touch sum = {};
  for (const std::size_t i : chosen) {
    sum.gx += points[i].touch.gx;
    sum.gy += points[i].touch.gy;
    sum.gz += points[i].touch.gz;
  }
  return into_water(sum);
}

}  // namespace

/// The dry skin of a body that is next to meet the water, on average, and what comes of it.
struct ImpactWatch::Meeting {
  double gap = kNever;                 ///< of the very nearest [m]
  double after = kNever;               ///< time until the skin gets wet [s]
  double later = 0.0;                  ///< the surfaces meet after that [s]
  double approach = 0.0;               ///< speed of a level plate that would press as much [m/s]
  double own = 0.0;                    ///< the body's part of it [m/s]
  Vector3 water = {0.0, 0.0, 0.0};     ///< velocity of the water [m/s]
  double flow = 0.0;                   ///< its part along `inward` [m/s]
  double speed = 0.0;                  ///< [m/s]
  double surface = 0.0;                ///< how far along `inward` the water begins [m]
  Vector3 velocity = {0.0, 0.0, 0.0};  ///< of the foremost point [m/s]
  Vector3 position = {0.0, 0.0, 0.0};
  Vector3 inward = {0.0, 0.0, -1.0};
  std::vector<std::size_t> points;
  double area = 0.0;              ///< that gets wet until the blow is strongest [m2]
  double momentum = 0.0;          ///< given to the water until then [N s]
  double rise = kCushion;         ///< that is so long after the first touch [s]
  double area_at_once = 0.0;      ///< [m2]
  double momentum_at_once = 0.0;  ///< [N s]
  double most_at_once = 0.0;      ///< that, if all of it pressed as what meets first [N s]
};

ImpactWatch::ImpactWatch(std::vector<double> faces, const DetectSettings& settings,
                         const SurfaceDistance& distance, double nearer)
    : faces_(std::move(faces)),
      distance_(distance),
      nearer_(nearer),
      faintest_(distance.colour_at(kSpacingsSeen * distance.spacing())),
      blows_(faces_.size()) {
  for (const double face : faces_) {
    closing_.push_back(closing_time(std::sqrt(face / std::numbers::pi), kGravity));
  }
  set(settings);
}

void ImpactWatch::set(const DetectSettings& settings) {
  settings_ = settings;
  touching_ = std::min(kSurfaceRoughness * distance_.spacing(), settings.impact_release / 2.0);
}

void ImpactWatch::forget() {
  skin_.clear();
  std::fill(blows_.begin(), blows_.end(), Blow{});
}

std::vector<double> ImpactWatch::gaps_of(const std::vector<SurfacePoint>& points) const {
  std::vector<double> gaps;
  gaps.reserve(points.size());
  for (const SurfacePoint& point : points) gaps.push_back(gap_for(point.touch.colour));
  return gaps;
}

double ImpactWatch::gap_for(float colour) const {
  const double seen = static_cast<double>(colour);
  return seen < faintest_ ? kNever : distance_.distance_for(seen);
}

/// Thin water beside skin is water all the same where there is matter behind it: such is the wake
/// of a body that moves on. Around a body in the air it is spray, or a film.
bool ImpactWatch::is_dry(const Touch& touch, double gap) const {
  if (gap <= settings_.impact_release) return false;
  return touch.ahead < kBacked || gap_for(touch.all_colour) > settings_.impact_release;
}

/// Dry skin that goes towards the water; what lies on a body is carried, not hit.
bool ImpactWatch::may_meet(std::size_t i, const SurfacePoint& point) const {
  const Vector3 inward = into_water(point.touch);
  if (point.touch.ahead < kBacked) return false;
  if (skin_[i].wet || !skin_[i].withdrawn || inward[2] >= kLyingOn) return false;
  if (dot(normal_of(point.touch), inward) <= kFacing) return false;
  const Vector3 way = way_of(point.touch);
  return dot(way, inward) > 0.0 && dot(way, normal_of(point.touch)) >=
                                       settings_.impact_speed * dot(normal_of(point.touch), inward);
}

/// Towards the water: of a wave it is the way past each other that counts, else the body's own.
Vector3 ImpactWatch::way_of(const Touch& touch) const {
  const Vector3 way = velocity_of(touch);
  return settings_.impact_waves ? way - water_velocity_of(touch) : way;
}

ImpactWatch::Meeting ImpactWatch::next_meeting(int body, const std::vector<SurfacePoint>& points,
                                               const std::vector<double>& gaps) const {
  Meeting meeting;
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].body != body || gaps[i] == kNever || !may_meet(i, points[i])) continue;
    candidates.push_back(i);
    meeting.gap = std::min(meeting.gap, gaps[i]);
  }
  for (const std::size_t i : candidates) {
    if (gaps[i] <= meeting.gap + kTogether * distance_.spacing()) meeting.points.push_back(i);
  }
  if (meeting.points.empty()) return meeting;
  average(meeting, points, gaps);
  // The body's own speed alone: the surface breathes and gives way, and comes back. Only a wave
  // comes by itself.
  const double sinking = dot(meeting.velocity, meeting.inward);
  const double nears = settings_.impact_waves ? sinking - meeting.flow : sinking;
  if (nears > 0.0) {
    meeting.after = meeting.gap / nears;
    meeting.later = nearer_ / nears;
  }
  return meeting;
}

void ImpactWatch::average(Meeting& meeting, const std::vector<SurfacePoint>& points,
                          const std::vector<double>& gaps) {
  // The water is rough, the body is not: its points agree on one surface, as high along one
  // direction as they see it on average, and the foremost of them meets it first. A plate presses
  // on the water along its normal alone.
  meeting.inward = mean_inward(points, meeting.points);
  const double share = 1.0 / static_cast<double>(meeting.points.size());
  double facing = 0.0;
  double pressing = 0.0;
  double foremost = -kNever;
  std::size_t leader = meeting.points.front();
  for (const std::size_t i : meeting.points) {
    const Touch& touch = points[i].touch;
    const double along = dot(position_of(touch), meeting.inward);
    meeting.surface += share * (along + gaps[i]);
    meeting.water = meeting.water + share * water_velocity_of(touch);
    facing += std::max(dot(normal_of(touch), meeting.inward), kFacing);
    pressing += dot(velocity_of(touch), normal_of(touch));
    meeting.approach += dot(velocity_of(touch) - water_velocity_of(touch), normal_of(touch));
    if (along > foremost) {
      foremost = along;
      leader = i;
    }
  }
  meeting.velocity = velocity_of(points[leader].touch);
  meeting.gap = meeting.surface - foremost;
  meeting.flow = dot(meeting.water, meeting.inward);
  meeting.own = pressing / facing;
  meeting.approach /= facing;
  meeting.speed = length(meeting.velocity);
  meeting.position = position_of(points[leader].touch);
}

/// What gets wet as the body goes on, and the momentum that this gives to the water.
void ImpactWatch::weigh(Meeting& meeting, const std::vector<SurfacePoint>& points) const {
  const int body = points[meeting.points.front()].body;
  const double face = faces_[static_cast<std::size_t>(body)];
  const double step = kStep * std::sqrt(face / std::numbers::pi) / meeting.approach;
  // Skin that is too far away to see what is behind the surface relies on what the nearest sees.
  const double reach = reach_of_blow(face);
  double backing = 0.0;
  for (const std::size_t i : meeting.points) {
    backing += static_cast<double>(points[i].touch.ahead);
  }
  backing /= static_cast<double>(meeting.points.size());
  const double sinking = dot(meeting.velocity, meeting.inward) - meeting.flow;
  const double first = sinking > 0.0 ? std::max(meeting.gap, 0.0) / sinking : 0.0;
  std::vector<Wetting> wettings;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Touch& touch = points[i].touch;
    if (points[i].body != body || skin_[i].wet || !skin_[i].withdrawn) continue;
    const double facing = dot(normal_of(touch), meeting.inward);
    const double speed = dot(velocity_of(touch), meeting.inward) - meeting.flow;
    // Skin that goes back along its normal, like a sole drawn through the water with its toe down,
    // leaves a hollow behind itself, however fast it sinks.
    if (facing <= kFacing || speed <= 0.0 || dot(way_of(touch), normal_of(touch)) <= 0.0) continue;
    const Vector3 place = position_of(touch);
    const double depth = dot(place, meeting.inward) - meeting.surface;
    const double pressing = dot(velocity_of(touch) - meeting.water, normal_of(touch)) / facing;
    wettings.push_back({std::max(-depth / speed - first, 0.0), facing * points[i].area,
                        -depth > reach / 2.0 ? backing : static_cast<double>(touch.ahead),
                        std::max(pressing, 0.0), place});
  }
  const Growth growth = growth_of(std::move(wettings), step);
  meeting.area_at_once = growth.area_at_once;
  meeting.momentum_at_once = growth.momentum_at_once;
  meeting.most_at_once = meeting.approach * growth.mass_at_once;
  meeting.momentum = growth.momentum;
  meeting.area = growth.area;
  meeting.rise = std::max(growth.rise, kCushion);
}

/// Water that a body carries along or that flees from it is not hit; nor does water that comes to a
/// body at rest make an impact, unless the scene wants it and it comes as a wave.
bool ImpactWatch::is_fast(const Meeting& meeting) const {
  if (meeting.own >= settings_.impact_speed &&
      meeting.approach >= std::max(kShareOfOwn * meeting.own, settings_.impact_speed / 2.0) &&
      meeting.own >= kOwnShare * meeting.approach) {
    return true;
  }
  // Slower, the water rises by its weight, and by no more than its surface is rough.
  const double wave = std::sqrt(2.0 * kGravity * kSurfaceRoughness * distance_.spacing());
  return settings_.impact_waves && meeting.approach >= std::max(wave, settings_.impact_speed);
}

/// Whether it may have the weight of one: what follows the first skin turns by then, faster or
/// slower.
bool ImpactWatch::is_blow(const Meeting& meeting, int body) const {
  const double face = faces_[static_cast<std::size_t>(body)];
  return meeting.area_at_once >= kLeastFace * face &&
         meeting.most_at_once >= kLeastSpeed * added_mass(face, 1.0);
}

void ImpactWatch::meet(int body, double time, double frame, const std::vector<SurfacePoint>& points,
                       const std::vector<double>& gaps) {
  Meeting meeting = next_meeting(body, points, gaps);
  if (meeting.points.empty() || meeting.after == kNever || !is_fast(meeting)) return;
  // Touching water gives way to a slow body: when they would have met is known best before.
  const bool touches = meeting.gap <= kSurfaceRoughness * distance_.spacing();
  if (!touches && meeting.after > settings_.impact_lookahead) return;
  weigh(meeting, points);
  Blow& blow = blows_[static_cast<std::size_t>(body)];
  const double touched = time + std::max(meeting.after, -frame);
  // One that goes on is the same, unless what follows is a heavier one.
  const bool goes_on = touched <= blow.lasts_until + blow.pause;
  const bool heavier =
      touched >= blow.touched + kAtOnce && meeting.momentum_at_once >= kHeavier * blow.momentum;
  if ((goes_on && !heavier) || !is_blow(meeting, body)) return;
  blow.touched = blow.lasts_until = touched;
  blow.momentum = meeting.momentum;
  // A wave passes all of the body.
  const double passes = settings_.impact_waves
                            ? std::sqrt(faces_[static_cast<std::size_t>(body)] / std::numbers::pi)
                            : distance_.spacing();
  blow.pause = std::max(kPause, passes / meeting.approach);
  blow.surface = meeting.surface;
  blow.water = {0.0, 0.0, 0.0};
  for (const std::size_t i : meeting.points) {
    blow.water = blow.water + 1.0 / static_cast<double>(meeting.points.size()) * skin_[i].water;
  }
  blow.inward = meeting.inward;
  DetectedImpact impact;
  impact.time = touched + meeting.later;
  impact.body = body;
  impact.speed = meeting.speed;
  impact.approach = dot(meeting.velocity, meeting.inward) - meeting.flow;
  impact.momentum = meeting.momentum;
  impact.rise = meeting.rise;
  impact.area = meeting.area;
  impact.position = meeting.position + (impact.time - time) * meeting.velocity;
  blow.due = impact;
}

void ImpactWatch::note_wetness(double time, double frame, const std::vector<SurfacePoint>& points,
                               const std::vector<double>& gaps) {
  std::vector<bool> wetted(faces_.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Skin& skin = skin_[i];
    const Touch& touch = points[i].touch;
    const double speed = dot(velocity_of(touch), normal_of(touch));
    skin.way += frame * speed;
    skin.deepest = std::max(skin.deepest, skin.way);
    // What passes the water's surface while a blow goes on is part of it, even where the water is
    // pushed away.
    const auto body = static_cast<std::size_t>(points[i].body);
    const Blow& blow = blows_[body];
    const bool below = time >= blow.touched && dot(position_of(touch), blow.inward) >= blow.surface;
    const bool goes_in = below && time <= blow.lasts_until + blow.pause;
    const bool in_hollow = below && time <= blow.touched + closing_[body];
    const bool could_enter = skin.withdrawn;
    if (!goes_in && is_dry(touch, gaps[i])) {
      skin.dry_for += frame;
      skin.withdrawn = skin.withdrawn || (skin.wet && !skin.in_water);
      skin.wet = skin.in_water = false;
      // In the hollow that it opens skin is dry and yet in the water: it must also have gone back,
      // or the water must be long gone.
      skin.withdrawn = skin.withdrawn || skin.dry_for > kClearFor ||
                       skin.deepest - skin.way >= settings_.impact_release;
      // When water comes into sight it has not begun to give way, nor has it while skin does not
      // approach it. Drops are seen before it and have speeds of their own.
      if (!skin.sees || speed < settings_.impact_speed) skin.water = water_velocity_of(touch);
      skin.sees = gaps[i] != kNever && touch.ahead >= kBacked;
      if (skin.withdrawn && !in_hollow) skin.entry.reset();
    } else if (goes_in || gaps[i] <= touching_) {
      if (!skin.wet && skin.withdrawn && speed >= settings_.impact_speed) {
        wetted[body] = true;
      }
      if (!skin.wet) skin.way = skin.deepest = 0.0;
      skin.wet = true;
      skin.in_water = skin.in_water || touch.ahead >= kBacked;
      skin.withdrawn = false;
      skin.dry_for = 0.0;
    }
    if (!skin.entry && could_enter && (in_hollow || skin.wet)) {
      const bool just_now = blow.touched > time - frame && blow.touched <= time;
      // The part of the body that met the water first saw it before the body moved it.
      const bool follows = time <= blow.touched + closing_[body];
      skin.entry =
          Entry{just_now ? blow.touched : time - 0.5 * frame, follows ? blow.water : skin.water};
    }
    if (skin.entry) skin.entry->way = 0.5 * (skin.velocity + velocity_of(touch));
    skin.velocity = velocity_of(touch);
  }
  for (std::size_t b = 0; b < blows_.size(); ++b) {
    const bool goes_on = time <= blows_[b].lasts_until + blows_[b].pause;
    if (goes_on && wetted[b]) {
      blows_[b].lasts_until = std::max(blows_[b].lasts_until, time);
    }
  }
}

std::vector<DetectedImpact> ImpactWatch::observe(double time, double frame,
                                                 const std::vector<SurfacePoint>& points) {
  const std::vector<double> gaps = gaps_of(points);
  std::vector<DetectedImpact> impacts;
  if (skin_.size() != points.size()) {
    skin_.assign(points.size(), {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      skin_[i].wet = !is_dry(points[i].touch, gaps[i]);
      skin_[i].withdrawn = !skin_[i].wet;
    }
    return impacts;
  }
  for (std::size_t b = 0; b < blows_.size(); ++b) {
    meet(static_cast<int>(b), time, frame, points, gaps);
    std::optional<DetectedImpact>& due = blows_[b].due;
    if (due && blows_[b].touched <= time + settings_.impact_lookahead) {
      impacts.push_back(*due);
      due.reset();
    }
  }
  note_wetness(time, frame, points, gaps);
  return impacts;
}

}  // namespace splash::sim
