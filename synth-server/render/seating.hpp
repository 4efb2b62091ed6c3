// SPDX-License-Identifier: MIT
// Who sits where: voices of one group share packs as far as possible. Each group has a list of its
// packs with free lanes; a pack without voices belongs to nobody. The packs with voices are kept in
// the order of their groups, so that those that go to the same channels are mixed in a row.
#pragma once

#include <cstdint>
#include <vector>

#include "synth-server/render/free_places.hpp"

namespace splash::synth {

class Seating {
 public:
  Seating(std::size_t packs, int groups);

  static constexpr int kNone = -1;
  /// A pack of the group with a free lane for which `fits(pack)`, or an empty one, or kNone.
  template <class Fits>
  [[nodiscard]] int find(int group, const Fits& fits) noexcept {
    const auto head = static_cast<std::size_t>(group);
    int pack = heads_[head];
    for (int tries = 0; pack != kNone && tries < kTries; ++tries) {
      if (fits(pack)) return pack;
      pack = links_[static_cast<std::size_t>(pack)].next;
    }
    if (empty_.empty()) return kNone;
    pack = static_cast<int>(empty_.take());
    links_[static_cast<std::size_t>(pack)].group = group;
    link(pack);
    order_.insert(place_of(pack), pack);  // within what was reserved
    return pack;
  }

  /// All packs that have voices, group by group.
  [[nodiscard]] const std::vector<int>& packs() const noexcept { return order_; }

  void note_full(int pack) noexcept { unlink(pack); }  ///< its last lane was taken
  void note_open(int pack) noexcept { link(pack); }    ///< the first lane of a full one is free
  void note_empty(int pack) noexcept;                  ///< one that was not full has no voice left

 private:
  static constexpr int kTries = 8;
  struct Link {
    int group = 0;
    int next = kNone;
    int previous = kNone;
  };
  void link(int pack) noexcept;
  [[nodiscard]] std::vector<int>::const_iterator place_of(int pack) const noexcept;
  void unlink(int pack) noexcept;

  std::vector<int> heads_;   ///< by group
  std::vector<Link> links_;  ///< by pack
  std::vector<int> order_;   ///< packs with voices, by group and number
  FreePlaces empty_;
};

}  // namespace splash::synth
