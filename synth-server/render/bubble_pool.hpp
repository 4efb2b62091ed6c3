// SPDX-License-Identifier: MIT
// The sounding bubbles and cavities: a fixed number of them in packs of sixteen. Neighbours share a
// pack, since a pack is mixed as a whole into all the channels that any of its voices reaches. When
// all voices are taken, the quietest is faded out, but none that is kept: up to a sixteenth of all
// may be. Places are given back at the end of a cell only,
// so that who sits where does not depend on how rendering is cut into blocks.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "synth-server/render/mix.hpp"
#include "synth-server/render/ranking.hpp"
#include "synth-server/render/routing.hpp"
#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {

/// How exactly bubbles are rendered: within -140 dB or -95 dB of the formula.
enum class Precision { exact, fast };

/// Most voices that start within one cell; 384 000 per second at 48 kHz. Bounds the time that a
/// flood of events can take from a block.
inline constexpr int kMostStarts = 512;
/// Of these, those that bubbles leave to impacts and cavities.
inline constexpr int kKeptStarts = 64;

struct PoolSettings {
  Precision precision = Precision::exact;
  InstructionSet instructions = InstructionSet::best;
  int max_voices = 1;  ///< sounding at once, fading ones not counted
  int max_routes = 1;  ///< of one voice
  int groups = 1;      ///< of voices that share packs, see Routing::Reach
  int channels = 1;
  double sample_rate = 48000.0;  ///< [Hz]
};

class BubblePool {
 public:
  BubblePool() = default;
  virtual ~BubblePool() = default;
  BubblePool(const BubblePool&) = delete;
  BubblePool& operator=(const BubblePool&) = delete;

  enum class Start { started, stole, refused };
  struct Started {
    Start result = Start::refused;
    std::uint32_t place = 0;
  };
  /// A voice begins at `sample`, which lies in the cell that is being mixed and not before what was
  /// mixed. Refused when all voices are louder than it, unless it is one that is kept.
  virtual Started start(const BubbleTone& tone, const VoiceLife& life,
                        std::span<const Route> routes, int group, std::int64_t sample) noexcept = 0;
  /// Adds samples [from, to) of all voices; both within one cell.
  virtual void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept = 0;
  /// At the beginning of a cell, at `sample`: from now on no more than `most` voices at once, up to
  /// max_voices. The quietest of those beyond fade out, not all in one cell.
  virtual void limit(int most, std::int64_t sample) noexcept = 0;
  /// At the end of a cell: gives back the places of voices that are over before `sample`.
  virtual void release(std::int64_t sample) noexcept = 0;
  /// Fades all voices out from `sample` on.
  virtual void fade_all(std::int64_t sample) noexcept = 0;

  [[nodiscard]] virtual std::size_t size() const noexcept = 0;  ///< voices, fading ones included
  [[nodiscard]] virtual const Ranking& ranking() const noexcept = 0;
};

/// Allocates all it will ever use.
[[nodiscard]] std::unique_ptr<BubblePool> make_bubble_pool(const PoolSettings& settings);

}  // namespace splash::synth
