// SPDX-License-Identifier: MIT
// When a body makes an impact and when it makes none, as logic.
#include "sim-server/detect/impacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim-server/detect/impact_stories.hpp"

namespace splash::sim {
namespace {

class Plunge : public ::testing::TestWithParam<double> {};

TEST_P(Plunge, IsOneImpactAtItsMomentAndSpeed) {
  const double speed = GetParam();
  const double meets = 0.0613 + 0.1 / speed;  // never on a frame
  const auto all = watch(
      [&](double time) {
        const double depth = std::min(speed * (time - meets), 0.3);
        return Scenery{
            .underside = -depth, .speed = depth < 0.3 ? -speed : 0.0, .drift = 0.75 * speed};
      },
      meets + 0.5);
  ASSERT_EQ(all.size(), 1U);
  const DetectedImpact& impact = all[0].impact;
  EXPECT_NEAR(impact.time, meets, 2.0e-4 * kSpacing / speed + 1.0e-6);
  EXPECT_NEAR(impact.speed, 1.25 * speed, 1.0e-6);
  EXPECT_NEAR(impact.approach, speed, 1.0e-6);
  EXPECT_EQ(impact.body, 0);
}

// protocol::Impact: where the surfaces meet, not where the body is when that is told.
TEST_P(Plunge, IsPlacedWhereTheSurfacesMeet) {
  const double speed = GetParam();
  const double meets = 0.0613 + 0.1 / speed;
  const auto all = watch(
      [&](double time) { return Scenery{.underside = speed * (meets - time), .speed = -speed}; },
      meets + 0.1);
  ASSERT_EQ(all.size(), 1U);
  const Vector3& place = all[0].impact.position;
  EXPECT_GE(place[0], -1.0e-6);
  EXPECT_LE(place[0], 0.06 + 1.0e-6);
  EXPECT_GE(place[1], -1.0e-6);
  EXPECT_LE(place[1], 0.06 + 1.0e-6);
  EXPECT_NEAR(place[2], 0.0, 1.0e-3);
}

// Said in the first frame from which the meeting is no farther than the look-ahead.
TEST_P(Plunge, IsAnnouncedAhead) {
  const double speed = GetParam();
  const double meets = 0.0613 + 0.1 / speed;
  const auto all = watch(
      [&](double time) { return Scenery{.underside = speed * (meets - time), .speed = -speed}; },
      meets + 0.1);
  ASSERT_EQ(all.size(), 1U);
  const DetectSettings settings;
  EXPECT_LE(all[0].impact.time, all[0].at + settings.impact_lookahead);
  // As soon as the water is seen (1.2 spacings) or within the look-ahead, whichever is later.
  const double seen = (1.2 * kSpacing) / speed;
  const double ahead = std::min(settings.impact_lookahead, seen);
  EXPECT_GT(all[0].impact.time, all[0].at + ahead - kFrame - 1.0e-5);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Plunge, ::testing::Values(0.06, 0.3, 1.0, 2.0, 4.0));

// Not seen before it is in the water: the moment is within the last frame, and right as long as the
// colour tells depths apart, to half a spacing.
TEST(FastBody, IsTimedWithinTheFrame) {
  for (const double part : {0.05, 0.2, 0.4, 0.6, 0.8, 0.95}) {
    const double speed = 12.0;  // 48 mm per frame, seen from 28 mm on
    const double meets = 5.0 * kFrame + part * kFrame;
    const auto all = watch(
        [&](double time) { return Scenery{.underside = speed * (meets - time), .speed = -speed}; },
        0.2);
    ASSERT_EQ(all.size(), 1U) << part;
    EXPECT_GE(all[0].impact.time, all[0].at - kFrame);
    const double deepest = (kSpacing / 2.0) / speed;
    const double in_for = 6.0 * kFrame - meets;
    if (in_for < deepest) {
      EXPECT_NEAR(all[0].impact.time, meets, 1.0e-5) << part;
    } else {
      EXPECT_NEAR(all[0].impact.time, meets, in_for - deepest + 1.0e-5) << part;
    }
    EXPECT_NEAR(all[0].impact.speed, speed, 1.0e-5);
  }
}

TEST(NoImpact, FromABodyThatStands) {
  // Water that sloshes up to it, around it and away again.
  const auto slosh = [](double time) {
    const double turn = 6.0 * time;
    return Scenery{.underside = 0.0, .level = 0.05 * std::sin(turn), .flow = 0.3 * std::cos(turn)};
  };
  EXPECT_TRUE(watch(slosh, 5.0).empty());
  EXPECT_TRUE(watch([](double) { return Scenery{.underside = 0.001}; }, 1.0).empty());
}

// Slower than the least speed into the water, and later as fast as you like.
TEST(NoImpact, FromABodyThatEasesIn) {
  const auto slowly = path(0.05, {{2.0, -0.01}, {2.5, -0.2}});  // 3 cm/s, then 38
  EXPECT_TRUE(watch(slowly, 3.0).empty());
}

TEST(NoImpact, OnWaterThatTheBodyCarries) {
  // A film keeps its distance and moves with the body, down and up.
  const auto carried = [](double time) {
    const double speed = -0.8 * std::sin(8.0 * time);
    const double height = 0.5 + 0.1 * std::cos(8.0 * time);
    // It is there from half a second on; at first the body is dry.
    return Scenery{.underside = height,
                   .speed = speed,
                   .level = height - 0.002 - 0.001 * std::sin(50.0 * time),
                   .flow = speed,
                   .water = time > 0.5};
  };
  EXPECT_TRUE(watch(carried, 3.0).empty());
}

TEST(NoImpact, OnWaterThatFlees) {
  const auto chase = [](double time) {
    return Scenery{
        .underside = 0.02 - time, .speed = -1.0, .level = 0.01 - 0.8 * time, .flow = -0.8};
  };
  EXPECT_TRUE(watch(chase, 0.3).empty());
}

TEST(NoImpact, FromABodyThatRises) {
  const auto rise = [](double time) { return Scenery{.underside = 0.001 + time, .speed = 1.0}; };
  EXPECT_TRUE(watch(rise, 0.5).empty());
}

// A foot that slides along the water, however fast, does not hit it.
TEST(NoImpact, FromABodyThatSkims) {
  const auto slide = [](double drift) {
    return [drift](double time) {
      return Scenery{.underside = 0.05 - 0.1 * time, .speed = -0.1, .drift = drift};
    };
  };
  EXPECT_TRUE(watch(slide(4.0), 1.0).empty());
  EXPECT_EQ(watch(slide(0.1), 1.0).size(), 1U);
}

TEST(NoImpact, WithoutWater) {
  const auto fall = [](double time) {
    return Scenery{.underside = 0.3 - time, .speed = -1.0, .water = false};
  };
  EXPECT_TRUE(watch(fall, 1.0).empty());
}

TEST(Bodies, AreWatchedEachForItself) {
  const std::vector<Story> bodies = {path(0.1, {{0.2, -0.1}}), path(-0.1, {{0.5, 0.1}}),
                                     path(0.2, {{0.2, -0.1}, {0.4, 0.1}, {0.6, -0.1}})};
  const auto all = watch(bodies, 1.0);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].impact.body, 0);
  EXPECT_NEAR(all[0].impact.time, 0.1, 1.0e-5);
  EXPECT_EQ(all[1].impact.body, 2);
  EXPECT_NEAR(all[1].impact.time, 0.2 * 2.0 / 3.0, 1.0e-5);
  EXPECT_EQ(all[2].impact.body, 2);
  EXPECT_NEAR(all[2].impact.time, 0.5, 1.0e-5);
}

TEST(Settings, OfSpeedAndLookAheadCount) {
  const auto fall = path(0.1, {{0.5, -0.1}});  // 0.4 m/s
  DetectSettings settings;
  settings.impact_speed = 0.41;
  EXPECT_TRUE(watch(fall, 1.0, settings).empty());
  settings.impact_speed = 0.39;
  settings.impact_lookahead = 0.030;
  const auto all = watch(fall, 1.0, settings);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_GT(all[0].impact.time, all[0].at + 0.020);
}

// Nothing is told before it happens.
TEST(Settings, OfNoLookAheadMeansAfterwards) {
  DetectSettings settings;
  settings.impact_lookahead = 0.0;
  const auto all = watch(path(0.1, {{0.5, -0.1}}), 1.0, settings);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_LE(all[0].impact.time, all[0].at);
  EXPECT_NEAR(all[0].impact.time, 0.25, 1.0e-5);
}

}  // namespace
}  // namespace splash::sim
