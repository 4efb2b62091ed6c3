// SPDX-License-Identifier: MIT
#include "synth-server/play/sample_clock.hpp"

#include <gtest/gtest.h>

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr double kNow = 1000.0;  // start of the block [s]
constexpr std::int64_t kBlockStart = 96000;

class Schedule : public testing::Test {
 protected:
  Schedule() { clock_.update(kNow, kBlockStart, 256); }
  [[nodiscard]] Placement at(double moment, double by_arrival = kNow) const {
    return place(moment, by_arrival, clock_, kBlockStart, settings_);
  }
  SampleClock clock_{kRate};
  ScheduleSettings settings_{0.010, 0.050, 2.0};
};

TEST_F(Schedule, AddsTheLatency) {
  const Placement placement = at(kNow + 0.1);
  EXPECT_EQ(placement.timing, Timing::on_time);
  EXPECT_EQ(placement.sample, kBlockStart + 4800 + 480);
}

TEST_F(Schedule, RoundsToTheNearestSample) {
  EXPECT_EQ(at(kNow + 0.4 / kRate).sample, kBlockStart + 480);
  EXPECT_EQ(at(kNow + 0.6 / kRate).sample, kBlockStart + 481);
}

TEST_F(Schedule, PlaysAtOnceWhatIsALittleLate) {
  EXPECT_EQ(at(kNow - 0.010).timing, Timing::on_time) << "just covered by the latency";
  for (const double late : {0.0101, 0.030, 0.0599}) {
    const Placement placement = at(kNow - late);
    EXPECT_EQ(placement.timing, Timing::late) << late;
    EXPECT_EQ(placement.sample, kBlockStart) << late;
  }
}

TEST_F(Schedule, DropsWhatIsTooLate) {
  EXPECT_EQ(at(kNow - 0.0601).timing, Timing::too_late);
  EXPECT_EQ(at(kNow - 3600.0).timing, Timing::too_late);
}

TEST_F(Schedule, GoesByArrivalBeyondTheHorizon) {
  EXPECT_EQ(at(kNow + 1.99).timing, Timing::on_time);
  const Placement placement = at(kNow + 3600.0, kNow + 0.020);
  EXPECT_EQ(placement.timing, Timing::early);
  EXPECT_EQ(placement.sample, kBlockStart + 960 + 480);
}

TEST_F(Schedule, NeverWaitsLongerThanTheHorizon) {
  const Placement placement = at(kNow + 3600.0, kNow + 100.0);
  EXPECT_EQ(placement.timing, Timing::early);
  EXPECT_EQ(placement.sample, kBlockStart + 96000 + 480);
}

TEST_F(Schedule, PlaysWhatHasNoTimeWithTheNextBlock) {
  EXPECT_EQ(place_at_once(0.0, kBlockStart, kRate, settings_).sample, kBlockStart);
  const Placement later = place_at_once(0.1, kBlockStart, kRate, settings_);
  EXPECT_EQ(later.timing, Timing::on_time);
  EXPECT_EQ(later.sample, kBlockStart + 4800) << "no latency on top";
  const Placement wild = place_at_once(10.0, kBlockStart, kRate, settings_);
  EXPECT_EQ(wild.timing, Timing::early);
  EXPECT_EQ(wild.sample, kBlockStart + 96000);
}

TEST(Latency, IsWhatIsWantedOrWhatTheBlockNeeds) {
  EXPECT_DOUBLE_EQ(latency_for(0.020, 256, kRate), 0.020);
  EXPECT_DOUBLE_EQ(latency_for(0.0, 256, kRate), 0.0);
  EXPECT_DOUBLE_EQ(latency_for(-1.0, 1024, kRate), 1536.0 / kRate);
  EXPECT_DOUBLE_EQ(latency_for(-1.0, 64, kRate), 0.005);
}

}  // namespace
}  // namespace splash::synth
