// SPDX-License-Identifier: MIT
#include "synth-server/render/seating.hpp"

namespace splash::synth {

Seating::Seating(std::size_t packs, int groups)
    : heads_(static_cast<std::size_t>(groups), kNone), links_(packs), empty_(packs) {}

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
