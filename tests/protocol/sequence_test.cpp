// SPDX-License-Identifier: MIT
#include "protocol/sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {

Frame frame(std::int32_t sequence, std::int32_t session = 5) {
  return {session, sequence & (kCounterWrap - 1), 0, 0.0F};
}

TEST(SequenceWatch, InOrder) {
  SequenceWatch watch;
  EXPECT_EQ(watch.observe(frame(100)), Arrival::first);
  for (int i = 101; i < 300; ++i) EXPECT_EQ(watch.observe(frame(i)), Arrival::in_order);
  EXPECT_EQ(watch.received(), 200U);
  EXPECT_EQ(watch.lost() + watch.duplicates() + watch.reordered(), 0U);
  EXPECT_EQ(watch.sessions(), 1U);
}

TEST(SequenceWatch, CountsTheGapAndTakesItBack) {
  SequenceWatch watch;
  watch.observe(frame(10));
  EXPECT_EQ(watch.observe(frame(14)), Arrival::in_order);
  EXPECT_EQ(watch.lost(), 3U);
  EXPECT_EQ(watch.observe(frame(12)), Arrival::reordered);
  EXPECT_EQ(watch.lost(), 2U);
  EXPECT_EQ(watch.observe(frame(12)), Arrival::duplicate);
  EXPECT_EQ(watch.observe(frame(14)), Arrival::duplicate);
  EXPECT_EQ(watch.lost(), 2U);
  EXPECT_EQ(watch.duplicates(), 2U);
  EXPECT_EQ(watch.reordered(), 1U);
}

TEST(SequenceWatch, WrapsAtTwoToThe24) {
  SequenceWatch watch;
  watch.observe(frame(kCounterWrap - 2));
  EXPECT_EQ(watch.observe(frame(kCounterWrap - 1)), Arrival::in_order);
  EXPECT_EQ(watch.observe(frame(0)), Arrival::in_order);
  EXPECT_EQ(watch.observe(frame(3)), Arrival::in_order);
  EXPECT_EQ(watch.lost(), 2U);
  EXPECT_EQ(watch.observe(frame(kCounterWrap - 1)), Arrival::duplicate);
  EXPECT_EQ(watch.observe(frame(1)), Arrival::reordered);
  EXPECT_EQ(watch.lost(), 1U);
}

TEST(SequenceWatch, ARestartedSenderIsANewSession) {
  SequenceWatch watch;
  watch.observe(frame(1000, 5));
  EXPECT_EQ(watch.observe(frame(0, 6)), Arrival::new_session);
  EXPECT_EQ(watch.observe(frame(1, 6)), Arrival::in_order);
  EXPECT_EQ(watch.lost(), 0U);
  EXPECT_EQ(watch.sessions(), 2U);
}

TEST(SequenceWatch, OlderThanTheFirstIsNotALossTakenBack) {
  SequenceWatch watch;
  watch.observe(frame(10));
  watch.observe(frame(12));
  EXPECT_EQ(watch.observe(frame(9)), Arrival::reordered);
  EXPECT_EQ(watch.lost(), 1U);
}

TEST(SequenceWatch, TooOldIsDropped) {
  SequenceWatch watch;
  watch.observe(frame(0));
  watch.observe(frame(63));
  EXPECT_EQ(watch.observe(frame(1)), Arrival::reordered);
  watch.observe(frame(200));
  EXPECT_EQ(watch.lost(), 61U + 136U);
  EXPECT_EQ(watch.observe(frame(136)), Arrival::duplicate);  // 64 back
  EXPECT_EQ(watch.observe(frame(137)), Arrival::reordered);  // 63 back
}

// After an outage of half the range, a sender of the same session seems to speak from the past.
TEST(SequenceWatch, FindsBackAfterAVeryLongOutage) {
  SequenceWatch watch;
  watch.observe(frame(0));
  const int far = kCounterWrap / 2 + 1000;
  int dropped = 0;
  while (watch.observe(frame(far + dropped)) == Arrival::duplicate && dropped < 1000) ++dropped;
  EXPECT_EQ(dropped, 63);
  EXPECT_EQ(watch.observe(frame(far + dropped + 1)), Arrival::in_order);
}

// A seeded bad link: each bundle is heard once, and what is counted lost is what was lost.
TEST(SequenceWatch, CountsABadLinkExactly) {
  std::mt19937 random(20);
  std::uniform_int_distribution<int> percent(0, 99);
  std::uniform_int_distribution<int> delay(0, 32);
  struct Arriving {
    int order;
    int sequence;
  };
  constexpr int kSent = 20000;
  std::vector<Arriving> link;
  int lost = 0;
  for (int i = 0; i < kSent; ++i) {
    const bool edge = i < 40 || i > kSent - 40;  // so that all losses lie between two that came
    if (!edge && percent(random) < 20) {
      ++lost;
      continue;
    }
    const int late = edge ? 0 : delay(random);
    link.push_back({i + late, i});
    if (percent(random) < 10) link.push_back({i + late + (edge ? 0 : delay(random) / 2), i});
  }
  std::stable_sort(link.begin(), link.end(),
                   [](const Arriving& a, const Arriving& b) { return a.order < b.order; });
  SequenceWatch watch;
  std::vector<int> played(kSent, 0);
  for (const auto& one : link) {
    if (watch.observe(frame(kCounterWrap - 5000 + one.sequence)) != Arrival::duplicate) {
      ++played[static_cast<std::size_t>(one.sequence)];
    }
  }
  EXPECT_EQ(*std::max_element(played.begin(), played.end()), 1);
  EXPECT_EQ(watch.received(), static_cast<std::uint64_t>(kSent - lost));
  EXPECT_EQ(watch.lost(), static_cast<std::uint64_t>(lost));
  EXPECT_EQ(watch.duplicates(), link.size() - watch.received());
  EXPECT_GT(watch.reordered(), 1000U);
}

}  // namespace
}  // namespace splash::protocol
