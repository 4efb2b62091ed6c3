// SPDX-License-Identifier: MIT
// Cutting keeps every event, its order and the limits, and never cuts too early.
#include "sim-server/send/split.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "sim-server/send/lo_packet.hpp"
#include "tests/sim-server/send/sample_events.hpp"

namespace splash::sim {
namespace {

std::string label(const TimedEvent& timed) {
  static constexpr char kKinds[] = {'i', 'b', 'c'};
  const auto id = std::visit([](const auto& kind) { return kind.id; }, timed.event);
  return kKinds[timed.event.index()] + std::to_string(id);
}

TEST(Split, SortsByMomentThenKindThenId) {
  std::vector<TimedEvent> events{test::cavity(0, 0.2), test::bubble(9, 0.2), test::bubble(2, 0.2),
                                 test::impact(5, 0.2), test::bubble(7, 0.1)};
  sort_events(events);
  std::string order;
  for (const auto& event : events) order += label(event) + ' ';
  EXPECT_EQ(order, "b7 i5 b2 b9 c0 ");
}

TEST(Split, CutsWhereTheNextEventWouldPassTheDatagram) {
  // /frame takes 36 bytes with its size, a bubble 56: 16 + 36 + 25 * 56 = 1452 of 1472.
  for (const std::int32_t count : {1, 24, 25, 26, 50, 51, 1000}) {
    const auto events = test::bubbles(count, 1.0);
    auto bundles = bundle_events(events);
    EXPECT_EQ(bundles.size(), static_cast<std::size_t>((count + 24) / 25)) << count;
    std::vector<protocol::Message> cut;
    for (auto& [messages, play_seconds] : bundles) {
      messages.front() = protocol::to_message(protocol::Frame{});
      EXPECT_LE(build_bundle({1}, messages).size(), protocol::kMaxDatagram);
      EXPECT_EQ(play_seconds.size() + 1, messages.size());
      cut.insert(cut.end(), messages.begin() + 1, messages.end());
    }
    std::vector<protocol::Message> whole;
    for (const auto& timed : events) whole.push_back(protocol::to_message(timed.event));
    EXPECT_EQ(cut, whole) << count;
  }
}

TEST(Split, NothingGivesNoBundles) {
  EXPECT_TRUE(bundle_events({}).empty());
}

}  // namespace
}  // namespace splash::sim
