// SPDX-License-Identifier: MIT
// All that sounds: from an event to its voices, unless they would be below the thresholds of touch
// and hearing; and the mix of all voices.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/event.hpp"
#include "synth-server/render/bubble_pool.hpp"
#include "synth-server/render/counters.hpp"
#include "synth-server/render/crowd.hpp"
#include "synth-server/render/engine.hpp"
#include "synth-server/render/fine_water.hpp"
#include "synth-server/render/impact_level.hpp"
#include "synth-server/render/impact_pool.hpp"
#include "synth-server/render/live_controls.hpp"
#include "synth-server/render/routing.hpp"
#include "synth-server/render/underfoot.hpp"
#include "synth-server/voices/cloud.hpp"

namespace splash::synth {

/// Which of many bubbles sound one by one. The number of births a second is averaged over a tenth
/// of a second; once it is more than a tenth over the limit, as many of them as the limit says
/// remain single, evenly chosen among all.
class BirthRate {
 public:
  /// `sample_rate` [Hz]
  explicit BirthRate(double sample_rate) noexcept : span_(kSpan * sample_rate) {}

  /// Whether the bubble that is born at `sample`, not before the last one, is one of `most` [1/s].
  [[nodiscard]] bool is_single(double most, std::int64_t sample) noexcept {
    rate_ = rate_ * std::exp(static_cast<double>(last_ - sample) / span_) + 1.0 / kSpan;
    last_ = sample;
    due_ += rate_ > kMargin * most ? most / rate_ : 1.0;
    if (due_ < 1.0) return false;
    due_ -= 1.0;
    return true;
  }

 private:
  static constexpr double kSpan = 0.1;    ///< the number is averaged over this [s]
  static constexpr double kMargin = 1.1;  ///< chance alone gives 1.02 of 10,000 a second [1]

  double span_;        ///< samples
  double rate_ = 0.0;  ///< births a second
  std::int64_t last_ = 0;
  double due_ = 0.0;  ///< the part of a single one that is due
};

class Ensemble {
 public:
  Ensemble(const Rig& rig, const EngineSettings& settings);

  /// At the beginning of a cell.
  void follow(const LiveControls& controls) noexcept;

  /// A voice begins at its sample, within the cell that is being mixed and not before what was
  /// mixed. However many bubbles there are, impacts and cavities find a place.
  void start(const TimedEvent& timed) noexcept;

  /// At the beginning of a cell, at `sample`: see Engine.
  void press(const Push& push, std::int64_t sample) noexcept;

  /// At the beginning of a cell, at `sample`: see BubblePool.
  void limit(int most, std::int64_t sample) noexcept { bubbles_.limit(most, sample); }

  /// Adds samples [from, to) of all voices; both within one cell.
  void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept;
  /// At the end of a cell, behind which `sample` lies.
  void end_cell(std::int64_t sample) noexcept;
  /// Fades all voices out from `sample` on.
  void fade_all(std::int64_t sample) noexcept;

  [[nodiscard]] std::size_t voices() const noexcept { return bubbles_.size() + impacts_.size(); }

  struct Counts {
    Count stolen, pool, band, unheard, crowded;
    protocol::ByKind<Count> started;
    protocol::ByKind<Count> without_place;  ///< `pool` by kind
  };
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }

 private:
  /// Left out: counted with its reason.
  enum class Outcome { started, crowded, left_out, no_place };
  Outcome start_kind(const protocol::Impact& impact, const TimedEvent& timed) noexcept;
  Outcome start_kind(const protocol::Bubble& bubble, const TimedEvent& timed) noexcept;
  Outcome start_kind(const protocol::Cavity& cavity, const TimedEvent& timed) noexcept;
  template <class BubbleOrCavity>
  Outcome start_air(const BubbleOrCavity& event, const TimedEvent& timed) noexcept;
  /// `cavity`: what the tone is, or null: a bubble.
  Outcome start_tone(const BubbleTone& tone, const Routing::Reach& reach,
                     const protocol::Cavity* cavity, std::int64_t sample) noexcept;
  /// Lets the channels under the event's place feel its force, whatever becomes of its own sound,
  /// unless the simulator tells the force on its body.
  template <class Event>
  void tread(const Event& event, std::int64_t sample) noexcept;
  /// The routes that were found for the event that is being started.
  [[nodiscard]] std::span<const Route> reached(const Routing::Reach& reach) const noexcept {
    return {routes_.data(), static_cast<std::size_t>(reach.routes)};
  }

  EngineSettings settings_;
  Routing routing_;
  std::vector<Route> routes_;  ///< of the voice that is being started
  BubblePool bubbles_;
  ImpactLevel impact_level_;
  ImpactPool impacts_;
  Cloud cloud_;
  BirthRate births_;
  Crowd crowd_;
  FineWater fine_;
  Underfoot underfoot_;
  static constexpr std::size_t kBodies = 256;  ///< of a scene
  std::array<std::int64_t, kBodies> told_{};   ///< until when their forces count as told
  int starts_ = 0;                             ///< in this cell
  Counts counts_;
};

}  // namespace splash::synth
