// SPDX-License-Identifier: MIT
// The sounding bubbles and cavities: a fixed number of them in packs of sixteen. Neighbours share a
// pack, since a pack is mixed as a whole into all the channels that any of its voices reaches. When
// all voices are taken, the quietest is faded out, but none that is kept: up to a sixteenth of all
// may be. Places are given back at the end of a cell only,
// so that who sits where does not depend on how rendering is cut into blocks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "synth-server/render/mix.hpp"
#include "synth-server/render/pack_feeds.hpp"
#include "synth-server/render/ranking.hpp"
#include "synth-server/render/routing.hpp"
#include "synth-server/render/seating.hpp"
#include "synth-server/render/voice_span.hpp"
#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {

/// Most voices that start within one cell; 384 000 per second at 48 kHz. Bounds the time that a
/// flood of events can take from a block.
inline constexpr int kMostStarts = 512;
/// Of these, those that bubbles leave to impacts and cavities.
inline constexpr int kKeptStarts = 64;

inline constexpr auto kPackLanes = static_cast<std::size_t>(kPackVoices);

struct PoolSettings {
  InstructionSet instructions = InstructionSet::best;
  int max_voices = 1;  ///< sounding at once, fading ones not counted
  int max_routes = 1;  ///< of one voice
  int groups = 1;      ///< of voices that share packs, see Routing::Reach
  int channels = 1;
  double sample_rate = 48000.0;  ///< [Hz]
};

class BubblePool {
 public:
  /// Allocates all it will ever use.
  explicit BubblePool(const PoolSettings& settings);

  enum class Start { started, stole, refused };
  /// A voice begins at `sample`, which lies in the cell that is being mixed and not before what was
  /// mixed. Refused when all voices are louder than it, unless it is one that is kept.
  Start start(const BubbleTone& tone, const VoiceLife& wanted, std::span<const Route> routes,
              int group, std::int64_t sample) noexcept;
  /// Adds samples [from, to) of all voices; both within one cell.
  void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept;
  /// At the beginning of a cell, at `sample`: from now on no more than `most` voices at once, up to
  /// max_voices. The quietest of those beyond fade out, not all in one cell.
  void limit(int most, std::int64_t sample) noexcept;
  /// At the end of a cell: gives back the places of voices that are over before `sample`.
  void release(std::int64_t sample) noexcept;
  /// Fades all voices out from `sample` on.
  void fade_all(std::int64_t sample) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }  ///< with fading ones

 private:
  static constexpr auto kCellRows = static_cast<std::size_t>(kRows);

  /// What the kernels need not know of the voices of a pack: which lanes are taken, and from when
  /// to when each sounds.
  struct Sitters {
    static constexpr std::uint32_t kFull = 0xffffU;
    std::uint32_t taken = 0;                   ///< a bit per lane
    std::uint32_t leaving = 0;                 ///< of these, those that were told to make room
    std::uint32_t kept = 0;                    ///< same, those that are not told to
    std::uint32_t cavities = 0;                ///< same, those that are no bubbles
    std::int64_t calm_from = 0;                ///< all have started by then
    std::int64_t calm_to = VoiceSpan::kNever;  ///< none ends or fades before
    std::array<VoiceSpan, kPackLanes> spans;

    void note(const VoiceSpan& span) noexcept;
  };

  void mix_some(std::span<const int> packs, std::int64_t cell, int begin, int end,
                const Mix& mix) noexcept;
  void mix_joined(int from, int to) noexcept;
  Start make_room(const VoiceLife& life, std::int64_t sample) noexcept;
  void fade_out(std::uint32_t place, std::int64_t sample) noexcept;
  [[nodiscard]] VoiceSpan span_of(const VoiceLife& life, std::int64_t sample) const noexcept;
  void seat(BubblePack& pack, std::size_t lane, const BubbleTone& tone, int ahead) noexcept;
  static void shape(const Sitters& sitters, std::int64_t from, int count, double* rows) noexcept;
  void release_from(std::size_t pack, std::int64_t sample) noexcept;

  PackKernels kernels_;
  double sample_rate_;
  std::size_t max_voices_;
  std::size_t most_;           ///< of them, that the load leaves room for
  std::int64_t fade_length_;   ///< samples
  std::int64_t break_length_;  ///< samples
  std::vector<BubblePack, Aligned<BubblePack>> packs_;
  std::vector<Sitters> sitters_;  ///< by pack
  PackFeeds feeds_;               ///< by pack
  Seating seating_;
  std::vector<double, Aligned<double>> sums_;  ///< kRows of each channel
  Ranking ranking_;
  std::size_t size_ = 0;     ///< voices
  std::size_t lasting_ = 0;  ///< of them, those that were not told to make room
  std::size_t kept_ = 0;     ///< same, those that never are
  int piece_;                ///< samples that are mixed at once
  int mixed_ = 0;            ///< samples of this cell that are mixed
  alignas(64) std::array<double, kMixedPacks * kCellRows> rows_{};  ///< of the packs being mixed
};

}  // namespace splash::synth
