// SPDX-License-Identifier: MIT
// The sweeps' own measure: truth against formulas, and each way of being wrong counted as what it
// is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/bodies/motion/path_motion.hpp"
#include "tests/detection/score.hpp"
#include "tests/detection/script.hpp"
#include "tests/detection/steps.hpp"
#include "tests/detection/table.hpp"

namespace splash::detection {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kLevel = 0.3;  // [m]

/// A centre that goes down from `height` at `speed`, turned by some degrees about y.
Path falling(double height, double speed, double degrees = 0.0) {
  return [=](double time) {
    sim::BodyState state;
    state.position = {0.0, 0.0, height - speed * time};
    state.rotation = pitched(degrees);
    state.velocity = {0.0, 0.0, -speed};
    return state;
  };
}

std::vector<Entry> whole(const sim::Shape& shape, const Path& path, double end = 1.0) {
  return entries_of(0, shape, path, kLevel, end, {});
}

TEST(Truth, IsWhenTheLowestPlaceCrossesTheLevel) {
  const auto flat = whole(hand(), falling(0.5, 0.8));
  ASSERT_THAT(flat, SizeIs(1));
  EXPECT_NEAR(flat[0].time, (0.5 - 0.02 - kLevel) / 0.8, 1.0e-9);
  EXPECT_NEAR(flat[0].down, 0.8, 1.0e-12);
  EXPECT_TRUE(flat[0].wanted);
  const double tilt = 30.0 * std::numbers::pi / 180.0;
  const double low = 0.09 * std::sin(tilt) + 0.02 * std::cos(tilt);
  EXPECT_NEAR(whole(hand(), falling(0.5, 0.8, 30.0)).at(0).time, (0.2 - low) / 0.8, 1.0e-9);
  EXPECT_NEAR(whole(ball(0.1), falling(0.5, 0.8)).at(0).time, 0.15 / 0.8, 1.0e-9);
  const double rim = 0.1 * std::sin(tilt) + 0.02 * std::cos(tilt);
  EXPECT_NEAR(whole(disc(0.2, 0.04), falling(0.5, 0.8, 30.0)).at(0).time, (0.2 - rim) / 0.8,
              1.0e-9);
}

TEST(Truth, AsksNothingOfSlowBodiesNorOfThoseThatHardlyLeave) {
  EXPECT_THAT(whole(hand(), falling(0.33, 0.04)), IsEmpty());
  const auto at_the_limit = whole(hand(), falling(0.33, 0.05));
  ASSERT_THAT(at_the_limit, SizeIs(1));
  EXPECT_FALSE(at_the_limit[0].wanted);
  // Swings of 4 mm, and of 16, about the level.
  for (const double swing : {0.002, 0.008}) {
    const Path path = [=](double time) {
      sim::BodyState state;
      state.position[2] = kLevel + 0.02 + swing * std::cos(40.0 * time);
      state.velocity[2] = -40.0 * swing * std::sin(40.0 * time);
      return state;
    };
    const auto entries = whole(hand(), path);
    ASSERT_THAT(entries, SizeIs(7));  // of 40 rad/s in a second
    EXPECT_EQ(entries.back().wanted, swing > 0.005);
  }
}

TEST(Truth, OfAFootIsEachRollOfSkinThatPressesOnTheWater) {
  // The heel (-x) comes down first, the sole follows.
  const auto steps = steps_of(0, hand(), falling(0.45, 1.0, -30.0), kLevel, 1.0, {});
  ASSERT_THAT(steps, SizeIs(1));
  EXPECT_TRUE(steps[0].wanted);
  const double low = 0.09 * 0.5 + 0.02 * std::sqrt(0.75);
  EXPECT_NEAR(steps[0].time, 0.15 - low, 0.005);
  EXPECT_NEAR(steps[0].until - steps[0].time, 0.18 * 0.5, 0.005);
  EXPECT_NEAR(steps[0].down, 1.0, 1.0e-6);
}

// A plate that goes down by 1 m/s and along by `along`, toe down by 30 degrees.
TEST(Truth, OfAFootAsksNothingOfASoleThatGoesBackAlongItsNormal) {
  const auto steps = [](double along) {
    const Path down = falling(0.45, 1.0, 30.0);
    const Path path = [=](double time) {
      sim::BodyState state = down(time);
      state.position[0] = along * time;
      state.velocity[0] = along;
      return state;
    };
    return steps_of(0, hand(), path, kLevel, 0.4, {});
  };
  EXPECT_THAT(steps(0.0), SizeIs(1));
  EXPECT_THAT(steps(3.0), IsEmpty());
  ASSERT_THAT(steps(-1.0), SizeIs(1));
  EXPECT_NEAR(steps(-1.0)[0].down, 1.0, 0.01);
}

// Drawn back by 3 cm from the hollow that it has made and pushed on again, it meets the water
// there.
TEST(Truth, OfAFootIsAgainstTheWaterThatIsThere) {
  const double low = kLevel - 0.1;
  const Path path = [=](double time) {
    sim::BodyState state;
    const double back = time < 0.2 ? 0.15 * time : time < 0.3 ? 0.03 - 0.3 * (time - 0.2) : 0.0;
    state.position[2] = low + 0.02 + back;
    state.velocity[2] = time < 0.2 ? 0.15 : time < 0.3 ? -0.3 : 0.0;
    return state;
  };
  EXPECT_THAT(steps_of(0, hand(), path, kLevel, 0.5, {}), IsEmpty());
  const auto steps = steps_of(0, hand(), path, low + 0.001, 0.5, {});
  ASSERT_THAT(steps, SizeIs(1));
  EXPECT_TRUE(steps[0].wanted);
  EXPECT_NEAR(steps[0].time, 0.3 - 0.001 / 0.3, 1.0e-3);
  EXPECT_NEAR(steps[0].down, 0.3, 1.0e-6);
}

// Water that goes along is not pressed on, a film as much as the matter behind it.
TEST(Truth, OfAFootCountsWhatTheWaterTakesUp) {
  const auto steps = [](double flow, double ahead) {
    Steps foot(0, hand(), {});
    for (int k = 0; k < 500; ++k) {
      Water water = still_water(kLevel);
      const auto still = water.at;
      water.at = [=](const sim::Vector3& place) { return Met{still(place).gap, {0.0, 0.0, flow}}; };
      water.ahead = [=](const sim::Vector3& /*place*/, const sim::Vector3& /*normal*/) {
        return ahead;
      };
      foot.look(0.001 * k, falling(0.45, 1.0)(0.001 * k), water);
    }
    return foot.all();
  };
  EXPECT_THAT(steps(0.0, 1.0), SizeIs(1));
  EXPECT_THAT(steps(-1.0, 1.0), IsEmpty());
  EXPECT_THAT(steps(0.0, 0.0), IsEmpty());
  ASSERT_THAT(steps(0.0, 0.1), SizeIs(1));
  EXPECT_FALSE(steps(0.0, 0.1)[0].wanted);  // of too little water
}

// A roll that only skin makes which hardly left the water may be told; one that is known stays one.
TEST(Truth, OfAFootAllowsWhatHardlyLeftTheWater) {
  const Entry sure = {0, 1.0, 1.1, 0.5, 0.0, true};
  const auto all =
      with_slight({sure}, {{0, 1.02, 1.12, 0.4, 0.0, true}, {0, 2.0, 2.1, 0.3, 0.0, true}});
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_TRUE(all[0].wanted);
  EXPECT_EQ(all[1].time, 2.0);
  EXPECT_FALSE(all[1].wanted);
}

sim::DetectedImpact impact(double time, double approach, double z = kLevel, int body = 0) {
  return {.time = time,
          .body = body,
          .speed = approach,
          .approach = approach,
          .position = {0.0, 0.0, z}};
}

sim::DetectedCavity cavity(double time, double z) {
  return {.time = time, .bubbles = 9, .radius = 0.05, .position = {0.0, 0.0, z}};
}

/// A body that enters at 1 m/s at 0.2 s.
class Scorer : public testing::Test {
 protected:
  Scorer() {
    entries_ = whole(hand(), falling(0.52, 1.0));
    heard_.paths = {falling(0.52, 1.0), falling(2.0, 0.0)};
    heard_.found.impacts = {impact(0.201, 1.1)};
    heard_.momenta = {0.5};
    wishes_.level = kLevel;
    wishes_.added_mass = 0.4;
  }
  [[nodiscard]] Score judged() const { return score(entries_, heard_, wishes_); }

  std::vector<Entry> entries_;
  Heard heard_;
  Wishes wishes_;
};

TEST_F(Scorer, FindsNoFaultWithWhatIsRight) {
  heard_.found.cavities = {cavity(0.4, 0.2)};
  const Score s = judged();
  EXPECT_THAT(s.faults, IsEmpty());
  EXPECT_EQ(s.wanted, 1);
  EXPECT_EQ(s.hit, 1);
  EXPECT_EQ(s.untrue, 0);
  EXPECT_EQ(s.cavities, 1);
  EXPECT_EQ(s.stray, 0);
  ASSERT_THAT(s.late_ms, SizeIs(1));
  EXPECT_NEAR(s.late_ms[0], 1.0, 1.0e-6);
  EXPECT_NEAR(s.speed_error.at(0), 0.1, 1.0e-9);
  EXPECT_NEAR(s.momentum.at(0), 1.25, 1.0e-9);
}

TEST_F(Scorer, MissesWhatIsNotTold) {
  heard_.found.impacts.clear();
  const Score s = judged();
  EXPECT_EQ(s.hit, 0);
  EXPECT_THAT(s.faults, ElementsAre(HasSubstr("missed: body 0 at 0.200 s")));
}

TEST_F(Scorer, CountsASecondTellingAsFalse) {
  heard_.found.impacts.push_back(impact(0.22, 0.4));
  const Score s = judged();
  EXPECT_EQ(s.hit, 1);
  EXPECT_NEAR(s.late_ms.at(0), 1.0, 1.0e-6);  // the nearer one is the entry's
  EXPECT_EQ(s.untrue, 1);
  EXPECT_THAT(s.faults, ElementsAre(HasSubstr("false: body 0 at 0.220 s")));
}

TEST_F(Scorer, TakesAnotherBodysOrMomentsImpactForFalse) {
  for (const sim::DetectedImpact& wrong :
       {impact(0.2, 1.0, kLevel, 1), impact(0.1, 1.0, 0.4), impact(0.3, 1.0)}) {
    heard_.found.impacts = {wrong};
    const Score s = judged();
    EXPECT_EQ(s.hit, 0);
    EXPECT_EQ(s.untrue, 1);
    EXPECT_THAT(s.faults, SizeIs(2));
  }
}

TEST_F(Scorer, TakesCavitiesAboveOrBeforeOrLongAfterForStray) {
  heard_.found.cavities = {cavity(0.1, 0.2), cavity(0.4, 0.31), cavity(0.75, 0.2)};
  const Score s = judged();
  EXPECT_EQ(s.cavities, 0);
  EXPECT_EQ(s.stray, 3);
  EXPECT_EQ(s.stray_above, 1);
  EXPECT_THAT(s.faults, SizeIs(3));
}

TEST_F(Scorer, HoldsCavitiesToTheirNumberAndTime) {
  wishes_.cavities = Count{1, 1};
  wishes_.closes_after = 0.2;
  EXPECT_THAT(judged().faults, ElementsAre("0 cavities after entries, wanted 1 to 1"));
  heard_.found.cavities = {cavity(0.41, 0.2)};
  EXPECT_THAT(judged().faults, IsEmpty());
  heard_.found.cavities = {cavity(0.3, 0.2), cavity(0.4, 0.2)};
  EXPECT_THAT(judged().faults, ElementsAre(HasSubstr("closes 100 ms after the entry, expected 200"),
                                           HasSubstr("2 cavities")));
}

// At 1 m/s half the front's depth is 90 mm then; a ball of 5 cm radius holds 0.52 litres.
TEST_F(Scorer, HoldsCavitiesToTheirAirAndDepth) {
  wishes_.sinks_after = 0.02;
  wishes_.closes_after = 0.18;
  wishes_.least_air = 0.3e-3;
  wishes_.most_air = 0.6e-3;
  wishes_.body = 0.1e-3;
  wishes_.hollow = 0.5e-3;
  heard_.found.cavities = {cavity(0.4, kLevel - 0.12)};
  EXPECT_THAT(judged().faults, IsEmpty());
  EXPECT_NEAR(judged().closing.at(0), 1.0, 1.0e-6);
  EXPECT_NEAR(judged().air.at(0), 1.247, 0.01);
  EXPECT_NEAR(judged().depth.at(0), 1.333, 0.01);
  wishes_.least_air = 0.55e-3;
  heard_.found.cavities = {cavity(0.4, kLevel - 0.21)};
  EXPECT_THAT(judged().faults,
              ElementsAre("0.52 litres of air in the cavity, expected 0.55 to 0.60",
                          "the cavity lies 210 mm deep, expected 72 to 198"));
  wishes_.least_air = 0.0;
  wishes_.most_air = 0.5e-3;
  heard_.found.cavities = {cavity(0.4, kLevel - 0.12)};
  EXPECT_THAT(judged().faults, SizeIs(1));
}

TEST_F(Scorer, AllowsWavesOnAStandingBodyOnlyWhereTheyAreWished) {
  heard_.found.impacts.push_back(impact(0.5, 0.3, kLevel, 1));
  EXPECT_EQ(judged().untrue, 1);
  wishes_.waves = Count{1, 2};
  EXPECT_EQ(judged().untrue, 0);
  EXPECT_EQ(judged().waves, 1);
  EXPECT_THAT(judged().faults, IsEmpty());
  wishes_.waves = Count{2, 3};
  EXPECT_THAT(judged().faults, ElementsAre("1 impacts of waves, wanted 2 to 3"));
}

TEST_F(Scorer, PutsItsRowsIntoAReadme) {
  Outcome plunge;
  plunge.item.sweep = "speed";
  plunge.score = judged();
  Outcome walk;
  walk.item.sweep = "walk";
  walk.item.name = "5 cm";
  walk.item.tracker = "walk.trc";
  const std::string empty =
      "before\n<!-- begin: detection-bench -->\n<!-- end: detection-bench -->\nafter\n";
  const std::string both = with_rows(empty, {plunge, walk}, false);
  EXPECT_THAT(both, HasSubstr("before\n<!-- begin: detection-bench -->\n\n| sweep | runs"));
  EXPECT_THAT(both, HasSubstr("\n| speed | 1 | 1 | 1 | 0 | 0 |"));
  EXPECT_THAT(both, HasSubstr("\n| walk: 5 cm | 1 | 0 | 0 | 0 | 0 |"));
  EXPECT_THAT(both, HasSubstr("|\n\n<!-- end: detection-bench -->\nafter\n"));
  EXPECT_EQ(with_rows(both, {walk}, false), both);
  plunge.score.untrue = 2;
  EXPECT_THAT(with_rows(both, {plunge}, false), HasSubstr("\n| speed | 1 | 1 | 1 | 0 | 2 |"));
  EXPECT_THAT(with_rows(both, {plunge}, true),
              AllOf(HasSubstr("\n| speed | 1 | 1 | 1 | 0 | 2 |"), Not(HasSubstr("walk"))));
  EXPECT_THROW(static_cast<void>(with_rows("no mark", {plunge}, false)), std::runtime_error);
}

}  // namespace
}  // namespace splash::detection
