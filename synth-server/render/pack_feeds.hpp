// SPDX-License-Identifier: MIT
// Which channels each pack goes to, and how loudly each of its voices does: as many channels as any
// voice of the pack reaches, with nil for those that do not reach it.
#pragma once

#include <cstdint>
#include <new>
#include <span>
#include <vector>

#include "synth-server/render/routing.hpp"
#include "synth-server/render/seating.hpp"
#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {

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

class PackFeeds {
 public:
  /// `most`: channels of a pack; a voice has no more.
  PackFeeds(std::size_t packs, int most, int channels)
      : most_(static_cast<std::size_t>(most)),
        gains_(packs * most_),
        channels_(packs * most_),
        counts_(packs, 0),
        routes_(static_cast<std::size_t>(channels), 0),
        joined_(static_cast<std::size_t>(channels)) {
    joined_channels_.reserve(static_cast<std::size_t>(channels));
  }

  /// How many of these channels the pack does not go to yet; kUnfit without room for them.
  [[nodiscard]] int added(int pack, std::span<const Route> routes) const noexcept {
    const auto p = static_cast<std::size_t>(pack);
    int more = 0;
    for (const Route& route : routes) more += find(p, route.channel) < 0 ? 1 : 0;
    const bool fits = counts_[p] + more <= static_cast<int>(most_);
    return fits ? more : Seating::kUnfit;
  }

  void add(int pack, std::size_t lane, std::span<const Route> routes) noexcept {
    const auto p = static_cast<std::size_t>(pack);
    for (const Route& route : routes) {
      std::int32_t slot = find(p, route.channel);
      if (slot < 0) {
        slot = counts_[p]++;
        gains_[at(p, slot)] = {};
        channels_[at(p, slot)] = route.channel;
      }
      gains_[at(p, slot)].gains[lane] = route.gain;
      ++routes_[static_cast<std::size_t>(route.channel)];
    }
  }

  void remove(std::size_t pack, std::size_t lane) noexcept {
    for (std::int32_t slot = counts_[pack] - 1; slot >= 0; --slot) {
      PackFeed& feed = gains_[at(pack, slot)];
      if (feed.gains[lane] == 0.0) continue;
      feed.gains[lane] = 0.0;
      --routes_[static_cast<std::size_t>(channels_[at(pack, slot)])];
      if (any(feed)) continue;
      const std::int32_t last = --counts_[pack];
      feed = gains_[at(pack, last)];
      channels_[at(pack, slot)] = channels_[at(pack, last)];
    }
  }

  /// Adds a pack, whose samples will lie in `rows`, to those that are mixed together: kMixedPacks
  /// at most.
  void join(std::size_t pack, const double* rows) noexcept {
    for (std::int32_t slot = 0; slot < counts_[pack]; ++slot) {
      const std::int32_t channel = channels_[at(pack, slot)];
      PackMix& packs = joined_[static_cast<std::size_t>(channel)];
      if (packs.count == 0) joined_channels_.push_back(channel);  // within what was reserved
      packs.rows[packs.count] = rows;
      packs.feeds[packs.count++] = &gains_[at(pack, slot)];
    }
  }
  /// Calls for each channel that they go to mix(channel, packs).
  template <class MixOne>
  void for_each_joined(const MixOne& mix) const noexcept {
    for (const std::int32_t next : joined_channels_) {
      const auto channel = static_cast<std::size_t>(next);
      mix(channel, joined_[channel]);
    }
  }
  void part() noexcept {
    for (const std::int32_t c : joined_channels_) joined_[static_cast<std::size_t>(c)].count = 0;
    joined_channels_.clear();
  }

  /// Whether any voice goes to the channel.
  [[nodiscard]] bool reaches(std::size_t channel) const noexcept { return routes_[channel] != 0; }

 private:
  [[nodiscard]] std::size_t at(std::size_t pack, std::int32_t slot) const noexcept {
    return pack * most_ + static_cast<std::size_t>(slot);
  }
  [[nodiscard]] std::int32_t find(std::size_t pack, std::int32_t channel) const noexcept {
    for (std::int32_t slot = 0; slot < counts_[pack]; ++slot) {
      if (channels_[at(pack, slot)] == channel) return slot;
    }
    return -1;
  }
  static bool any(const PackFeed& feed) noexcept {
    for (const double gain : feed.gains) {
      if (gain != 0.0) return true;
    }
    return false;
  }

  std::size_t most_;
  std::vector<PackFeed, Aligned<PackFeed>> gains_;  ///< by pack, most_ each
  std::vector<std::int32_t> channels_;              ///< the same
  std::vector<std::int32_t> counts_;                ///< by pack: how many are used
  std::vector<std::uint32_t> routes_;               ///< by channel: voices that go there
  std::vector<PackMix> joined_;                ///< by channel: of the packs that are being mixed
  std::vector<std::int32_t> joined_channels_;  ///< those that any of them goes to
};

}  // namespace splash::synth
