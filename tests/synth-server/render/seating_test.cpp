// SPDX-License-Identifier: MIT
// Voices that go to the same channels share packs, and none is turned away while a lane is free.
#include "synth-server/render/seating.hpp"

#include <gtest/gtest.h>

namespace splash::synth {
namespace {

constexpr int kPacks = 16;
constexpr auto kSame = [](int /*pack*/) { return 0; };

TEST(Seating, TakesThePackWithTheFewestMoreChannels) {
  Seating seating(kPacks, 2);
  const int first = seating.find(0, kSame);
  seating.note_full(first);
  const int second = seating.find(0, kSame);
  ASSERT_NE(second, first);
  seating.note_open(first);
  EXPECT_EQ(seating.find(0, [&](int pack) { return pack == second ? 1 : 2; }), second);
  EXPECT_EQ(seating.find(0, [&](int pack) { return pack == second ? 2 : 1; }), first);
  const int third = seating.find(0, [](int /*pack*/) { return Seating::kUnfit; });
  EXPECT_NE(third, first);
  EXPECT_NE(third, second);
}

TEST(Seating, SharesAmongVoicesOfATileButNotAmongTiles) {
  Seating seating(kPacks, 2);
  const int here = seating.find(0, kSame);
  EXPECT_EQ(seating.find(0, kSame), here);
  EXPECT_NE(seating.find(1, kSame), here) << "the next tile";
}

TEST(Seating, TurnsNobodyAwayWhileThereIsALane) {
  Seating seating(kPacks, 2);
  for (int pack = 0; pack < kPacks - 1; ++pack) seating.note_full(seating.find(0, kSame));
  const int last = seating.find(0, kSame);
  EXPECT_EQ(seating.find(0, kSame), last) << "no pack is empty";
  seating.note_full(last);
  EXPECT_EQ(seating.find(0, kSame), Seating::kNone);
  seating.note_open(3);
  EXPECT_EQ(seating.find(0, kSame), 3);
}

}  // namespace
}  // namespace splash::synth
