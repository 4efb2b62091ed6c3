// SPDX-License-Identifier: MIT
// Greedy cutting: a bundle is closed when the next event would pass a limit of the wire.
#include "sim-server/send/split.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <variant>

#include "protocol/limits.hpp"

namespace splash::sim {
namespace {

std::int32_t id_of(const protocol::Event& event) {
  return std::visit([](const auto& kind) { return kind.id; }, event);
}

constexpr std::size_t kBundleHeader = 16;  // "#bundle", its padding, the time tag [bytes]

std::size_t element_size(const protocol::Message& message) {
  return 4 + protocol::encoded_size(message);  // each message stands behind its size
}

}  // namespace

void sort_events(std::vector<TimedEvent>& events) {
  const auto key = [](const TimedEvent& timed) {
    return std::make_tuple(timed.play_seconds, timed.event.index(), id_of(timed.event));
  };
  std::stable_sort(events.begin(), events.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
}

std::vector<EventBundle> bundle_events(const std::vector<TimedEvent>& events) {
  const std::size_t opening = kBundleHeader + element_size(protocol::to_message(protocol::Frame{}));
  std::vector<EventBundle> bundles;
  std::size_t bytes = 0;
  for (const TimedEvent& timed : events) {
    protocol::Message message = protocol::to_message(timed.event);
    const std::size_t size = element_size(message);
    const bool full = bundles.empty() || bytes + size > protocol::kMaxDatagram ||
                      bundles.back().messages.size() + 1 > protocol::kMaxMessages;
    if (full) {
      bundles.emplace_back();
      bytes = opening;
    }
    bundles.back().messages.push_back(std::move(message));
    bundles.back().play_seconds.push_back(timed.play_seconds);
    bytes += size;
  }
  return bundles;
}

}  // namespace splash::sim
