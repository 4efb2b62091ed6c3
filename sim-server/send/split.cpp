// SPDX-License-Identifier: MIT
// Greedy cutting: a bundle is closed when the next event would pass a limit of the wire.
#include "sim-server/send/split.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <variant>

#include "protocol/limits.hpp"
#include "protocol/message.hpp"

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

std::vector<std::vector<TimedEvent>> split_events(const std::vector<TimedEvent>& events) {
  const std::size_t opening = kBundleHeader + element_size(protocol::to_message(protocol::Frame{}));
  std::vector<std::vector<TimedEvent>> parts;
  std::size_t bytes = 0;
  for (const auto& event : events) {
    const std::size_t size = element_size(protocol::to_message(event.event));
    const bool full = parts.empty() || bytes + size > protocol::kMaxDatagram ||
                      parts.back().size() + 2 > protocol::kMaxMessages;  // /frame and this one
    if (full) {
      parts.emplace_back();
      bytes = opening;
    }
    parts.back().push_back(event);
    bytes += size;
  }
  return parts;
}

void set_offset(protocol::Event& event, double offset_ms) {
  std::visit([=](auto& kind) { kind.offset_ms = static_cast<float>(offset_ms); }, event);
}

}  // namespace splash::sim
