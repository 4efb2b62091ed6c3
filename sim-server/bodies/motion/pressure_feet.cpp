// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/pressure_feet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// What a tile feels of less is noise and drift of its sensors [N].
constexpr double kNothing = 3.0;

/// A load so near to a foot's is the foot's [m]: less than its length, for its next step is longer.
/// Where tiles have one sensor, a load is felt in their middles alone: then that of a neighbour.
constexpr double kOwn = 0.28;
constexpr double kNeighbour = 1.05;  ///< of a tile's edge [1]
/// Feet nearer than this stand side by side: what lies between them may be of either [m].
constexpr double kBeside = 0.35;
/// A foot is lifted when it carries less than this of what it was put down by [1].
constexpr double kLifts = 0.5;
/// Of the sole, how far its load gets from its middle [1].
constexpr double kSole = 0.7;

Vector3 flat(Vector3 v) {
  v[2] = 0.0;
  return v;
}

double distance(const Vector3& a, const Vector3& b) {
  return length(flat(a - b));
}

/// The rest of `way` beyond `room` to either side.
double beyond(double way, double room) {
  return way > room ? way - room : std::min(way + room, 0.0);
}

}  // namespace

TileLoads::TileLoads(const TrackingSettings& tracking)
    : floor_(tracking.floor),
      origin_(tracking.position),
      turn_(from_turn({0.0, 0.0, std::numbers::pi / 180.0 * tracking.yaw})),
      readings_(static_cast<std::size_t>(floor_.columns * floor_.rows * floor_.sensors), 0.0) {}

bool TileLoads::take(const protocol::Message& message, const LetTiles& lets) {
  if (message.arguments.empty()) return false;
  const auto* first = std::get_if<std::int32_t>(&message.arguments.front());
  if (first == nullptr || *first < 0) return false;
  std::size_t at = static_cast<std::size_t>(*first);
  if (lets && at < readings_.size() && !lets(*first)) return false;
  for (std::size_t i = 1; i < message.arguments.size() && at < readings_.size(); ++i, ++at) {
    const auto* force = std::get_if<float>(&message.arguments[i]);
    // A floor only pushes: what is below zero is a sensor's drift.
    if (force != nullptr) readings_[at] = std::max(static_cast<double>(*force), 0.0);
  }
  const bool another = static_cast<std::size_t>(*first) < next_;
  next_ = at >= readings_.size() ? 0 : at;
  return another || next_ == 0;
}

std::vector<TileLoad> TileLoads::loads() const {
  std::vector<TileLoad> loads;
  const auto sensors = static_cast<std::size_t>(floor_.sensors);
  const auto columns = static_cast<std::size_t>(floor_.columns);
  for (std::size_t tile = 0; tile * sensors < readings_.size(); ++tile) {
    const std::size_t row = tile / columns;
    const std::size_t column = tile % columns;
    double force = 0.0;
    Vector3 moment = {};
    for (std::size_t corner = 0; corner < sensors; ++corner) {
      const double reading = readings_[tile * sensors + corner];
      const std::size_t far = corner / 2;  // of the two corners at +y
      const Vector3 middle = {0.5, 0.5, 0.0};
      const Vector3 own = {static_cast<double>(corner % 2), static_cast<double>(far), 0.0};
      const Vector3 at = Vector3{static_cast<double>(column), static_cast<double>(row), 0.0} +
                         (sensors == 1 ? middle : own);
      force += reading;
      moment = moment + reading * at;
    }
    if (force < kNothing) continue;
    loads.push_back({force, origin_ + rotate(turn_, (floor_.tile / force) * moment)});
  }
  return loads;
}

PressureFeet::PressureFeet(const Scene& scene)
    : floor_(scene.tracking.floor), tiles_(scene.tracking) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodySettings& body = scene.bodies[b];
    if (body.motion.kind != MotionKind::pressure) continue;
    Foot foot;
    foot.body = b;
    foot.place = foot.load = body.rest.position;
    const Vector3 x = flat(rotate(body.rest.rotation, {1.0, 0.0, 0.0}));
    foot.along = length(x) > 1.0e-3 ? (1.0 / length(x)) * x : Vector3{1.0, 0.0, 0.0};
    foot.half = 0.5 * body.shape.size[0];
    foot.wide = 0.5 * body.shape.size[1];
    feet_.push_back(foot);
  }
}

bool PressureFeet::take(const protocol::Message& message, const GiveTouch& give,
                        const LetTiles& lets) {
  if (feet_.empty() || message.address != "/tile/pressure") return false;
  if (tiles_.take(message, lets)) follow(tiles_.loads(), give);
  return true;
}

/// The standing foot whose load was nearest, within `reach`; null: there is none.
PressureFeet::Foot* PressureFeet::nearest(const Vector3& place, double reach, const Foot* but) {
  Foot* found = nullptr;
  for (Foot& foot : feet_) {
    if (!foot.down || &foot == but) continue;
    const double far = distance(foot.load, place);
    if (far > reach) continue;
    if (found == nullptr || far < distance(found->load, place)) found = &foot;
  }
  return found;
}

void PressureFeet::share_out(const TileLoad& load, std::vector<TileLoad>& left) {
  const double own = floor_.sensors == 1 ? std::max(kOwn, kNeighbour * floor_.tile) : kOwn;
  Foot* const first = nearest(load.place, std::max(own, kBeside), nullptr);
  Foot* const second = first == nullptr ? nullptr : nearest(load.place, kBeside, first);
  // Where either has loads of its own, each load is of one of them.
  const bool beside = second != nullptr && distance(first->load, second->load) < kBeside &&
                      second->near < kLifts * floor_.load;
  if (!beside) {
    const bool its = first != nullptr && distance(first->load, load.place) <= own;
    if (!its) {
      left.push_back(load);
      return;
    }
    first->force += load.force;
    first->moment = first->moment + load.force * load.place;
    return;
  }
  const Vector3 lever = flat(second->load - first->load);
  const double share =
      std::clamp(dot(flat(load.place - first->load), lever) / dot(lever, lever), 0.0, 1.0);
  for (const auto& [foot, part] : {std::pair{first, 1.0 - share}, std::pair{second, share}}) {
    foot->force += part * load.force;
    foot->moment = foot->moment + part * load.force * foot->load;
  }
}

/// Loads that are no foot's, the heaviest first, with what lies next to them.
void PressureFeet::put_down(const std::vector<TileLoad>& left) {
  std::vector<TileLoad> loads = left;
  const double own = floor_.sensors == 1 ? std::max(kOwn, kNeighbour * floor_.tile) : kOwn;
  while (!loads.empty()) {
    const TileLoad heaviest =
        *std::max_element(loads.begin(), loads.end(),
                          [](const TileLoad& a, const TileLoad& b) { return a.force < b.force; });
    double force = 0.0;
    Vector3 moment = {};
    std::erase_if(loads, [&](const TileLoad& load) {
      if (distance(load.place, heaviest.place) > own) return false;
      force += load.force;
      moment = moment + load.force * load.place;
      return true;
    });
    if (force < floor_.load) continue;
    const Vector3 place = (1.0 / force) * moment;
    Foot* its = nullptr;
    for (Foot& foot : feet_) {
      if (foot.down) continue;
      if (its == nullptr || distance(foot.load, place) < distance(its->load, place)) its = &foot;
    }
    if (its == nullptr) return;
    its->down = true;
    its->force = force;
    its->moment = moment;
    its->place = its->load = place;
  }
}

void PressureFeet::move(Foot& foot) const {
  foot.load = (1.0 / foot.force) * foot.moment;
  const Vector3 across = {-foot.along[1], foot.along[0], 0.0};
  const Vector3 way = flat(foot.load - foot.place);
  foot.place = foot.place + beyond(dot(way, foot.along), kSole * foot.half) * foot.along +
               beyond(dot(way, across), kSole * foot.wide) * across;
}

void PressureFeet::follow(const std::vector<TileLoad>& loads, const GiveTouch& give) {
  for (Foot& foot : feet_) {
    foot.force = foot.near = 0.0;
    foot.moment = {};
  }
  for (const TileLoad& load : loads) {
    if (Foot* const foot = nearest(load.place, kBeside, nullptr)) foot->near += load.force;
  }
  std::vector<TileLoad> left;
  for (const TileLoad& load : loads) share_out(load, left);
  for (Foot& foot : feet_) {
    if (!foot.down || foot.force >= kLifts * floor_.load) continue;
    foot.down = false;
    give({.body = foot.body, .down = false});
  }
  put_down(left);
  for (Foot& foot : feet_) {
    if (!foot.down) continue;
    move(foot);
    give({.body = foot.body, .down = true, .place = foot.place});
  }
}

}  // namespace splash::sim
