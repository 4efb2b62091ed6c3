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

namespace splash::synth {

class Seating {
 public:
  Seating(std::size_t packs, int groups);

  static constexpr int kNone = -1;
  static constexpr int kUnfit = std::numeric_limits<int>::max();
  /// A pack of the group with a free lane, or an empty one, or kNone. `added(pack)`: how many more
  /// channels that pack would be mixed into, or kUnfit; the fewest are taken.
  template <class Added>
  [[nodiscard]] int find(int group, const Added& added) noexcept {
    const int best = fewest(group, added);
    return best != kNone ? best : begin(group);
  }

  /// All packs that have voices, group by group.
  [[nodiscard]] const std::vector<int>& packs() const noexcept { return order_; }

  void note_full(int pack) noexcept { unlink(pack); }  ///< its last lane was taken
  void note_open(int pack) noexcept { link(pack); }    ///< the first lane of a full one is free
  void note_empty(int pack) noexcept;                  ///< one that was not full has no voice left

 private:
  static constexpr int kTries = 8;  ///< packs that are compared
  struct Link {
    int group = 0;
    int next = kNone;
    int previous = kNone;
  };
  /// Of the group's packs with free lanes, that with the fewest more channels.
  template <class Added>
  [[nodiscard]] int fewest(int group, const Added& added) const noexcept {
    int best = kNone;
    int least = kUnfit;
    int pack = heads_[static_cast<std::size_t>(group)];
    for (int tries = 0; pack != kNone && tries < kTries && least > 0; ++tries) {
      const int more = added(pack);
      if (more < least) best = pack;
      least = std::min(least, more);
      pack = links_[static_cast<std::size_t>(pack)].next;
    }
    return best;
  }
  /// The first empty pack becomes the group's; kNone without one.
  int begin(int group) noexcept;
  void link(int pack) noexcept;
  [[nodiscard]] std::vector<int>::const_iterator place_of(int pack) const noexcept;
  void unlink(int pack) noexcept;

  std::vector<int> heads_;            ///< by group: its first pack with a free lane
  std::vector<Link> links_;           ///< by pack
  std::vector<int> order_;            ///< packs with voices, by group and number
  std::vector<std::uint64_t> empty_;  ///< a bit per pack: it has no voice
};

}  // namespace splash::synth
