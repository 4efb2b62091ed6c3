// SPDX-License-Identifier: MIT
#include "synth-server/render/routing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "synth-server/output/spreading.hpp"

namespace splash::synth {
namespace {

/// Most channels one event can reach.
int most_routes(const Output& output) {
  if (output.kind != OutputKind::tiles) return channel_count(output);
  const int across = 2 * static_cast<int>(std::ceil(output.reach / output.tile_size)) + 1;
  return std::min(across, output.tiles_x) * std::min(across, output.tiles_y);
}

/// Of many groups, some share a number: their voices just share packs less well.
constexpr int kMostGroups = 65536;

/// A tile: from everywhere in it, many of the channels in reach are the same.
int places_of(const Output& output) {
  return output.kind == OutputKind::tiles ? output.tiles_x * output.tiles_y : 1;
}

int tile_of(const Output& output, const protocol::Vec3& position) noexcept {
  if (output.kind != OutputKind::tiles) return 0;
  const auto tile = [&](float offset, double edge, int tiles) {
    const double steps = std::floor((static_cast<double>(offset) - edge) / output.tile_size);
    return static_cast<int>(std::clamp(steps, 0.0, tiles - 1.0));
  };
  return tile(position.y, output.place[1], output.tiles_y) * output.tiles_x +
         tile(position.x, output.place[0], output.tiles_x);
}

}  // namespace

Routing::Routing(const Rig& rig, const Skips& skips) : skips_(skips), outputs_(rig.outputs) {
  std::size_t widest = 0;
  for (const Output& output : outputs_) {
    const auto channels = static_cast<std::size_t>(channel_count(output));
    audibility_.emplace_back(output, skips.unfelt);
    for (std::size_t c = 0; c < channels; ++c) {
      const double trim = output.trims_db.empty() ? 0.0 : output.trims_db[c];
      levels_.push_back(std::pow(10.0, (output.gain_db + trim) / 20.0) / output.full_scale);
    }
    widest = std::max(widest, channels);
    max_routes_ += most_routes(output);
    // Not reached, or reached at one of its places.
    const std::int64_t product = std::int64_t{groups_} * (1 + places_of(output));
    groups_ = static_cast<int>(std::min<std::int64_t>(kMostGroups, product));
  }
  turned_.assign(outputs_.size(), 1.0);
  gains_.resize(widest);
}

void Routing::follow(const LiveControls& controls) noexcept {
  for (std::size_t o = 0; o < turned_.size(); ++o) turned_[o] = controls.output_gain(o);
}

Routing::Reach Routing::route(const Source& source, std::span<Route> routes) noexcept {
  Reach reach;
  reach.floor = std::numeric_limits<double>::infinity();
  bool in_band = false;
  std::uint64_t group = 0;
  int first = 0;
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    const Output& output = outputs_[o];
    const int channels = channel_count(output);
    const int begin = first;
    first += channels;
    if (skips_.out_of_band && source.frequency > output.band.high) continue;
    in_band = true;
    if (output.body >= 0 && output.body != source.body) continue;
    spread(output, source.position, gains_.data());
    const double part = source.parts.empty() ? 1.0 : source.parts[o];
    double loudest = 0.0;
    for (int c = 0; c < channels; ++c) {
      const auto level = static_cast<std::size_t>(begin) + static_cast<std::size_t>(c);
      const double gain = gains_[static_cast<std::size_t>(c)] * levels_[level] * part;
      if (gain <= 0.0 || static_cast<std::size_t>(reach.routes) == routes.size()) continue;
      routes[static_cast<std::size_t>(reach.routes++)] = {begin + c, gain};
      loudest = std::max(loudest, gain);
    }
    group *= 1U + static_cast<unsigned>(places_of(output));
    if (loudest <= 0.0) continue;
    group += 1U + static_cast<unsigned>(tile_of(output, source.position));
    reach.floor =
        std::min(reach.floor, audibility_[o].floor(source.frequency) / (loudest * turned_[o]));
  }
  reach.group = static_cast<int>(group % static_cast<unsigned>(groups_));
  if (reach.routes > 0) {
    reach.result = Result::heard;
  } else if (!in_band) {
    reach.result = Result::out_of_band;
  }
  return reach;
}

}  // namespace splash::synth
