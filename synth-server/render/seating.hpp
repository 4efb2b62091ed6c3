// SPDX-License-Identifier: MIT
// Who sits where: voices of one group share packs, those that reach the same channels first. Each
// group has a list of its packs with free lanes; a pack without voices belongs to nobody. The packs
// with voices are kept in the order of their groups, so that those that go to the same channels are
// mixed in a row.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "synth-server/render/free_places.hpp"

namespace splash::synth {

/// Groups come in fours, the quarters of a tile: packs are shared within all four, and mixed in the
/// order of the quarter they were begun for.
inline constexpr int kGroupParts = 4;

class Seating {
 public:
  Seating(std::size_t packs, int groups);

  static constexpr int kNone = -1;
  static constexpr int kUnfit = std::numeric_limits<int>::max();
  /// A pack with a free lane, or an empty one, or kNone. `added(pack)`: how many more channels that
  /// pack would be mixed into, or kUnfit; the fewest are taken. In a crowded tile voices share
  /// packs only within their quarter; elsewhere an emptier pack would cost more than channels do.
  template <class Added>
  [[nodiscard]] int find(int group, const Added& added) noexcept {
    const bool crowded = sizes_[static_cast<std::size_t>(group / kGroupParts)] >= kCrowd;
    const int best = fewest(group, crowded, added);
    if (best != kNone) return best;
    return empty_.empty() ? fewest(group, false, added) : begin(group);
  }

  /// All packs that have voices, group by group.
  [[nodiscard]] const std::vector<int>& packs() const noexcept { return order_; }

  void note_full(int pack) noexcept { unlink(pack); }  ///< its last lane was taken
  void note_open(int pack) noexcept { link(pack); }    ///< the first lane of a full one is free
  void note_empty(int pack) noexcept;                  ///< one that was not full has no voice left

 private:
  static constexpr int kTries = 8;                ///< packs that are compared
  static constexpr int kSeen = 64;                ///< packs that are looked at for that
  static constexpr int kCrowd = 3 * kGroupParts;  ///< packs of a tile
  struct Link {
    int group = 0;
    int next = kNone;
    int previous = kNone;
  };
  /// Of the tile's packs with free lanes, or of one quarter's, that with the fewest more channels.
  template <class Added>
  [[nodiscard]] int fewest(int group, bool of_quarter, const Added& added) const noexcept {
    int best = kNone;
    int least = kUnfit;
    int tries = 0;
    int pack = heads_[static_cast<std::size_t>(group / kGroupParts)];
    for (int seen = 0; pack != kNone && seen < kSeen && tries < kTries && least > 0; ++seen) {
      const Link& link = links_[static_cast<std::size_t>(pack)];
      if (!of_quarter || link.group == group) {
        const int more = added(pack);
        if (more < least) best = pack;
        least = std::min(least, more);
        ++tries;
      }
      pack = link.next;
    }
    return best;
  }
  [[nodiscard]] std::size_t tile_of(int pack) const noexcept;
  /// An empty pack becomes the group's.
  int begin(int group) noexcept;
  void link(int pack) noexcept;
  [[nodiscard]] std::vector<int>::const_iterator place_of(int pack) const noexcept;
  void unlink(int pack) noexcept;

  std::vector<int> heads_;   ///< by tile: its first pack with a free lane
  std::vector<int> sizes_;   ///< by tile: its packs
  std::vector<Link> links_;  ///< by pack
  std::vector<int> order_;   ///< packs with voices, by group and number
  FreePlaces empty_;
};

}  // namespace splash::synth
