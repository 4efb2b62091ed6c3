// SPDX-License-Identifier: MIT
#include "sim-server/detect/cavity_watch.hpp"

#include <algorithm>

#include "sim-server/detect/cavity_laws.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// A body that goes up faster than this part of the speed at which it came comes out [1].
constexpr double kOutward = 0.1;

/// Air at the body is looked for after this part of the time in which its hollow closes [1], so
/// far below the level [R].
constexpr double kLookFrom = 0.5;
constexpr double kBelow = 0.5;

/// A body that goes down less steeply than one in four skims; its hollow takes longer to close than
/// that [of the closing time straight down].
constexpr double kLongest = 2.0;

/// Hollows of a smaller radius are not seen in the water [spacings].
constexpr double kNarrow = 2.0;

/// Cavities of one place within this time are one [s].
constexpr double kOneMoment = 0.050;

Front front_of(const BodyExtent& extent, double time) {
  return {time, extent.front, length(extent.state.velocity), extent.radius};
}

}  // namespace

CavityWatch::CavityWatch(const Scene& scene, const std::vector<SkinPoint>& skin, double volume,
                         bool always)
    : settings_(scene.detect),
      density_(scene.fluid.density),
      gravity_(-scene.fluid.gravity[2]),
      spacing_(particle_spacing(scene)),
      always_(always),
      air_(scene, skin, volume),
      watches_(scene.bodies.size()) {
  for (const BodySettings& body : scene.bodies) parts_.push_back(body.cavity);
}

void CavityWatch::forget() {
  watches_ = std::vector<Watch>(watches_.size());
}

/// A wave's crest is above the level. While a hollow is open, further impacts are of its entry.
void CavityWatch::note(const DetectedImpact& impact) {
  const auto body = static_cast<std::size_t>(impact.body);
  Watch& watch = watches_[body];
  if (watch.hollow || !parts_[body]) return;
  watch.slam = Slam{impact.time, std::min(impact.position[2], air_.level_around(body))};
}

void CavityWatch::follow(std::size_t body, double time) {
  Watch& watch = watches_[body];
  if (!watch.slam) return;
  const BodyExtent& extent = air_.extent(body);
  const Front now = front_of(extent, time);
  const double down = -extent.state.velocity[2];
  const double depth = watch.slam->level - now.place[2];
  const double closes = closing_time(extent.radius, gravity_);
  if (watch.hollow) {
    Hollow& hollow = *watch.hollow;
    hollow.go_on(now);
    const double since = time - hollow.began_at();
    const bool comes_out = depth <= 0.0 || down < -kOutward * hollow.way() / since;
    if (!comes_out && since <= kLongest * closes) return;
    ++none_.stopped;
    watch = {};
  } else if (depth > 0.0 && down > 0.0) {
    Front first = now;
    const double ago = std::min(depth / down, std::max(time - watch.slam->time, 0.0));
    first.time -= ago;
    first.place = first.place - ago * extent.state.velocity;
    watch.hollow.emplace(first, watch.slam->level, gravity_);
    watch.hollow->go_on(now);
  } else if (down <= 0.0 && time > watch.slam->time + closes) {
    ++none_.afloat;
    watch = {};
  }
}

/// Where a body goes far enough at the speed it has.
bool CavityWatch::wants_look(std::size_t body, double time) const {
  const Watch& watch = watches_[body];
  if (!watch.hollow || watch.hollow->way() <= 0.0 || watch.seen) return false;
  const Hollow& hollow = *watch.hollow;
  const BodyExtent& extent = air_.extent(body);
  const double left = hollow.closes_at() - time;
  const double way = hollow.way() + std::max(left, 0.0) * length(extent.state.velocity);
  return left <= (1.0 - kLookFrom) * (hollow.closes_at() - hollow.began_at()) &&
         way > hollow.radius() + extent.thickness;
}

void CavityWatch::close(std::size_t body, std::vector<DetectedCavity>& found) {
  const Watch& watch = watches_[body];
  const Hollow& hollow = *watch.hollow;
  const BodyExtent& extent = air_.extent(body);
  const double level = watch.slam->level;
  const double least = hollow.radius() + extent.thickness;
  if (hollow.way() <= least) {
    ++none_.stopped;
  } else if (level - air_.floor_below(body) <= least) {
    ++none_.shallow;
  } else if (extent.upper[2] >= level) {
    ++none_.afloat;
  } else if (!watch.seen && hollow.radius() >= kNarrow * spacing_) {
    ++none_.unseen;
  } else {
    const std::optional<Hollow::Air> air = hollow.shut_in(air_.free_behind(body));
    const double radius = air ? sphere_radius(air->volume) : 0.0;
    if (radius >= settings_.cavity_radius_min && level - air->centre[2] >= 0.5 * radius) {
      tell(body, *air, found);
    } else {
      ++none_.filled;
    }
  }
}

void CavityWatch::tell(std::size_t body, const Hollow::Air& air,
                       std::vector<DetectedCavity>& found) {
  const double depth = watches_[body].slam->level - air.centre[2];
  DetectedCavity cavity;
  cavity.time = watches_[body].hollow->closes_at();
  cavity.body = static_cast<int>(body);
  cavity.radius = sphere_radius(air.volume);
  cavity.epsilon = ring_excitation(air.volume, air.rate, depth, density_, gravity_);
  cavity.life = ring_life(cavity.radius, depth, gravity_);
  cavity.position = air.centre;
  const bool known = std::any_of(told_.begin(), told_.end(), [&](const DetectedCavity& other) {
    return cavity.body != other.body && cavity.time - other.time <= kOneMoment &&
           length(cavity.position - other.position) <= cavity.radius + other.radius;
  });
  if (known) return;
  found.push_back(cavity);
  told_.push_back(cavity);
}

/// Looks at the water around the bodies that want it, and tells what has closed.
void CavityWatch::look(double time, bool looks, std::vector<DetectedCavity>& found) {
  for (std::size_t b = 0; b < watches_.size(); ++b) {
    Watch& watch = watches_[b];
    const bool wants = wants_look(b, time);
    if (looks && (wants || always_)) {
      const double level = watch.slam ? watch.slam->level : air_.level_around(b);
      const BodyExtent& extent = air_.extent(b);
      const Vector3 from = watch.hollow ? watch.hollow->entry() : extent.front;
      const bool open = air_.is_open_to(b, from, level, kBelow * extent.radius);
      watch.seen = watch.seen || (wants && open);
    }
    if (!watch.hollow || time < watch.hollow->closes_at()) continue;
    close(b, found);
    watch = {};
  }
}

std::vector<DetectedCavity> CavityWatch::observe(double time,
                                                 const std::vector<DetectedImpact>& impacts,
                                                 const Bodies& bodies,
                                                 const BodyAir::ReadWater& read_water) {
  std::vector<DetectedCavity> found;
  const bool waits = std::any_of(watches_.begin(), watches_.end(),
                                 [](const Watch& watch) { return watch.slam.has_value(); });
  if (gravity_ <= 0.0 || (!waits && impacts.empty() && !always_)) return found;
  air_.move_to(time, bodies);
  std::erase_if(told_, [&](const DetectedCavity& c) { return time - c.time > 2.0 * kOneMoment; });
  bool looks = always_ || !impacts.empty();
  for (std::size_t b = 0; b < watches_.size(); ++b) {
    follow(b, time);
    looks = looks || wants_look(b, time);
  }
  if (looks) {
    ++looks_;
    air_.read(read_water);
  }
  look(time, looks, found);
  for (const DetectedImpact& impact : impacts) note(impact);
  return found;
}

}  // namespace splash::sim
