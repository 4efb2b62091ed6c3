// SPDX-License-Identifier: MIT
// When a body that was in the water may make its next impact, as logic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim-server/detect/impact_stories.hpp"

namespace splash::sim {
namespace {

TEST(Again, AfterComingOut) {
  const auto twice = path(0.1, {{0.2, -0.1}, {0.4, 0.1}, {0.6, -0.1}, {0.8, 0.1}, {1.0, -0.1}});
  const auto all = watch(twice, 1.2);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_NEAR(all[0].impact.time, 0.1, 1.0e-5);
  EXPECT_NEAR(all[1].impact.time, 0.5, 1.0e-5);
  EXPECT_NEAR(all[2].impact.time, 0.9, 1.0e-5);
}

// Up to the release distance it has not come out; a little beyond, it has.
TEST(Again, OnlyBeyondTheReleaseGap) {
  const DetectSettings settings;
  for (const double beyond : {-0.002, 0.002}) {
    const double top = settings.impact_release + beyond;
    const auto all = watch(path(0.1, {{0.2, -0.1}, {0.4, top}, {0.6, -0.1}}), 1.0);
    EXPECT_EQ(all.size(), beyond > 0.0 ? 2U : 1U) << beyond;
  }
}

/// Goes back by 3 cm 20 cm under water, which stays 2 cm behind but for thin water, and on again.
Story through_a_wake(double thin, double ahead) {
  return [thin, ahead](double time) {
    Scenery at = path(0.1, {{0.3, -0.2}, {0.4, -0.17}, {0.6, -0.5}})(time);
    const bool wake = time > 0.31 && time < 0.42;
    if (!wake) return at;
    at.level = at.underside - 0.02;
    at.thin = thin;
    at.ahead = ahead;
    return at;
  };
}

// Thin water with matter behind it is water: skin that it wets has not come out. With none it is a
// film.
TEST(Again, NotAfterThinWater) {
  EXPECT_EQ(watch(through_a_wake(0.0, 1.0), 0.7).size(), 2U);
  EXPECT_EQ(watch(through_a_wake(0.02, 1.0), 0.7).size(), 1U);
  EXPECT_EQ(watch(through_a_wake(0.02, 0.0), 0.7).size(), 2U);
}

TEST(Again, AfterEasingInAndComingOut) {
  const auto all = watch(path(0.03, {{1.5, -0.01}, {1.8, 0.1}, {2.0, -0.1}}), 2.5);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].impact.time, 1.9, 1.0e-5);
}

TEST(Again, NotForABodyThatStartsInTheWaterBeforeItLeft) {
  const auto all = watch(path(-0.1, {{0.2, -0.02}, {0.4, -0.2}, {0.7, 0.1}, {0.9, -0.1}}), 1.2);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].impact.time, 0.8, 1.0e-5);
}

/// Plunges to 10 cm, opens a cavity for a while, then goes on into the water that comes back.
Story through_a_cavity(double closes) {
  return [closes](double time) {
    Scenery at = path(0.1, {{0.2, -0.1}, {closes - 0.005, -0.1}, {closes + 0.195, -0.3}})(time);
    if (time > 0.15 && time < closes) {
      at.water = false;  // around it; beneath it comes back with the body on its way down
    } else if (time >= closes) {
      at.level = -0.1;
    }
    return at;
  };
}

TEST(Again, NotInItsOwnCavity) {
  const auto all = watch(through_a_cavity(0.5), 1.0);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].impact.time, 0.1, 1.0e-5);
}

// The water may sink below a body instead: after half a second it is dry.
TEST(Again, AfterTheWaterHasLongSunk) {
  EXPECT_EQ(watch(through_a_cavity(1.0), 1.5).size(), 2U);
}

// One that comes down tilted is led by a few of its points: it stays in its cavity, too.
TEST(Again, NotInItsOwnCavityWhenTilted) {
  const auto all = live_through(0.45, [](double time) {
    std::vector<SurfacePoint> points;
    const bool cavity = time > 0.15 && time < 0.40;
    const Scenery at = {.underside = std::max(0.1 - time, -0.1),
                        .speed = time < 0.2 ? -1.0 : -0.0,
                        .water = !cavity};
    add_body(points, 0, at);
    for (std::size_t i = 0; i < points.size(); ++i) {  // 30 degrees about y
      const double rise = 0.58 * static_cast<double>(points[i].touch.x);
      Scenery higher = at;
      higher.underside += rise;
      std::vector<SurfacePoint> one;
      add_body(one, 0, higher);
      points[i].touch.z = one[i].touch.z;
      points[i].touch.colour = one[i].touch.colour;
      points[i].touch.gz = one[i].touch.gz;
    }
    return points;
  });
  EXPECT_EQ(all.size(), 1U);
}

/// Impacts of a body with a step in its underside, 5 cm high.
std::size_t impacts_of_a_step(const Story& story, double seconds) {
  const auto all = live_through(seconds, [&](double time) {
    std::vector<SurfacePoint> points;
    Scenery at = story(time);
    add_body(points, 0, at);
    at.underside += 0.05;
    add_body(points, 0, at);
    return points;
  });
  return all.size();
}

// Each part of a body counts by itself: while the lower half is in, the upper half is heard.
TEST(Again, ForAnotherPartOfABodyThatIsPartlyIn) {
  EXPECT_EQ(impacts_of_a_step(path(0.1, {{0.2, -0.02}, {1.0, -0.02}, {1.2, -0.2}}), 1.5), 2U);
  EXPECT_EQ(impacts_of_a_step(path(0.02, {{1.0, -0.01}, {1.2, -0.2}}), 1.5), 1U);
  EXPECT_EQ(impacts_of_a_step(path(-0.01, {{1.0, -0.01}, {1.2, -0.2}}), 1.5), 1U);
}

// Both halves at once are one blow.
TEST(Again, NotForTheRestOfABlowThatGoesOn) {
  EXPECT_EQ(impacts_of_a_step(path(0.1, {{0.05, -0.2}}), 1.0), 1U);  // 6 m/s
}

// A heel comes out of the water while the ball stays in, and slaps back: it need not rise above
// anything but the water.
TEST(Again, ForTheHeelOfAFootThatStaysIn) {
  ImpactWatch watch({2.0 * kUnderside}, {}, surface_distance());
  const auto heel = path(-0.02, {{0.3, -0.02}, {0.5, 0.03}, {0.6, -0.02}, {0.9, -0.02}});
  const auto told = live_through(watch, 1.0, [&](double time) {
    std::vector<SurfacePoint> points;
    add_body(points, 0, heel(time));
    add_body(points, 0, {.underside = -0.02});
    return points;
  });
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NEAR(told[0].impact.time, 0.56, 1.0e-3);
  EXPECT_NEAR(told[0].impact.approach, 0.5, 1.0e-6);
}

// Patting: a palm that leaves the water by 2 cm, four times a second.
TEST(Again, ForEachPat) {
  const auto pat = [](double time) {
    const double turn = 8.0 * 3.14159265 * time;
    return Scenery{.underside = 0.01 + 0.015 * std::cos(turn),
                   .speed = -0.015 * 8.0 * 3.14159265 * std::sin(turn)};
  };
  EXPECT_EQ(watch(pat, 2.0).size(), 8U);
}

}  // namespace
}  // namespace splash::sim
