// SPDX-License-Identifier: MIT
// Who sits where: voices of one group share packs as far as possible. Each group has a list of its
// packs with free lanes; a pack without voices belongs to nobody.
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
    return pack;
  }

  void note_full(int pack) noexcept { unlink(pack); }  ///< its last lane was taken
  void note_open(int pack) noexcept { link(pack); }    ///< the first lane of a full one is free
  void note_empty(int pack) noexcept {                 ///< of one that was not full
    unlink(pack);
    empty_.give_back(static_cast<std::uint32_t>(pack));
  }

 private:
  static constexpr int kTries = 8;
  struct Link {
    int group = 0;
    int next = kNone;
    int previous = kNone;
  };
  void link(int pack) noexcept;
  void unlink(int pack) noexcept;

  std::vector<int> heads_;   ///< by group
  std::vector<Link> links_;  ///< by pack
  FreePlaces empty_;
};

}  // namespace splash::synth
