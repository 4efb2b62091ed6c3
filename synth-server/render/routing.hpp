// SPDX-License-Identifier: MIT
// Which channels an event reaches, and how loudly: body, band, place, level.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/event.hpp"
#include "synth-server/output/rig.hpp"
#include "synth-server/render/audibility.hpp"
#include "synth-server/render/live_controls.hpp"
#include "synth-server/render/seating.hpp"

namespace splash::synth {

struct Route {
  int channel = 0;
  double gain = 0.0;  ///< from metres to full scale [1/m]
};

/// What a voice needs to find its channels.
struct Source {
  protocol::Vec3 position;
  std::int32_t body = -1;
  double frequency = 0.0;  ///< lowest it sounds at [Hz]: outputs whose band ends below are left out
  std::span<const double> parts = {};  ///< of its amplitude, on each output [1]; empty: 1 on all
};

class Routing {
 public:
  struct Skips {
    bool out_of_band = true;  ///< leave out outputs whose band ends below the source's pitch
    bool unfelt = true;       ///< end voices below the rig's thresholds, not only far below these
  };
  Routing(const Rig& rig, const Skips& skips);

  /// Where an output is turned up, weaker voices are worth rendering.
  void follow(const LiveControls& controls) noexcept;

  enum class Result { heard, out_of_band, unheard };
  struct Reach {
    Result result = Result::unheard;
    int routes = 0;      ///< written
    double floor = 0.0;  ///< amplitude under which none of them needs the voice [m]
    int group = 0;       ///< sources of one group, a tile, reach many of the same channels
  };
  /// Writes up to max_routes() routes.
  Reach route(const Source& source, std::span<Route> routes) noexcept;

  [[nodiscard]] int max_routes() const noexcept { return max_routes_; }
  [[nodiscard]] int groups() const noexcept { return groups_; }

 private:
  Skips skips_;
  std::vector<Output> outputs_;
  std::vector<Audibility> audibility_;  ///< of each output
  std::vector<double> levels_;          ///< of each channel [1/m]
  std::vector<double> turned_;          ///< gain of each output over the rig's [1]
  std::vector<double> gains_;           ///< of one output's channels, for spread()
  int max_routes_ = 0;
  int groups_ = 1;
};

}  // namespace splash::synth
