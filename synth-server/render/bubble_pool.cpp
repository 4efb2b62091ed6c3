// SPDX-License-Identifier: MIT
#include "synth-server/render/bubble_pool.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace splash::synth {
namespace {

constexpr std::size_t kKeptPart = 16;  ///< of all voices one of so many may be kept
constexpr int kMostFaded = 64;         ///< in one cell, of those that are too many

constexpr BubblePack kSilent{};

/// Samples that one channel alone gets at once: what was turned is still near when it is mixed. Of
/// many channels each piece would cost a call of the kernel per channel.
constexpr int kPiece = 32;

/// From one channel's sums to the next: not a multiple of a page, or what is read of one channel
/// would be taken for what was just written of another.
constexpr std::size_t kSumStride = kRows + 17 * kPackVoices;

/// Fading voices keep their places for 5 ms: room for all that can be stolen in that time. Each
/// group may have packs that are half empty.
std::size_t packs_for(const PoolSettings& s) {
  const auto voices = static_cast<std::size_t>(s.max_voices);
  const auto cells = static_cast<std::size_t>(kVoiceFade * s.sample_rate / kCell) + 2;
  const std::size_t places = voices + std::min(voices, kMostStarts * cells);
  const std::size_t ragged = std::min(places, static_cast<std::size_t>(s.groups));
  return places / kPackVoices + places / (2 * std::size_t{kPackVoices}) + ragged + 1;
}

/// Samples [from, to) of the cell by the gains of bubbles and cavities.
void scale(std::uint32_t cavities, const Mix& mix, int from, int to, double* row) noexcept {
  const auto& of_bubbles = mix.gains.of<protocol::Bubble>();
  const auto& of_cavities = mix.gains.of<protocol::Cavity>();
  if (of_bubbles.is_one() && (of_cavities.is_one() || cavities == 0)) return;
  std::array<double, kPackLanes> first{};
  std::array<double, kPackLanes> step{};
  for (std::size_t lane = 0; lane < kPackLanes; ++lane) {
    const CellGain& gain = (cavities >> lane & 1U) != 0 ? of_cavities : of_bubbles;
    first[lane] = gain.begin;
    step[lane] = (gain.end - gain.begin) / kCell;
  }
  for (int n = from; n < to; ++n, row += kPackVoices) {
    const auto at = static_cast<double>(n);
    for (std::size_t lane = 0; lane < kPackLanes; ++lane) {
      row[lane] *= first[lane] + step[lane] * at;
    }
  }
}

}  // namespace

void BubblePool::Sitters::note(const VoiceSpan& span) noexcept {
  calm_from = std::max(calm_from, span.start);
  calm_to = std::min({calm_to, span.end, span.fade});
}

BubblePool::BubblePool(const PoolSettings& s)
    : kernels_(pack_kernels(s.instructions)),
      sample_rate_(s.sample_rate),
      max_voices_(static_cast<std::size_t>(s.max_voices)),
      most_(max_voices_),
      fade_length_(std::llround(kVoiceFade * s.sample_rate)),
      break_length_(std::llround(kBreakFade * s.sample_rate)),
      packs_(packs_for(s)),
      sitters_(packs_.size()),
      feeds_(packs_.size(), s.max_routes, s.channels),
      seating_(packs_.size(), s.groups),
      sums_(static_cast<std::size_t>(s.channels) * kSumStride),
      ranking_(packs_.size() * kPackLanes, s.sample_rate),
      piece_(s.channels > 1 ? kCell : kPiece) {}

BubblePool::Start BubblePool::start(const BubbleTone& tone, const VoiceLife& wanted,
                                    std::span<const Route> routes, int group,
                                    std::int64_t sample) noexcept {
  VoiceLife life = wanted;
  life.kept = life.kept && kept_ < max_voices_ / kKeptPart;
  const int found = seating_.find(group, [&](int p) { return feeds_.added(p, routes); });
  if (found == Seating::kNone) return Start::refused;
  const auto pack = static_cast<std::size_t>(found);
  const Start result = make_room(life, sample);
  if (result == Start::refused) {
    if (sitters_[pack].taken == 0) seating_.note_empty(found);
    return result;
  }
  const auto lane = static_cast<std::size_t>(std::countr_one(sitters_[pack].taken));
  seat(packs_[pack], lane, tone, static_cast<int>(sample % kCell));
  const VoiceSpan span = span_of(life, sample);
  sitters_[pack].spans[lane] = span;
  sitters_[pack].taken |= 1U << lane;
  sitters_[pack].note(span);
  if (sitters_[pack].taken == Sitters::kFull) seating_.note_full(found);
  feeds_.add(found, lane, routes);
  const auto place = static_cast<std::uint32_t>(pack * kPackLanes + lane);
  ranking_.enter(place, life, sample, std::min(span.end, span.fade));
  if (wanted.kept) sitters_[pack].cavities |= 1U << lane;
  if (life.kept) {
    sitters_[pack].kept |= 1U << lane;
    ++kept_;
  }
  ++size_;
  ++lasting_;
  return result;
}

void BubblePool::mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept {
  const auto begin = static_cast<int>(from % kCell);
  const auto end = begin + static_cast<int>(to - from);
  const std::span<const int> packs = seating_.packs();
  for (std::size_t first = 0; first < packs.size(); first += kMixedPacks) {
    mix_some(packs.subspan(first), from - begin, begin, end, mix);
  }
  mixed_ = end % kCell;
  for (std::size_t c = 0; c < mix.touched.size(); ++c) {
    if (!feeds_.reaches(c)) continue;
    mix.touched[c] = 1;
    kernels_.collect(&sums_[c * kSumStride], begin, end, &mix.samples[c * kCell]);
  }
}

void BubblePool::limit(int most, std::int64_t sample) noexcept {
  most_ = std::min(max_voices_, static_cast<std::size_t>(std::max(1, most)));
  for (int faded = 0; faded < kMostFaded && lasting_ > most_; ++faded) {
    const std::uint32_t quietest = ranking_.quietest(sample);
    if (quietest == Ranking::kNone) return;
    fade_out(quietest, sample);
  }
}

void BubblePool::release(std::int64_t sample) noexcept {
  for (std::size_t i = seating_.packs().size(); i-- > 0;) {  // backwards: it may lose this one
    const auto p = static_cast<std::size_t>(seating_.packs()[i]);
    if (sitters_[p].calm_to <= sample) release_from(p, sample);
  }
}

void BubblePool::fade_all(std::int64_t sample) noexcept {
  for (const int pack : seating_.packs()) {
    const Sitters& sitters = sitters_[static_cast<std::size_t>(pack)];
    for (std::uint32_t left = sitters.taken; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
      const VoiceSpan& span = sitters.spans[lane];
      if (std::min(span.end, span.fade) <= sample) continue;
      fade_out(static_cast<std::uint32_t>(pack) * kPackVoices + lane, sample);
    }
  }
}

/// The first kMixedPacks of these packs: samples [begin, end) of the cell that starts at `cell`.
/// One channel alone piece by piece.
void BubblePool::mix_some(std::span<const int> packs, std::int64_t cell, int begin, int end,
                          const Mix& mix) noexcept {
  const std::size_t count = std::min<std::size_t>(kMixedPacks, packs.size());
  for (std::size_t k = 0; k < count; ++k) {
    feeds_.join(static_cast<std::size_t>(packs[k]), &rows_[k * kCellRows]);
  }
  for (int from = begin; from < end;) {
    const int to = std::min(end, from + piece_);
    for (std::size_t k = 0; k < count; ++k) {
      const auto p = static_cast<std::size_t>(packs[k]);
      double* const rows = &rows_[k * kCellRows];
      kernels_.turn(packs_[p], from, to, rows);
      const Sitters& sitters = sitters_[p];
      if (cell + from < sitters.calm_from || cell + to > sitters.calm_to) {
        shape(sitters, cell + from, to - from, rows);
      }
      scale(sitters.cavities, mix, from, to, rows);
    }
    mix_joined(from, to);
    from = to;
  }
  feeds_.part();
}

/// Samples [from, to) of the cell, whose rows are there, to the channels that they go to.
void BubblePool::mix_joined(int from, int to) noexcept {
  feeds_.for_each_joined([&](std::size_t channel, const PackMix& packs) {
    kernels_.mix(packs, from, to, &sums_[channel * kSumStride]);
  });
}

BubblePool::Start BubblePool::make_room(const VoiceLife& life, std::int64_t sample) noexcept {
  if (lasting_ < most_) return Start::started;
  const std::uint32_t quietest = ranking_.quietest(sample);
  // Without any, those that count are about to end within this cell.
  if (quietest == Ranking::kNone) return Start::started;
  if (!life.kept && ranking_.level(quietest, sample) >= life.log_amplitude) {
    return Start::refused;
  }
  fade_out(quietest, sample);
  return Start::stole;
}

void BubblePool::fade_out(std::uint32_t place, std::int64_t sample) noexcept {
  Sitters& sitters = sitters_[place / kPackLanes];
  VoiceSpan& span = sitters.spans[place % kPackLanes];
  const std::uint32_t bit = 1U << place % kPackLanes;
  if ((sitters.leaving & bit) == 0) --lasting_;
  sitters.leaving |= bit;
  span.fade_out(sample, fade_length_);
  sitters.note(span);
  ranking_.end_at(place, sample);
}

VoiceSpan BubblePool::span_of(const VoiceLife& life, std::int64_t sample) const noexcept {
  VoiceSpan span{sample + 1, sample + life.length};  // sin 0 is nil, to the last bit
  if (life.breaks < life.length) span.fade_out(sample + life.breaks, break_length_);
  if (life.fold < life.length) {  // out before the pitch reaches Nyquist
    span.fade_out(sample + std::max<std::int64_t>(0, life.fold - fade_length_), fade_length_);
    span.end = std::min(span.end, sample + life.fold);
  }
  return span;
}

/// Puts the tone into its lane. Where the cell was begun already, the lane catches up with its
/// neighbours through the same loop that brought them there, so that it is where it would be.
void BubblePool::seat(BubblePack& pack, std::size_t lane, const BubbleTone& tone,
                      int ahead) noexcept {
  if (mixed_ == 0) return set_lane(pack, lane, tone, sample_rate_, ahead);
  BubblePack latecomer{};
  alignas(64) std::array<double, kRows> unheard;  // NOLINT: never read
  set_lane(latecomer, lane, tone, sample_rate_, ahead);
  kernels_.turn(latecomer, 0, mixed_, unheard.data());
  copy_lane(latecomer, pack, lane);
}

void BubblePool::shape(const Sitters& sitters, std::int64_t from, int count,
                       double* rows) noexcept {
  for (std::uint32_t left = sitters.taken; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    sitters.spans[lane].shape(from, count, rows + lane, kPackVoices);
  }
}

void BubblePool::release_from(std::size_t p, std::int64_t sample) noexcept {
  Sitters& sitters = sitters_[p];
  const bool was_full = sitters.taken == Sitters::kFull;
  sitters.calm_from = 0;
  sitters.calm_to = VoiceSpan::kNever;
  for (std::uint32_t left = sitters.taken; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const VoiceSpan& span = sitters.spans[lane];
    if (span.end > sample) {
      sitters.note(span);
      continue;
    }
    feeds_.remove(p, lane);
    if ((sitters.leaving >> lane & 1U) == 0) --lasting_;
    if ((sitters.kept >> lane & 1U) != 0) --kept_;
    sitters.kept &= ~(1U << lane);
    sitters.cavities &= ~(1U << lane);
    sitters.taken &= ~(1U << lane);
    sitters.leaving &= ~(1U << lane);
    copy_lane(kSilent, packs_[p], lane);
    --size_;
  }
  const auto pack = static_cast<int>(p);
  if (was_full && sitters.taken != Sitters::kFull) seating_.note_open(pack);
  if (sitters.taken == 0) seating_.note_empty(pack);
}

}  // namespace splash::synth
