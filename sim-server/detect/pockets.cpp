// SPDX-License-Identifier: MIT
#include "sim-server/detect/pockets.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "sim-server/detect/cavity_laws.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// When a hollow closes, of its closing time [1].
constexpr double kEarliest = 0.6;
constexpr double kLatest = 1.6;

/// A body that goes up faster than this part of the speed at which it came comes out [1].
constexpr double kOutward = 0.1;

/// Cavities of one place within this time are one [s]. What closes later in the same entry is a
/// cavity of its own only if it has so many times the air: a drop of air may come off before [1].
constexpr double kAtOnce = 0.050;
constexpr double kLarger = 2.0;

/// Whether more of these cells' air is enclosed than open; also where there is none.
bool is_closed(const std::vector<Vector3>& cells, const AirCells& air) {
  std::ptrdiff_t open = 0;
  std::ptrdiff_t enclosed = 0;
  for (const Vector3& cell : cells) {
    open += air.is_open(cell) ? 1 : 0;
    enclosed += air.pocket_at(cell) >= 0 ? 1 : 0;
  }
  return enclosed >= open;
}

/// Air of all pockets that have any of these cells [m3].
double enclosed_at(const std::vector<Vector3>& cells, const AirCells& air) {
  std::set<int> pockets;
  for (const Vector3& cell : cells) pockets.insert(air.pocket_at(cell));
  pockets.erase(-1);
  double sum = 0.0;
  for (const int p : pockets) sum += air.pockets()[static_cast<std::size_t>(p)].air;
  return sum;
}

}  // namespace

Pockets::Pockets(const Scene& scene, const std::vector<SkinPoint>& skin, double volume, bool always)
    : settings_(scene.detect),
      density_(scene.fluid.density),
      gravity_(-scene.fluid.gravity[2]),
      always_(always),
      air_(scene, skin, volume),
      watches_(scene.bodies.size()) {
  for (const BodySettings& body : scene.bodies) parts_.push_back(body.cavity);
}

void Pockets::forget() {
  watches_ = std::vector<Watch>(watches_.size());
}

/// Nothing where no hollow can close behind the body, in water however deep.
std::optional<Pockets::Slam> Pockets::slam_of(const DetectedImpact& impact) const {
  const auto body = static_cast<std::size_t>(impact.body);
  const BodyExtent& extent = air_.extent(body);
  Slam slam;
  slam.time = impact.time;
  slam.speed = std::min(impact.speed, impact.approach);
  slam.momentum = impact.momentum;
  slam.radius = extent.radius;
  slam.closes = closing_time(slam.radius, gravity_);
  slam.level = impact.position[2];
  slam.way = slam.radius + extent.upper[2] - extent.lower[2];
  if (!parts_[body] || slam.speed * slam.closes <= slam.way) return std::nullopt;
  return slam;
}

void Pockets::note(std::size_t body, Slam slam) {
  slam.level = std::min(slam.level, air_.level_around(body));
  if (slam.level - air_.floor_below(body) <= slam.way) return;
  std::optional<Slam>& known = watches_[body].slam;
  if (!known || slam.momentum >= known->momentum) known = slam;
}

bool Pockets::is_over(std::size_t body, double time) const {
  const Slam& slam = *watches_[body].slam;
  const double up = air_.extent(body).state.velocity[2];
  return time > slam.time &&
         (time > slam.time + kLatest * slam.closes || up > kOutward * slam.speed);
}

bool Pockets::may_close(std::size_t body, double time) const {
  if (!watches_[body].slam) return false;
  const Slam& slam = *watches_[body].slam;
  return time >= slam.time + kEarliest * slam.closes &&
         air_.extent(body).upper[2] <= slam.level - slam.radius;
}

/// All air at the body that was open a frame ago, and is not.
Pockets::Closing Pockets::closing_now(std::size_t body, const AirCells& air, double time) const {
  Closing closing;
  closing.time = time;
  const Watch& watch = watches_[body];
  if (!watch.before) return closing;
  for (const AirCells::Pocket& pocket : air.pockets()) {
    if (pocket.at_side || is_closed(pocket.cells, *watch.before)) continue;
    if (air_.distance(body, pocket) > watch.slam->radius) continue;
    const double volume = closing.volume + pocket.air;
    closing.centre =
        (1.0 / volume) * (closing.volume * closing.centre + pocket.air * pocket.centre);
    closing.volume = volume;
    closing.cells.insert(closing.cells.end(), pocket.cells.begin(), pocket.cells.end());
  }
  return closing;
}

bool Pockets::suffices(const Closing& closing, const Slam& slam) const {
  const double radius = sphere_radius(closing.volume);
  return radius >= settings_.cavity_radius_min && closing.volume >= kLarger * slam.told &&
         slam.level - closing.centre[2] >= 0.5 * radius;
}

void Pockets::tell(const Closing& closing, double rate, std::size_t body,
                   std::vector<DetectedCavity>& found) {
  const Slam& slam = *watches_[body].slam;
  const double depth = slam.level - closing.centre[2];
  DetectedCavity cavity;
  cavity.time = closing.time;
  cavity.body = static_cast<int>(body);
  cavity.radius = sphere_radius(closing.volume);
  cavity.epsilon = ring_excitation(closing.volume, rate, depth, density_, gravity_);
  cavity.life = ring_life(cavity.radius, depth, gravity_);
  cavity.position = closing.centre;
  const bool known = std::any_of(told_.begin(), told_.end(), [&](const DetectedCavity& other) {
    return cavity.body != other.body && cavity.time - other.time <= kAtOnce &&
           length(cavity.position - other.position) <= cavity.radius + other.radius;
  });
  if (known) return;
  found.push_back(cavity);
  told_.push_back(cavity);
}

void Pockets::look(std::size_t body, double time, double frame,
                   std::vector<DetectedCavity>& found) {
  Watch& watch = watches_[body];
  auto air = air_.fill(body, watch.slam->level);
  Closing now = closing_now(body, *air, time);
  std::optional<Closing>& known = watch.closing;
  if (known && is_closed(known->cells, *air)) {
    tell(*known, (enclosed_at(known->cells, *air) - known->volume) / frame, body, found);
    watch.slam->told = known->volume;
  }
  known.reset();
  if (suffices(now, *watch.slam)) known = std::move(now);
  watch.before = std::move(air);
}

std::vector<DetectedCavity> Pockets::observe(double time,
                                             const std::vector<DetectedImpact>& impacts,
                                             const Bodies& bodies,
                                             const BodyAir::ReadWater& read_water) {
  std::vector<DetectedCavity> found;
  const double frame = time - std::exchange(last_, time);
  const bool waits = std::any_of(watches_.begin(), watches_.end(),
                                 [](const Watch& watch) { return watch.slam.has_value(); });
  if (gravity_ <= 0.0 || (!waits && impacts.empty() && !always_)) return found;
  air_.move_to(time, bodies);
  std::erase_if(told_, [&](const DetectedCavity& c) { return time - c.time > 2.0 * kAtOnce; });
  std::vector<std::pair<std::size_t, Slam>> fresh;
  for (const DetectedImpact& impact : impacts) {
    const auto slam = slam_of(impact);
    if (slam) fresh.emplace_back(static_cast<std::size_t>(impact.body), *slam);
  }
  bool looks = always_ || !fresh.empty();
  for (std::size_t b = 0; b < watches_.size(); ++b) {
    if (watches_[b].slam && is_over(b, time)) watches_[b] = {};
    looks = looks || may_close(b, time);
  }
  if (!looks) return found;
  ++looks_;
  air_.read(read_water);
  for (const auto& [body, slam] : fresh) note(body, slam);
  for (std::size_t b = 0; b < watches_.size(); ++b) {
    if (may_close(b, time)) {
      look(b, time, frame, found);
    } else {
      watches_[b].before.reset();
      watches_[b].closing.reset();
      if (always_) static_cast<void>(air_.fill(b, air_.level_around(b)));
    }
  }
  return found;
}

}  // namespace splash::sim
