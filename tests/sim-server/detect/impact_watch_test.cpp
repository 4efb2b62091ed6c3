// SPDX-License-Identifier: MIT
// When a body makes an impact and when it makes none, as logic: bodies and water by hand.
#include "sim-server/detect/impacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

#include "sim-server/fluid/wendland.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.02;
constexpr double kFrame = 0.004;

SurfaceDistance surface_distance() {
  // Layer weight of a cubic lattice with support 2 spacings: its colour is 1 in the depth.
  double sum = 0.0;
  for (int k = -2; k <= 2; ++k) sum += plane_marginal(k * kSpacing, 2.0 * kSpacing);
  return {kSpacing, 2.0 * kSpacing, 1.0 / sum};
}

/// A flat underside of 4 x 4 points over flat water, both level: heights and vertical speeds.
struct Scenery {
  double underside = 0.1;  ///< of the body [m]
  double speed = 0.0;      ///< of the body, upwards [m/s]
  double level = 0.0;      ///< of the water [m]
  double flow = 0.0;       ///< of the water, upwards [m/s]
  double drift = 0.0;      ///< of the body, sideways [m/s]
  bool water = true;       ///< any there at all
};

void add_body(std::vector<SurfacePoint>& points, int body, const Scenery& at) {
  const SurfaceDistance distance = surface_distance();
  for (int k = 0; k < 16; ++k) {
    SurfacePoint point;
    point.body = body;
    const double gap = at.underside - at.level;
    const bool any = at.water && gap < distance.farthest();
    point.touch.colour = any ? static_cast<float>(distance.colour_at(gap)) : 0.0F;
    point.touch.gz = any ? -30.0F : 0.0F;
    point.touch.x = 0.02F * static_cast<float>(k % 4);
    point.touch.y = 0.02F * static_cast<float>(k / 4);
    point.touch.z = static_cast<float>(at.underside);
    point.touch.u = static_cast<float>(at.drift);
    point.touch.w = static_cast<float>(at.speed);
    point.touch.water_w = any ? static_cast<float>(at.flow) : 0.0F;
    points.push_back(point);
  }
}

struct Announced {
  double at = 0.0;  ///< when it was said [s]
  DetectedImpact impact;
};

using Story = std::function<Scenery(double)>;

/// Lives through the stories of all bodies, frame by frame.
std::vector<Announced> watch(const std::vector<Story>& bodies, double seconds,
                             const DetectSettings& settings = {}, double frame = kFrame) {
  ImpactWatch watch(bodies.size(), settings, surface_distance());
  std::vector<Announced> all;
  for (int k = 0; k * frame < seconds; ++k) {
    const double time = k * frame;
    std::vector<SurfacePoint> points;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      add_body(points, static_cast<int>(b), bodies[b](time));
    }
    for (const DetectedImpact& impact : watch.observe(time, frame, points)) {
      all.push_back({time, impact});
    }
  }
  return all;
}

std::vector<Announced> watch(const Story& body, double seconds, const DetectSettings& settings = {},
                             double frame = kFrame) {
  return watch(std::vector<Story>{body}, seconds, settings, frame);
}

/// A body at constant speed from one height to another; stays there.
struct Leg {
  double until = 0.0;   ///< [s]
  double height = 0.0;  ///< at its end [m]
};

Story path(double from, std::vector<Leg> legs) {
  return [from, legs = std::move(legs)](double time) {
    double start = 0.0;
    double height = from;
    for (const Leg& leg : legs) {
      if (time < leg.until) {
        const double speed = (leg.height - height) / (leg.until - start);
        return Scenery{.underside = height + speed * (time - start), .speed = speed};
      }
      start = leg.until;
      height = leg.height;
    }
    return Scenery{.underside = height};
  };
}

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
  // As soon as the water is seen (1.4 spacings) or within the look-ahead, whichever is later.
  const double seen = (1.4 * kSpacing) / speed;
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
  ImpactWatch watch(1, {}, surface_distance());
  int impacts = 0;
  for (int k = 0; k * kFrame < 0.45; ++k) {
    const double time = k * kFrame;
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
    impacts += static_cast<int>(watch.observe(time, kFrame, points).size());
  }
  EXPECT_EQ(impacts, 1);
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
