// SPDX-License-Identifier: MIT
#include "synth-server/render/seating.hpp"

#include <algorithm>

namespace splash::synth {

Seating::Seating(std::size_t packs, int groups)
    : heads_(static_cast<std::size_t>((groups + kGroupParts - 1) / kGroupParts), kNone),
      sizes_(heads_.size(), 0),
      links_(packs),
      empty_(packs) {
  order_.reserve(packs);
}

std::vector<int>::const_iterator Seating::place_of(int pack) const noexcept {
  return std::lower_bound(order_.begin(), order_.end(), pack, [&](int a, int b) {
    const int group_a = links_[static_cast<std::size_t>(a)].group;
    const int group_b = links_[static_cast<std::size_t>(b)].group;
    return group_a != group_b ? group_a < group_b : a < b;
  });
}

std::size_t Seating::tile_of(int pack) const noexcept {
  return static_cast<std::size_t>(links_[static_cast<std::size_t>(pack)].group / kGroupParts);
}

int Seating::begin(int group) noexcept {
  const auto pack = static_cast<int>(empty_.take());
  links_[static_cast<std::size_t>(pack)].group = group;
  ++sizes_[tile_of(pack)];
  link(pack);
  order_.insert(place_of(pack), pack);  // within what was reserved
  return pack;
}

void Seating::note_empty(int pack) noexcept {
  --sizes_[tile_of(pack)];
  unlink(pack);
  order_.erase(place_of(pack));
  empty_.give_back(static_cast<std::uint32_t>(pack));
}

void Seating::link(int pack) noexcept {
  Link& link = links_[static_cast<std::size_t>(pack)];
  int& head = heads_[tile_of(pack)];
  link.previous = kNone;
  link.next = head;
  if (head != kNone) links_[static_cast<std::size_t>(head)].previous = pack;
  head = pack;
}

void Seating::unlink(int pack) noexcept {
  const Link& link = links_[static_cast<std::size_t>(pack)];
  if (link.next != kNone) links_[static_cast<std::size_t>(link.next)].previous = link.previous;
  if (link.previous != kNone) {
    links_[static_cast<std::size_t>(link.previous)].next = link.next;
  } else {
    heads_[tile_of(pack)] = link.next;
  }
}

}  // namespace splash::synth
