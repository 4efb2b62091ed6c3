// SPDX-License-Identifier: MIT
#include "tests/network/impaired_link.hpp"

#include <algorithm>
#include <utility>

namespace splash::network {

ImpairedLink::ImpairedLink(const Impairments& impairments, std::uint32_t seed)
    : impairments_(impairments), random_(seed) {}

bool ImpairedLink::chance(double part) {
  return static_cast<double>(random_()) < part * 4294967296.0;
}

int ImpairedLink::below(int limit) {
  return static_cast<int>(random_() % static_cast<std::uint32_t>(limit));
}

bool ImpairedLink::out(int tick) const {
  return tick >= impairments_.outage_from && tick < impairments_.outage_to;
}

void ImpairedLink::send(const Datagram& datagram, int tick) {
  ++sent_;
  const int copies = chance(impairments_.duplication) ? 2 : 1;
  for (int copy = 0; copy < copies; ++copy) {
    if (chance(impairments_.loss)) continue;
    if (chance(impairments_.reordering)) {
      held_.push_back({datagram, sent_ + 1 + below(impairments_.reorder_span)});
    } else {
      dispatch(datagram, tick);
    }
  }
  release(tick, false);
}

void ImpairedLink::dispatch(const Datagram& datagram, int tick) {
  if (out(tick)) return;
  const int travel = 1 + (impairments_.jitter > 0 ? below(impairments_.jitter + 1) : 0);
  under_way_[tick + travel].push_back(datagram);
}

void ImpairedLink::release(int tick, bool all) {
  for (const Held& held : held_) {
    if (all || sent_ >= held.until) dispatch(held.datagram, tick);
  }
  std::erase_if(held_, [&](const Held& held) { return all || sent_ >= held.until; });
}

std::vector<Datagram> ImpairedLink::arrivals(int tick) {
  const auto found = under_way_.find(tick);
  if (found == under_way_.end()) return {};
  std::vector<Datagram> datagrams = std::move(found->second);
  under_way_.erase(found);
  if (out(tick)) datagrams.clear();
  return datagrams;
}

void ImpairedLink::heal(int tick) {
  impairments_ = {};
  release(tick, true);
}

}  // namespace splash::network
