// SPDX-License-Identifier: MIT
#include "sim-server/detect/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splash::sim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Points this near to the first one look at the same water: what they see of it is averaged
/// [spacings].
constexpr double kTogether = 0.5;

/// Water in a direction this much upward lies on the body: vertical part of the unit vector.
constexpr double kLyingOn = 0.3;

/// The particle surface is this rough: nearer, body and water touch [spacings].
constexpr double kTouching = 0.1;

/// Farther from the surface than this, the colour is too faint to tell how far [spacings].
constexpr double kSpacingsSeen = 1.2;

/// Part that must have left the water [1] of the points that met it, and of all: threads and drops
/// may hang on the rest.
constexpr double kShareOut = 0.75;

/// A body that is clear of the water for this long is out of it, wherever it is [s].
constexpr double kClearFor = 0.5;

/// A body that comes down by less than this part of its speed slides on the water [1].
constexpr double kSkimming = 0.1;

/// Least part of a body's own speed at which the surfaces must close [1].
constexpr double kShareOfOwn = 0.5;

/// A body that moves into the water slower than this is at rest: water comes to it [m/s].
constexpr double kEasing = 0.01;

double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Unit vector into the water.
Vector3 into_water(const Touch& touch) {
  const Vector3 g = {static_cast<double>(touch.gx), static_cast<double>(touch.gy),
                     static_cast<double>(touch.gz)};
  const double size = std::sqrt(dot(g, g));
  if (size <= 0.0) return {0.0, 0.0, -1.0};
  return {g[0] / size, g[1] / size, g[2] / size};
}

Vector3 velocity_of(const Touch& touch) {
  return {static_cast<double>(touch.u), static_cast<double>(touch.v), static_cast<double>(touch.w)};
}

Vector3 water_velocity_of(const Touch& touch) {
  return {static_cast<double>(touch.water_u), static_cast<double>(touch.water_v),
          static_cast<double>(touch.water_w)};
}

Vector3 position_of(const Touch& touch) {
  return {static_cast<double>(touch.x), static_cast<double>(touch.y), static_cast<double>(touch.z)};
}

Vector3 mean_position(const std::vector<SurfacePoint>& points,
                      const std::vector<std::size_t>& chosen) {
  Vector3 mean = {0.0, 0.0, 0.0};
  for (const std::size_t i : chosen) {
    const Vector3 position = position_of(points[i].touch);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mean[axis] += position[axis] / static_cast<double>(chosen.size());
    }
  }
  return mean;
}

Vector3 moved(const Vector3& place, const Vector3& velocity, double seconds) {
  return {place[0] + seconds * velocity[0], place[1] + seconds * velocity[1],
          place[2] + seconds * velocity[2]};
}

/// Unit vector into the water under all of the chosen points: that of their summed gradients.
Vector3 mean_inward(const std::vector<SurfacePoint>& points,
                    const std::vector<std::size_t>& chosen) {
  Touch sum;
  for (const std::size_t i : chosen) {
    sum.gx += points[i].touch.gx;
    sum.gy += points[i].touch.gy;
    sum.gz += points[i].touch.gz;
  }
  return into_water(sum);
}

}  // namespace

/// The dry points of a body that are next to meet the water, on average.
struct ImpactWatch::Meeting {
  double gap = kNever;                 ///< of the very nearest [m]
  double after = kNever;               ///< time until the surfaces meet [s]
  double approach = 0.0;               ///< of the surfaces to each other [m/s]
  double own = 0.0;                    ///< the body's part of it [m/s]
  double speed = 0.0;                  ///< [m/s]
  Vector3 velocity = {0.0, 0.0, 0.0};  ///< of the foremost point [m/s]
  Vector3 position = {0.0, 0.0, 0.0};
  Vector3 inward = {0.0, 0.0, -1.0};
  std::vector<std::size_t> points;
};

ImpactWatch::ImpactWatch(std::size_t bodies, const DetectSettings& settings,
                         const SurfaceDistance& distance)
    : settings_(settings), distance_(distance), locks_(bodies) {}

std::vector<double> ImpactWatch::gaps_of(const std::vector<SurfacePoint>& points) const {
  const double faintest = distance_.colour_at(kSpacingsSeen * distance_.spacing());
  std::vector<double> gaps;
  gaps.reserve(points.size());
  for (const SurfacePoint& point : points) {
    const double colour = static_cast<double>(point.touch.colour);
    gaps.push_back(colour < faintest ? kNever : distance_.distance_for(colour));
  }
  return gaps;
}

ImpactWatch::Meeting ImpactWatch::next_meeting(int body, const std::vector<SurfacePoint>& points,
                                               const std::vector<double>& gaps) const {
  Meeting meeting;
  // Water that lies on a body is carried, not hit.
  const auto is_candidate = [&](std::size_t i) {
    return points[i].body == body && !wet_[i] && into_water(points[i].touch)[2] < kLyingOn;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_candidate(i)) meeting.gap = std::min(meeting.gap, gaps[i]);
  }
  if (meeting.gap == kNever) return meeting;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_candidate(i) && gaps[i] <= meeting.gap + kTogether * distance_.spacing()) {
      meeting.points.push_back(i);
    }
  }
  average(meeting, points, gaps);
  return meeting;
}

void ImpactWatch::average(Meeting& meeting, const std::vector<SurfacePoint>& points,
                          const std::vector<double>& gaps) {
  // The water is rough, the body is not: its points agree on one surface, as high along one
  // direction as they see it on average, and the foremost of them meets it first.
  meeting.inward = mean_inward(points, meeting.points);
  const double share = 1.0 / static_cast<double>(meeting.points.size());
  double surface = 0.0;
  double water = 0.0;
  double foremost = -kNever;
  std::size_t leader = meeting.points.front();
  for (const std::size_t i : meeting.points) {
    const double along = dot(position_of(points[i].touch), meeting.inward);
    surface += share * (along + gaps[i]);
    water += share * dot(water_velocity_of(points[i].touch), meeting.inward);
    if (along > foremost) {
      foremost = along;
      leader = i;
    }
  }
  const Vector3 velocity = velocity_of(points[leader].touch);
  meeting.gap = surface - foremost;
  meeting.own = dot(velocity, meeting.inward);
  meeting.approach = meeting.own - water;
  meeting.velocity = velocity;
  meeting.speed = std::sqrt(dot(velocity, velocity));
  meeting.position = position_of(points[leader].touch);
  // The body's own speed alone: the surface breathes and gives way, and comes back.
  if (meeting.own > 0.0) meeting.after = meeting.gap / meeting.own;
}

void ImpactWatch::note_who_is_in(double time, const std::vector<SurfacePoint>& points,
                                 const std::vector<double>& gaps) {
  wet_.assign(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (gaps[i] > settings_.impact_release) continue;
    wet_[i] = true;
    Lock& lock = locks_[static_cast<std::size_t>(points[i].body)];
    lock.closed = true;
    lock.since = lock.wet_at = time;
    lock.leading.push_back(i);
  }
  for (Lock& lock : locks_) lock.entry = mean_position(points, lock.leading);
}

bool ImpactWatch::has_come_out(std::size_t body, const std::vector<SurfacePoint>& points,
                               const std::vector<double>& gaps, double time) {
  Lock& lock = locks_[body];
  const auto is_out = [&](std::size_t i) { return gaps[i] > settings_.impact_release; };
  const auto enough = [](auto part, auto whole) {
    return static_cast<double>(part) >= kShareOut * static_cast<double>(whole);
  };
  const auto leading_out = std::count_if(lock.leading.begin(), lock.leading.end(), is_out);
  if (!enough(leading_out, lock.leading.size())) {
    lock.wet_at = time;
    return false;
  }
  // In the cavity that it opens, or on the film under its sole, a body is clear of the water and
  // yet in it: it must also have come back to where it entered.
  const Vector3 now = mean_position(points, lock.leading);
  const Vector3 way = {now[0] - lock.entry[0], now[1] - lock.entry[1], now[2] - lock.entry[2]};
  if (dot(way, lock.inward) < -settings_.impact_release) return true;
  // The water may have sunk instead; then all of the body stays clear.
  std::size_t all = 0;
  std::size_t all_out = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].body != static_cast<int>(body)) continue;
    ++all;
    if (is_out(i)) ++all_out;
  }
  if (!enough(all_out, all)) lock.wet_at = time;
  return time - lock.wet_at > kClearFor;
}

void ImpactWatch::open_locks(double time, const std::vector<SurfacePoint>& points,
                             const std::vector<double>& gaps) {
  for (std::size_t b = 0; b < locks_.size(); ++b) {
    if (!locks_[b].closed || time <= locks_[b].since) continue;
    locks_[b].closed = !has_come_out(b, points, gaps, time);
  }
}

void ImpactWatch::note_wetness(const std::vector<double>& gaps) {
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i] <= 0.0) wet_[i] = true;
    if (gaps[i] > settings_.impact_release) wet_[i] = false;
  }
}

/// Water that a body carries along or that flees from it is not hit, nor what it skims.
bool ImpactWatch::is_fast(const Meeting& meeting) const {
  return meeting.own >= settings_.impact_speed && meeting.own >= kSkimming * meeting.speed &&
         meeting.approach >= kShareOfOwn * meeting.own;
}

void ImpactWatch::meet(int body, double time, double frame, const std::vector<SurfacePoint>& points,
                       const std::vector<double>& gaps) {
  const Meeting meeting = next_meeting(body, points, gaps);
  // Touching water gives way to a slow body: when they would have met is known best before.
  const bool touches = meeting.gap <= kTouching * distance_.spacing();
  if (!touches && meeting.after > settings_.impact_lookahead) return;
  const bool fast = is_fast(meeting);
  // A body that eases in makes no impact, and none later on while that part of it is in.
  const bool eases =
      meeting.gap <= 0.0 && meeting.own > kEasing && meeting.approach >= kShareOfOwn * meeting.own;
  if (!fast && !eases) return;
  const double wait = std::max(meeting.after, -frame);
  Lock& lock = locks_[static_cast<std::size_t>(body)];
  lock.closed = true;
  lock.since = lock.wet_at = time + std::max(wait, 0.0);
  lock.leading = meeting.points;
  lock.entry = moved(mean_position(points, meeting.points), meeting.velocity, wait);
  lock.inward = meeting.inward;
  lock.due.reset();
  if (fast) {
    lock.due = {time + wait, body, meeting.speed, meeting.approach,
                moved(meeting.position, meeting.velocity, wait)};
  }
}

std::vector<DetectedImpact> ImpactWatch::observe(double time, double frame,
                                                 const std::vector<SurfacePoint>& points) {
  const std::vector<double> gaps = gaps_of(points);
  std::vector<DetectedImpact> impacts;
  if (wet_.size() != points.size()) {
    note_who_is_in(time, points, gaps);
    return impacts;
  }
  open_locks(time, points, gaps);
  for (std::size_t b = 0; b < locks_.size(); ++b) {
    if (!locks_[b].closed) {
      meet(static_cast<int>(b), time, frame, points, gaps);
    }
    std::optional<DetectedImpact>& due = locks_[b].due;
    if (due && due->time <= time + settings_.impact_lookahead) {
      impacts.push_back(*due);
      due.reset();
    }
  }
  note_wetness(gaps);
  return impacts;
}

}  // namespace splash::sim
