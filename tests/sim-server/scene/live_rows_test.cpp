// SPDX-License-Identifier: MIT
#include "sim-server/scene/live_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace splash::sim {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(LiveRows, EachIsARowOfTheScenesTable) {
  const LiveRows live{DetectSettings{}};
  std::size_t marked = 0;
  for (const auto& field : detect_fields()) marked += field.row.live ? 1 : 0;
  const auto rows = live.rows();
  EXPECT_EQ(rows.size(), marked);
  for (const LiveRow& row : rows) {
    EXPECT_EQ(row.name, "detect/" + row.row->key);
    EXPECT_EQ(live.get(row.name), row.value);
    if (!row.is_switch) {
      EXPECT_GE(row.value, row.row->min) << row.name;
      EXPECT_LE(row.value, row.row->max) << row.name;
    }
  }
  EXPECT_FALSE(live.get("detect/cavity_by_count")) << "what is built into the detectors stays";
}

TEST(LiveRows, WhatIsSetIsTakenOnce) {
  LiveRows live{DetectSettings{}};
  EXPECT_FALSE(live.take());
  EXPECT_THAT(live.set("detect/bubble_speed", 0.75), IsEmpty());
  EXPECT_THAT(live.set("detect/impact_waves", 1.0), IsEmpty());
  EXPECT_THAT(live.set("detect/cavity_bubbles_min", 7.0), IsEmpty());
  EXPECT_EQ(live.get("detect/bubble_speed"), 0.75);
  const auto change = live.take();
  ASSERT_TRUE(change);
  EXPECT_EQ(change->detect.bubble_speed, 0.75);
  EXPECT_TRUE(change->detect.impact_waves);
  EXPECT_EQ(change->detect.cavity_bubbles_min, 7);
  EXPECT_THAT(change->rows, ElementsAre(Field(&LiveRow::name, "detect/impact_waves"),
                                        Field(&LiveRow::name, "detect/bubble_speed"),
                                        Field(&LiveRow::name, "detect/cavity_bubbles_min")));
  EXPECT_FALSE(live.take());
}

TEST(LiveRows, TheTablesRangesHold) {
  LiveRows live{DetectSettings{}};
  EXPECT_EQ(live.set("detect/impact_speed", 10.5), "10.5 m/s, allowed 0 to 10");
  EXPECT_EQ(live.set("detect/impact_waves", 2.0), "2, allowed 0 to 1");
  EXPECT_THAT(live.set("detect/impact_waves", 0.5), HasSubstr("whole numbers"));
  EXPECT_THAT(live.set("detect/cavity_bubbles_min", 5.5), HasSubstr("whole numbers"));
  EXPECT_EQ(live.set("detect/radius_min", 0.05), "radius_max is 0.03, not above radius_min (0.05)");
  EXPECT_EQ(live.set("detect/impact_sped", 1.0), "did you mean detect/impact_speed?");
  EXPECT_FALSE(live.set("detect/bubble_per_particle", 1.0).empty());
  EXPECT_FALSE(live.set("impact_speed", 1.0).empty());
  EXPECT_FALSE(live.take()) << "nothing of that was taken";
  // The table's 0.0001 as a float lies below it.
  EXPECT_THAT(live.set("detect/radius_min", static_cast<double>(1e-4F)), IsEmpty());
  EXPECT_EQ(live.get("detect/radius_min"), 1e-4);
}

}  // namespace
}  // namespace splash::sim
