// SPDX-License-Identifier: MIT
// What gives way, in which order, and when it comes back.
#include "sim-server/serve/overload.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace splash::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kFrame = 1.0 / 160.0;  // [s]

/// Levels that were changed to during `seconds` of wall time at `load`.
std::vector<Load> run(Overload& overload, double seconds, double load) {
  std::vector<Load> levels;
  for (double t = 0.0; t < seconds; t += std::max(kFrame, load * kFrame)) {
    if (overload.note(kFrame, load * kFrame)) levels.push_back(overload.level());
  }
  return levels;
}

TEST(Overload, NothingGivesWayWhileTheMachineKeepsUp) {
  Overload overload({.has_gauges = true, .largest_stretch = 1.05});
  EXPECT_THAT(run(overload, 60.0, 0.95), ElementsAre());
  EXPECT_NEAR(overload.spent_at(Load::easy), 60.0, 0.1);
}

TEST(Overload, GivesWayInOrderAndComesBackInReverse) {
  Overload overload({.has_gauges = true, .largest_stretch = 1.05});
  EXPECT_THAT(run(overload, 10.0, 1.5), ElementsAre(Load::lean, Load::coarse, Load::slow));
  EXPECT_NEAR(overload.load(), 1.5, 0.01);
  EXPECT_THAT(run(overload, 20.0, 0.5), ElementsAre(Load::coarse, Load::lean, Load::easy));
}

TEST(Overload, SkipsTheGaugesOfARunWithoutAny) {
  Overload overload({.has_gauges = false, .largest_stretch = 1.05});
  EXPECT_THAT(run(overload, 10.0, 1.5), ElementsAre(Load::coarse, Load::slow));
  EXPECT_THAT(run(overload, 20.0, 0.5), ElementsAre(Load::coarse, Load::easy));
}

TEST(Overload, SkipsLongerStepsWhereNoneAreStable) {
  Overload overload({.has_gauges = false, .largest_stretch = 1.0});
  EXPECT_THAT(run(overload, 10.0, 1.5), ElementsAre(Load::slow));
  EXPECT_THAT(run(overload, 20.0, 0.5), ElementsAre(Load::easy));
}

// Of a solver whose cost falls as steps get longer: they become no longer than is needed, and stay
// so for as long as shorter ones would be too slow.
TEST(Overload, StepsBecomeAsMuchLongerAsTheMachineAsksFor) {
  for (const double load : {1.1, 1.4, 1.65}) {
    Overload overload({.has_gauges = false, .largest_stretch = 2.0});
    const auto seconds = [&](double length) {
      std::vector<Load> levels;
      for (double t = 0.0; t < length;) {
        const double cost = load / overload.stretch() * kFrame;
        if (overload.note(kFrame, cost)) levels.push_back(overload.level());
        t += std::max(kFrame, cost);
      }
      return levels;
    };
    EXPECT_THAT(seconds(5.0), testing::Each(Load::coarse)) << load;
    EXPECT_THAT(load / overload.stretch(), testing::AllOf(testing::Ge(0.8), testing::Le(0.98)));
    EXPECT_THAT(seconds(60.0), ElementsAre()) << load;
    EXPECT_THAT(run(overload, 20.0, 0.3), ElementsAre(Load::easy)) << load;
    EXPECT_EQ(overload.stretch(), 1.0);
  }
}

TEST(Overload, StepsThatAreAsLongAsTheyMayBeAreNotEnough) {
  Overload overload({.has_gauges = false, .largest_stretch = 2.0});
  EXPECT_THAT(run(overload, 10.0, 2.5), testing::Contains(Load::slow));
  EXPECT_EQ(overload.stretch(), 2.0);
}

TEST(Overload, OneSlowFrameChangesNothing) {
  Overload overload({.has_gauges = true, .largest_stretch = 1.05});
  static_cast<void>(run(overload, 5.0, 0.5));
  EXPECT_FALSE(overload.note(kFrame, 20.0 * kFrame)) << "0.1 s of something else";
  EXPECT_THAT(run(overload, 5.0, 0.5), testing::AllOf(testing::SizeIs(testing::Le(2U))));
  EXPECT_NE(overload.level(), Load::slow);
}

TEST(Overload, StaysWhereItIsBetweenTheBounds) {
  Overload overload({.has_gauges = true, .largest_stretch = 1.05});
  static_cast<void>(run(overload, 1.7, 1.3));
  const Load level = overload.level();
  EXPECT_NE(level, Load::easy);
  static_cast<void>(run(overload, 0.5, 0.85));
  EXPECT_THAT(run(overload, 30.0, 0.85), ElementsAre());
}

// A load that coming back itself causes must not make levels swing for ever at the same pace.
TEST(Overload, WaitsLongerAfterEachStepDownThatWasTooEarly) {
  Overload overload({.has_gauges = true, .largest_stretch = 1.05});
  int changes = 0;
  for (int second = 0; second < 300; ++second) {
    const double load = overload.level() == Load::easy ? 1.2 : 0.6;
    changes += static_cast<int>(run(overload, 1.0, load).size());
  }
  EXPECT_GT(changes, 4);
  EXPECT_LT(changes, 40) << "at the usual wait of 2 s there would be a hundred";
}

TEST(Overload, NonsenseIsNoLoad) {
  Overload overload({.has_gauges = true, .largest_stretch = 1.05});
  EXPECT_FALSE(overload.note(0.0, 1.0));
  EXPECT_FALSE(overload.note(kFrame, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(overload.load(), 0.0);
}

TEST(Overload, SaysWhatGivesWay) {
  Overload overload({.has_gauges = true, .largest_stretch = 1.05});
  static_cast<void>(overload.note(10.0, 15.0));
  EXPECT_THAT(describe(overload, true), HasSubstr("gauges"));
  static_cast<void>(overload.note(10.0, 15.0));
  EXPECT_THAT(describe(overload, true), HasSubstr("1.05 times as long"));
  static_cast<void>(overload.note(10.0, 15.0));
  EXPECT_THAT(describe(overload, true),
              testing::AllOf(HasSubstr("slower than the clock"), HasSubstr("1.50 s"),
                             HasSubstr("fluid.time_step_factor: 2")));
  EXPECT_THAT(describe(overload, false), testing::Not(HasSubstr("time_step_factor")));
}

}  // namespace
}  // namespace splash::sim
