// SPDX-License-Identifier: MIT
// Clocks that are an hour off, are set, or drift: events sound when they should all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/network/clock_run.hpp"

namespace splash::network {
namespace {

constexpr double kEnd = 16.0;      // of a run [s]
constexpr double kStep = 6.001;    // when a clock is set [s]
constexpr double kSettled = 1.0;   // after the start, or a step [s]
constexpr double kJitter = 0.016;  // the slowest way through the network [s]
/// Clocks that agree within 5 ms and the doubt of a round trip are left alone.
constexpr double kAgreement = 0.012;

ClockError off_by(double seconds) {
  return [=](double) { return seconds; };
}
ClockError set_by(double seconds) {
  return [=](double at) { return at < kStep ? 0.0 : seconds; };
}

/// Events that play as if they happened more than `ahead` after they did.
auto count_delayed(const ClockReport& report, double ahead) {
  return std::count_if(report.events.begin(), report.events.end(),
                       [=](const Sounded& event) { return event.error > ahead; });
}

class WrongClock : public testing::TestWithParam<bool> {
 protected:
  static Clocks clocks() {
    Clocks clocks;
    clocks.answers_pings = GetParam();
    return clocks;
  }
  static std::string told(double seconds) { return "by " + std::to_string(seconds) + " s"; }
};

TEST_P(WrongClock, FromTheStart) {
  for (const double hour : {3600.0, -3600.0}) {
    Clocks both = clocks();
    both.simulator = off_by(hour);
    const ClockReport report = run_clocks(both, kEnd);
    EXPECT_GT(report.events.size(), 700U);
    EXPECT_LE(report.worst(0.0, kSettled), kJitter + 1e-3) << told(hour) << ": by arrival";
    EXPECT_LE(report.worst(kSettled, kEnd), kAgreement) << told(hour);
    EXPECT_EQ(report.player.too_late, 0U) << told(hour);
  }
}

// What waits for a clock that was set ahead would be heard an hour later: no event may.
TEST_P(WrongClock, SetWhilePlaying) {
  for (const double by : {3600.0, -3600.0, 0.5, -0.5, 0.08, -0.08}) {
    for (const bool of_synth : {false, true}) {
      Clocks both = clocks();
      (of_synth ? both.synth : both.simulator) = set_by(by);
      const ClockReport report = run_clocks(both, kEnd);
      const std::string step = told(by) + (of_synth ? ", the synth's" : ", the simulator's");
      EXPECT_EQ(count_delayed(report, 0.1), 0) << step;
      EXPECT_LE(report.worst(kStep + kSettled, kEnd), kAgreement) << step;
      EXPECT_LE(report.player.too_late, 5U) << step << ": a tenth of a second";
    }
  }
}

TEST_P(WrongClock, Drifting) {
  for (const double drift : {1e-4, -1e-4}) {
    for (const double start : {0.0, 5.0}) {
      Clocks both = clocks();
      both.simulator = [=](double at) { return start + drift * at; };
      const ClockReport report = run_clocks(both, 60.0);
      EXPECT_LE(report.worst(kSettled, 60.0), kAgreement) << drift << " from " << start;
      EXPECT_EQ(report.player.too_late, 0U);
    }
  }
}

std::string name_of(const testing::TestParamInfo<bool>& info) {
  return info.param ? "WithPings" : "WithoutPings";
}

INSTANTIATE_TEST_SUITE_P(Hosts, WrongClock, testing::Bool(), name_of);

TEST(OneHost, MaySetItsClockWithoutBeingHeard) {
  for (const double by : {3600.0, -3600.0, 0.5, -0.5}) {
    Clocks both;
    both.same_host = true;
    both.simulator = both.synth = set_by(by);
    const ClockReport report = run_clocks(both, kEnd);
    EXPECT_LE(report.worst(0.0, kEnd), 1e-3) << by;
    EXPECT_EQ(report.player.too_late, 0U) << by;
  }
}

}  // namespace
}  // namespace splash::network
