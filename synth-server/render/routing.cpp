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
  }
  gains_.resize(widest);
}

Routing::Reach Routing::route(const Source& source, std::span<Route> routes) noexcept {
  Reach reach;
  reach.floor = std::numeric_limits<double>::infinity();
  bool in_band = false;
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
    double loudest = 0.0;
    for (int c = 0; c < channels; ++c) {
      const auto level = static_cast<std::size_t>(begin) + static_cast<std::size_t>(c);
      const double gain = gains_[static_cast<std::size_t>(c)] * levels_[level];
      if (gain <= 0.0 || static_cast<std::size_t>(reach.routes) == routes.size()) continue;
      routes[static_cast<std::size_t>(reach.routes++)] = {begin + c, gain};
      loudest = std::max(loudest, gain);
    }
    if (loudest <= 0.0) continue;
    reach.floor = std::min(reach.floor, audibility_[o].floor(source.frequency) / loudest);
  }
  if (reach.routes > 0) {
    reach.result = Result::heard;
  } else if (!in_band) {
    reach.result = Result::out_of_band;
  }
  return reach;
}

}  // namespace splash::synth
