// SPDX-License-Identifier: MIT
#include "tests/network/ledger.hpp"

#include <algorithm>
#include <stdexcept>

#include "protocol/message.hpp"
#include "tests/network/clock.hpp"

namespace splash::network {

void Ledger::note_arrival(const Datagram& datagram, int tick) {
  const auto packet = protocol::decode(datagram).packet;
  const auto frame = protocol::to_frame(packet.messages.at(0));
  if (!frame) throw std::logic_error("a bundle without a frame");
  const std::int32_t sequence = frame->sequence;
  if (!sequences_.insert(sequence).second) {
    ++duplicates;
    return;
  }
  ++bundles;
  if (first_ < 0) first_ = sequence;
  if (sequence < newest_) ++reordered;
  newest_ = std::max(newest_, sequence);
  for (const auto& message : packet.messages) {
    const auto event = protocol::to_event(message);
    if (event) judge(std::visit([](const auto& one) { return one.id; }, *event), tick);
  }
}

/// The block that is asked for at `tick` is the first that can still hold the event.
void Ledger::judge(std::int32_t id, int tick) {
  heard.insert(id);
  const double behind = (tick - moments_.at(id)) * kTick - latency_;
  if (behind > window_) {
    ++too_late;
  } else if (behind > 0.0) {
    ++late;
  }
}

std::uint64_t Ledger::lost() const {
  if (first_ < 0) return 0;
  const auto came = std::distance(sequences_.upper_bound(first_), sequences_.end());
  return static_cast<std::uint64_t>(newest_ - first_ - static_cast<std::int32_t>(came));
}

}  // namespace splash::network
