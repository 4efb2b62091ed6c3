// SPDX-License-Identifier: MIT
// The sounding impacts: few, each with a noise and a filter of its own. When all places are taken,
// the quietest is faded out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "synth-server/render/mix.hpp"
#include "synth-server/render/ranking.hpp"
#include "synth-server/render/routing.hpp"
#include "synth-server/render/voice_span.hpp"
#include "synth-server/voices/impact_voice.hpp"

namespace splash::synth {

class ImpactPool {
 public:
  /// `max_voices` at once, fading ones not counted; `max_routes` of one; `sample_rate` [Hz].
  ImpactPool(int max_voices, int max_routes, double sample_rate);

  enum class Start { started, stole, refused };
  /// A voice begins at `sample`, which must not lie before what was mixed. Refused when all voices
  /// are louder than it, or too many are fading.
  Start start(const ImpactVoice& voice, const VoiceLife& life, std::span<const Route> routes,
              std::int64_t sample) noexcept;

  /// Adds samples [from, to) of all voices; both within one cell.
  void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept;
  /// At the end of a cell: gives back the places of voices that are over before `sample`.
  void release(std::int64_t sample) noexcept;
  /// Fades all voices out from `sample` on.
  void fade_all(std::int64_t sample) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return order_.size(); }

 private:
  struct Seat {
    ImpactVoice voice;
    VoiceSpan span;
    std::size_t routes = 0;
  };
  void fade_out(std::uint32_t place, std::int64_t sample) noexcept;

  std::size_t max_voices_;
  std::size_t max_routes_;
  std::int64_t fade_length_;          ///< samples
  std::vector<Seat> seats_;           ///< by place
  std::vector<Route> routes_;         ///< by place, max_routes_ each
  std::vector<std::uint32_t> order_;  ///< taken places in the order of starting
  std::vector<std::uint32_t> free_;   ///< places that are not taken
  Ranking ranking_;
  std::size_t lasting_ = 0;  ///< voices that do not fade
};

}  // namespace splash::synth
