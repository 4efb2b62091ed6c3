// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/tile_loads.hpp"

#include <algorithm>
#include <numbers>
#include <variant>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// What a tile feels of less is noise and drift of its sensors [N].
constexpr double kNothing = 3.0;

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

}  // namespace splash::sim
