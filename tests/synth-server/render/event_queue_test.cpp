// SPDX-License-Identifier: MIT
#include "synth-server/render/event_queue.hpp"

#include <gtest/gtest.h>

#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

TEST(EventQueue, GivesEventsByTimeAndOfOneTimeByArrival) {
  EventQueue queue(100);
  const std::int64_t samples[] = {50, 10, 50, 10, 30, 50};
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(queue.push(impact(1.0F, i), samples[i]));
  EXPECT_FALSE(queue.due(10));
  EXPECT_TRUE(queue.due(11));
  std::vector<int> ids;
  while (queue.size() > 0) ids.push_back(std::get<protocol::Impact>(queue.pop().event).id);
  EXPECT_EQ(ids, (std::vector<int>{1, 3, 4, 0, 2, 5}));
}

TEST(EventQueue, RefusesWhatItCannotHold) {
  EventQueue queue(2);
  EXPECT_TRUE(queue.push(impact(1.0F), 1));
  EXPECT_TRUE(queue.push(impact(1.0F), 1));
  EXPECT_FALSE(queue.push(impact(1.0F), 1));
  queue.pop();
  EXPECT_TRUE(queue.push(impact(1.0F), 1));
  queue.clear();
  EXPECT_EQ(queue.size(), 0U);
}

TEST(EventQueue, KeepsPlacesFromBubbles) {
  EventQueue queue(160);
  int bubbles = 0;
  while (queue.push(bubble(0.01F), 1)) ++bubbles;
  EXPECT_EQ(bubbles, 150);
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(queue.push(impact(1.0F), 1));
    EXPECT_TRUE(queue.push(cavity(0.1F), 1));
  }
  EXPECT_FALSE(queue.push(impact(1.0F), 1));
  EXPECT_EQ(queue.size(), 160U);
}

TEST(EventQueue, AdvancesAllThatWait) {
  EventQueue queue(10);
  for (const std::int64_t sample : {500, 100, 300}) {
    ASSERT_TRUE(queue.push(impact(1.0F, static_cast<int>(sample)), sample));
  }
  queue.advance(250);
  EXPECT_EQ(queue.count_before(0), 1U);
  EXPECT_EQ(queue.count_before(51), 2U);
  EXPECT_EQ(queue.pop().sample, -150);
  EXPECT_EQ(queue.pop().sample, 50);
  queue.advance(-250);
  EXPECT_EQ(queue.pop().sample, 500);
}

}  // namespace
}  // namespace splash::synth
