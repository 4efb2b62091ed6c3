// SPDX-License-Identifier: MIT
#include "synth-server/render/bubble_pool.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <new>
#include <vector>

#include "synth-server/render/free_places.hpp"
#include "synth-server/render/voice_span.hpp"

namespace splash::synth {
namespace {

constexpr auto kLanes = static_cast<std::size_t>(kPackVoices);

/// Fading voices keep their places for 5 ms: room for all that can be stolen in that time.
std::size_t places_for(const PoolSettings& s) {
  const auto voices = static_cast<std::size_t>(s.max_voices);
  const auto cells = static_cast<std::size_t>(kVoiceFade * s.sample_rate / kCell) + 2;
  const std::size_t fading = std::min(voices, kMostStarts * cells) + kLanes;
  return (voices + fading + kLanes - 1) / kLanes * kLanes;
}

template <class Pack>
PackKernels<Pack> kernels_for(InstructionSet set) noexcept {
  if constexpr (std::is_same_v<Pack, ExactPack>) {
    return exact_kernels(set);
  } else {
    return fast_kernels(set);
  }
}

/// Memory at multiples of 64 bytes, as the kernels want it.
template <class T>
struct Aligned {
  using value_type = T;
  Aligned() = default;
  template <class Other>
  explicit Aligned(const Aligned<Other>& /*other*/) noexcept {}
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{64}));
  }
  void deallocate(T* memory, std::size_t /*count*/) noexcept {
    ::operator delete (memory, std::align_val_t{64});
  }
  bool operator==(const Aligned& /*other*/) const noexcept { return true; }
};

/// What the kernels need not know of the voices of a pack.
struct Sitters {
  std::array<VoiceSpan, kLanes> spans;
  std::array<std::int32_t, kLanes> feeds{};  ///< of each voice; 0: the lane is free
  std::uint32_t taken = 0;                   ///< a bit per lane
  std::uint32_t leaving = 0;                 ///< of these, those that were told to make room
  std::int64_t calm_from = 0;                ///< all have started by then
  std::int64_t calm_to = VoiceSpan::kNever;  ///< none ends or fades before

  void note(const VoiceSpan& span) noexcept {
    calm_from = std::max(calm_from, span.start);
    calm_to = std::min({calm_to, span.end, span.fade});
  }
};

template <class Pack>
class Pool final : public BubblePool {
 public:
  using Real = typename Pack::Real;

  explicit Pool(const PoolSettings& s)
      : kernels_(kernels_for<Pack>(s.instructions)),
        sample_rate_(s.sample_rate),
        max_voices_(static_cast<std::size_t>(s.max_voices)),
        max_routes_(static_cast<std::size_t>(s.max_routes)),
        fade_length_(std::llround(kVoiceFade * s.sample_rate)),
        packs_(places_for(s) / kLanes),
        sitters_(packs_.size()),
        feeds_(packs_.size() * kLanes * max_routes_),
        channels_(static_cast<std::size_t>(s.channels) * kCell),
        channel_voices_(static_cast<std::size_t>(s.channels)),
        free_(packs_.size() * kLanes),
        ranking_(packs_.size() * kLanes, s.sample_rate) {}

  Started start(const BubbleTone& tone, const VoiceLife& life, std::span<const Route> routes,
                std::int64_t sample) noexcept override {
    const Start result = make_room(life.log_amplitude, sample);
    if (result == Start::refused) return {};
    const std::uint32_t place = free_.take();
    seat(place, tone, static_cast<int>(sample % kCell));
    VoiceSpan span{sample + 1, sample + life.length};  // sin 0 is nil, to the last bit
    if (life.fold < life.length) {                     // out before the pitch reaches Nyquist
      span.fade_out(sample + std::max<std::int64_t>(0, life.fold - fade_length_), fade_length_);
      span.end = std::min(span.end, sample + life.fold);
    }
    Sitters& sitters = sitters_[place / kLanes];
    const std::size_t lane = place % kLanes;
    sitters.spans[lane] = span;
    sitters.taken |= 1U << lane;
    sitters.note(span);
    feed(place, routes);
    ranking_.enter(place, life, sample, std::min(span.end, span.fade));
    used_packs_ = std::max<std::size_t>(used_packs_, place / kLanes + 1);
    ++size_;
    ++lasting_;
    return {result, place};
  }

  void mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept override {
    const auto begin = static_cast<int>(from % kCell);
    const auto end = begin + static_cast<int>(to - from);
    alignas(64) std::array<Real, kLanes * kCell> samples;  // NOLINT: all that is read is written
    for (std::size_t p = 0; p < used_packs_; ++p) {
      const Sitters& sitters = sitters_[p];
      if (sitters.taken == 0) continue;
      kernels_.advance(packs_[p], begin, end, samples.data());
      if (from < sitters.calm_from || to > sitters.calm_to) {
        shape(sitters, from, static_cast<int>(to - from), samples.data() + begin);
      }
      kernels_.mix(samples.data(), begin, end, &feeds_[p * kLanes * max_routes_],
                   static_cast<int>(max_routes_), sitters.feeds.data(), channels_.data());
    }
    mixed_ = end % kCell;
    pass_on(begin, end, mix);
  }

  void release(std::int64_t sample) noexcept override {
    for (std::size_t p = 0; p < used_packs_; ++p) {
      if (sitters_[p].taken != 0 && sitters_[p].calm_to <= sample) release_from(p, sample);
    }
    while (used_packs_ > 0 && sitters_[used_packs_ - 1].taken == 0) --used_packs_;
  }

  void fade_all(std::int64_t sample) noexcept override {
    for (std::uint32_t place = 0; place < used_packs_ * kLanes; ++place) {
      const Sitters& sitters = sitters_[place / kLanes];
      const VoiceSpan& span = sitters.spans[place % kLanes];
      const bool taken = (sitters.taken >> place % kLanes & 1U) != 0;
      if (taken && std::min(span.end, span.fade) > sample) fade_out(place, sample);
    }
  }

  [[nodiscard]] std::size_t size() const noexcept override { return size_; }
  [[nodiscard]] const Ranking& ranking() const noexcept override { return ranking_; }

 private:
  Start make_room(double log_amplitude, std::int64_t sample) noexcept {
    if (free_.empty()) return Start::refused;
    if (lasting_ < max_voices_) return Start::started;
    const std::uint32_t quietest = ranking_.quietest(sample);
    // Without any, those that count are about to end within this cell.
    if (quietest == Ranking::kNone) return Start::started;
    if (ranking_.level(quietest, sample) >= log_amplitude) return Start::refused;
    fade_out(quietest, sample);
    return Start::stole;
  }

  void fade_out(std::uint32_t place, std::int64_t sample) noexcept {
    Sitters& sitters = sitters_[place / kLanes];
    VoiceSpan& span = sitters.spans[place % kLanes];
    const std::uint32_t bit = 1U << place % kLanes;
    if ((sitters.leaving & bit) == 0) --lasting_;
    sitters.leaving |= bit;
    span.fade_out(sample, fade_length_);
    sitters.note(span);
    ranking_.end_at(place, sample);
  }

  /// Puts the tone into its lane. Where the cell was begun already, the lane catches up with its
  /// neighbours through the same loop that brought them there, so that it is where it would be.
  void seat(std::uint32_t place, const BubbleTone& tone, int ahead) noexcept {
    Pack& pack = packs_[place / kLanes];
    const std::size_t lane = place % kLanes;
    if (mixed_ == 0) return set_lane(pack, lane, tone, sample_rate_, ahead);
    Pack latecomer{};
    alignas(64) std::array<Real, kLanes * kCell> unheard;  // NOLINT: never read
    set_lane(latecomer, lane, tone, sample_rate_, ahead);
    kernels_.advance(latecomer, 0, mixed_, unheard.data());
    copy_lane(latecomer, pack, lane);
  }

  void feed(std::uint32_t place, std::span<const Route> routes) noexcept {
    for (std::size_t r = 0; r < routes.size(); ++r) {
      feeds_[place * max_routes_ + r] = {routes[r].channel, static_cast<Real>(routes[r].gain)};
      ++channel_voices_[static_cast<std::size_t>(routes[r].channel)];
    }
    sitters_[place / kLanes].feeds[place % kLanes] = static_cast<std::int32_t>(routes.size());
  }

  static void shape(const Sitters& sitters, std::int64_t from, int count, Real* samples) noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if ((sitters.taken >> lane & 1U) == 0) continue;
      sitters.spans[lane].shape(from, count, samples + lane * kCell);
    }
  }

  /// Adds the channels' samples [begin, end) of the cell to the mix and clears them.
  void pass_on(int begin, int end, Mix& mix) noexcept {
    for (std::size_t c = 0; c < channel_voices_.size(); ++c) {
      if (channel_voices_[c] == 0) continue;
      mix.touched[c] = 1;
      for (int n = begin; n < end; ++n) {
        const std::size_t at = c * kCell + static_cast<std::size_t>(n);
        mix.samples[at] += static_cast<double>(channels_[at]);
        channels_[at] = 0;
      }
    }
  }

  void release_from(std::size_t p, std::int64_t sample) noexcept {
    static const Pack kSilent{};
    Sitters& sitters = sitters_[p];
    sitters.calm_from = 0;
    sitters.calm_to = VoiceSpan::kNever;
    for (std::uint32_t left = sitters.taken; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      const VoiceSpan& span = sitters.spans[lane];
      if (span.end > sample) {
        sitters.note(span);
        continue;
      }
      const std::size_t place = p * kLanes + lane;
      for (std::int32_t r = 0; r < sitters.feeds[lane]; ++r) {
        const auto& feed = feeds_[place * max_routes_ + static_cast<std::size_t>(r)];
        --channel_voices_[static_cast<std::size_t>(feed.channel)];
      }
      if ((sitters.leaving >> lane & 1U) == 0) --lasting_;
      sitters.feeds[lane] = 0;
      sitters.taken &= ~(1U << lane);
      sitters.leaving &= ~(1U << lane);
      copy_lane(kSilent, packs_[p], lane);
      free_.give_back(static_cast<std::uint32_t>(place));
      --size_;
    }
  }

  PackKernels<Pack> kernels_;
  double sample_rate_;
  std::size_t max_voices_;
  std::size_t max_routes_;
  std::int64_t fade_length_;  ///< samples
  std::vector<Pack, Aligned<Pack>> packs_;
  std::vector<Sitters> sitters_;               ///< by pack
  std::vector<Feed<Real>> feeds_;              ///< by place, max_routes_ each
  std::vector<Real, Aligned<Real>> channels_;  ///< kCell samples of each channel
  std::vector<std::uint32_t> channel_voices_;  ///< voices that go to each channel
  FreePlaces free_;
  Ranking ranking_;
  std::size_t used_packs_ = 0;  ///< packs from here on have no voice
  std::size_t size_ = 0;        ///< voices
  std::size_t lasting_ = 0;     ///< of them, those that were not told to make room
  int mixed_ = 0;               ///< samples of this cell that are mixed
};

}  // namespace

std::unique_ptr<BubblePool> make_bubble_pool(const PoolSettings& settings) {
  if (settings.precision == Precision::exact) return std::make_unique<Pool<ExactPack>>(settings);
  return std::make_unique<Pool<FastPack>>(settings);
}

}  // namespace splash::synth
