// SPDX-License-Identifier: MIT
#include "synth-server/render/seating.hpp"

#include <algorithm>
#include <bit>

namespace splash::synth {

Seating::Seating(std::size_t packs, int groups)
    : heads_(static_cast<std::size_t>(groups), kNone), links_(packs), empty_(packs / 64 + 1) {
  order_.reserve(packs);
  for (std::size_t pack = 0; pack < packs; ++pack)
    empty_[pack / 64] |= std::uint64_t{1} << pack % 64;
}

std::vector<int>::const_iterator Seating::place_of(int pack) const noexcept {
  return std::lower_bound(order_.begin(), order_.end(), pack, [&](int a, int b) {
    const int group_a = links_[static_cast<std::size_t>(a)].group;
    const int group_b = links_[static_cast<std::size_t>(b)].group;
    return group_a != group_b ? group_a < group_b : a < b;
  });
}

int Seating::begin(int group) noexcept {
  const auto word = std::find_if(empty_.begin(), empty_.end(), [](auto bits) { return bits != 0; });
  if (word == empty_.end()) return kNone;
  const auto pack = static_cast<int>(word - empty_.begin()) * 64 + std::countr_zero(*word);
  *word &= *word - 1;
  links_[static_cast<std::size_t>(pack)].group = group;
  link(pack);
  order_.insert(place_of(pack), pack);  // within what was reserved
  return pack;
}

void Seating::note_empty(int pack) noexcept {
  unlink(pack);
  order_.erase(place_of(pack));
  empty_[static_cast<std::size_t>(pack) / 64] |= std::uint64_t{1} << pack % 64;
}

void Seating::link(int pack) noexcept {
  Link& link = links_[static_cast<std::size_t>(pack)];
  int& head = heads_[static_cast<std::size_t>(link.group)];
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
    heads_[static_cast<std::size_t>(link.group)] = link.next;
  }
}

}  // namespace splash::synth
