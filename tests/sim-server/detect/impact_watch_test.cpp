// SPDX-License-Identifier: MIT
// When a body makes an impact and when it makes none, as logic.
#include "sim-server/detect/impacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/detect/added_mass.hpp"
#include "tests/sim-server/detect/impact_stories.hpp"

namespace splash::sim {
namespace {

/// A body that goes down at `speed`, and meets the water's level at `meets`.
auto falling(double speed, double meets) {
  return [=](double time) { return Scenery{.underside = speed * (meets - time), .speed = -speed}; };
}

class Plunge : public ::testing::TestWithParam<double> {
 protected:
  /// The only one there is.
  static Announced told(const Story& story, double seconds, double nearer = 0.0) {
    const auto all = watch(story, seconds, {}, nearer);
    EXPECT_EQ(all.size(), 1U);
    return all.at(0);
  }
  Announced told(double nearer = 0.0) const {
    return told(falling(speed_, meets_), meets_ + 0.1, nearer);
  }

  double speed_ = GetParam();
  double meets_ = 0.0613 + 0.1 / speed_;  ///< never on a frame
};

TEST_P(Plunge, IsOneImpactAtItsMomentAndSpeed) {
  const auto stops = [this](double time) {
    const double depth = std::min(speed_ * (time - meets_), 0.3);
    return Scenery{
        .underside = -depth, .speed = depth < 0.3 ? -speed_ : 0.0, .drift = 0.75 * speed_};
  };
  const DetectedImpact impact = told(stops, meets_ + 0.5).impact;
  EXPECT_NEAR(impact.time, meets_, 2.0e-4 * kSpacing / speed_ + 1.0e-6);
  EXPECT_NEAR(impact.speed, 1.25 * speed_, 1.0e-6);
  EXPECT_NEAR(impact.approach, speed_, 1.0e-6);
  EXPECT_EQ(impact.body, 0);
  // All of the underside at once: the momentum of the water that it drags along.
  EXPECT_NEAR(impact.momentum, speed_ * added_mass(kUnderside, 1.0), 0.01 * impact.momentum);
  EXPECT_NEAR(impact.area, kUnderside, 1.0e-9);
  EXPECT_NEAR(impact.rise, 0.001, 1.0e-9);
}

// protocol::Impact: where the surfaces meet, not where the body is when that is told.
TEST_P(Plunge, IsPlacedWhereTheSurfacesMeet) {
  const Vector3 place = told().impact.position;
  EXPECT_GE(place[0], -1.0e-6);
  EXPECT_LE(place[0], 0.06 + 1.0e-6);
  EXPECT_GE(place[1], -1.0e-6);
  EXPECT_LE(place[1], 0.06 + 1.0e-6);
  EXPECT_NEAR(place[2], 0.0, 1.0e-3);
}

// Where the surface lies farther off than its colour tells, they meet later, and deeper.
TEST_P(Plunge, IsLaterWhereTheSurfaceIsFarther) {
  const double nearer = 0.2 * kSpacing;
  const auto [at, impact] = told(nearer);
  EXPECT_NEAR(impact.time, meets_ + nearer / speed_, 2.0e-4 * kSpacing / speed_ + 1.0e-6);
  EXPECT_NEAR(impact.position[2], -nearer, 1.0e-3);
  EXPECT_LE(at, meets_) << "an impact is never reported later than the surfaces meet";
}

// Said in the first frame from which the meeting is no farther than the look-ahead.
TEST_P(Plunge, IsAnnouncedAhead) {
  const auto [at, impact] = told();
  const DetectSettings settings;
  EXPECT_LE(impact.time, at + settings.impact_lookahead);
  // As soon as the water is seen (1.2 spacings) or within the look-ahead, whichever is later.
  const double seen = (1.2 * kSpacing) / speed_;
  const double ahead = std::min(settings.impact_lookahead, seen);
  EXPECT_GT(impact.time, at + ahead - kStoryFrame - 1.0e-5);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Plunge, ::testing::Values(0.06, 0.3, 1.0, 2.0, 4.0));

// Not seen before it is in the water: the moment is within the last frame, and right as long as the
// colour tells depths apart, to half a spacing.
TEST(FastBody, IsTimedWithinTheFrame) {
  for (const double part : {0.05, 0.2, 0.4, 0.6, 0.8, 0.95}) {
    const double speed = 12.0;  // 48 mm per frame, seen from 28 mm on
    const double meets = 5.0 * kStoryFrame + part * kStoryFrame;
    const auto all = watch(falling(speed, meets), 0.2);
    ASSERT_EQ(all.size(), 1U) << part;
    EXPECT_GE(all[0].impact.time, all[0].at - kStoryFrame);
    const double deepest = (kSpacing / 2.0) / speed;
    const double in_for = 6.0 * kStoryFrame - meets;
    if (in_for < deepest) {
      EXPECT_NEAR(all[0].impact.time, meets, 1.0e-5) << part;
    } else {
      EXPECT_NEAR(all[0].impact.time, meets, in_for - deepest + 1.0e-5) << part;
    }
    EXPECT_NEAR(all[0].impact.speed, speed, 1.0e-5);
  }
}

// Once in sight the water may begin to give way to the body. A drop is seen before the water is,
// and falls as fast as the body.
TEST(Entry, IsIntoTheWaterAsItWasBefore) {
  ImpactWatch watch({kUnderside}, {}, surface_distance());
  live_through(watch, 0.2, [](double time) {
    const double height = 0.1 - time;
    std::vector<SurfacePoint> points;
    const bool drop = height > 1.05 * kSpacing;
    add_body(points, 0,
             {.underside = height,
              .speed = -1.0,
              .level = drop ? height - 0.01 : 0.0,
              .flow = drop                       ? -1.0
                      : height > 0.85 * kSpacing ? 0.1
                                                 : 0.3,
              .ahead = drop ? 0.0 : 1.0});
    return points;
  });
  ASSERT_TRUE(watch.entry(0));
  EXPECT_NEAR(watch.entry(0)->water[2], 0.1, 1.0e-6);
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

// A plate knows the speed along its normal only: a glancing slap is one of that speed.
TEST(Glancing, SlapsAreThoseOfTheirNormalSpeed) {
  const auto slap = [](double drift) {
    return watch(
        [drift](double time) {
          return Scenery{.underside = 0.05 - 0.2 * time, .speed = -0.2, .drift = drift};
        },
        1.0);
  };
  const auto straight = slap(0.0);
  ASSERT_EQ(straight.size(), 1U);
  for (const double drift : {1.0, 2.1, 4.0}) {
    const auto glancing = slap(drift);
    ASSERT_EQ(glancing.size(), 1U) << drift;
    EXPECT_NEAR(glancing[0].impact.momentum, straight[0].impact.momentum, 1.0e-6);
    EXPECT_NEAR(glancing[0].impact.approach, 0.2, 1.0e-6);
    EXPECT_NEAR(glancing[0].impact.speed, std::hypot(0.2, drift), 1.0e-6);
  }
}

/// Impacts of an underside that goes along at 3 m/s and down at 1, its leading edge up by so many
/// degrees, with a level corner of a fiftieth of its area.
std::vector<Announced> of_a_sole(double degrees) {
  const double turn = degrees * 3.14159265 / 180.0;
  return live_through(0.1, [turn](double time) {
    std::vector<SurfacePoint> points;
    add_body(points, 0, {.underside = 0.05 - time, .speed = -1.0, .drift = 3.0});
    for (SurfacePoint& point : points) {
      point.touch.nx = static_cast<float>(std::sin(turn));
      point.touch.nz = static_cast<float>(-std::cos(turn));
    }
    points.push_back(points.front());
    points.back().area = kUnderside / 50.0;
    points.back().touch.nx = 0.0F;
    points.back().touch.nz = -1.0F;
    return points;
  });
}

// With its toe up, the sole planes: it presses harder than it sinks. With its toe down it goes back
// along its normal and leaves a hollow, and the corner alone is too little.
TEST(Glancing, SolesPressByTheirNormalSpeed) {
  const auto level = of_a_sole(0.0);
  const auto planing = of_a_sole(10.0);
  ASSERT_EQ(level.size(), 1U);
  ASSERT_EQ(planing.size(), 1U);
  EXPECT_NEAR(planing[0].impact.approach, level[0].impact.approach, 1.0e-6);
  const double turn = 10.0 * 3.14159265 / 180.0;
  const double mass = std::pow(std::cos(turn), 1.5);  // of the projected face
  EXPECT_NEAR(planing[0].impact.momentum / level[0].impact.momentum,
              (1.0 + 3.0 * std::tan(turn)) * mass, 0.05);
  EXPECT_TRUE(of_a_sole(-30.0).empty());
}

// A turned-up corner goes first, and ploughs at 4.6 m/s along its normal; the sole that follows
// sinks at 1 m/s. Each part of the skin gives the water its own speed.
TEST(Glancing, MomentumIsThatOfAllSkinNotOfTheFirstToMeet) {
  const double turn = 50.0 * 3.14159265 / 180.0;
  const auto all = live_through(0.1, [turn](double time) {
    const double corner = 0.04 - time;
    std::vector<SurfacePoint> points;
    add_body(points, 0, {.underside = corner + 0.012, .speed = -1.0, .drift = 3.0});
    std::vector<SurfacePoint> first;
    add_body(first, 0, {.underside = corner, .speed = -1.0, .drift = 3.0});
    points.push_back(first.back());
    points.back().area = kUnderside / 50.0;
    points.back().touch.nx = static_cast<float>(std::sin(turn));
    points.back().touch.nz = static_cast<float>(-std::cos(turn));
    return points;
  });
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].impact.time, 0.04, 1.0e-3);
  const double plough =
      (3.0 * std::sin(turn) + std::cos(turn)) / 50.0;                  // its speed times its share
  const double mean = (1.0 + plough) / (1.0 + std::cos(turn) / 50.0);  // [m/s]
  EXPECT_NEAR(all[0].impact.momentum / added_mass(kUnderside, 1.0), mean, 0.1);
}

TEST(NoImpact, FromABodyThatSlidesAlongTheWater) {
  const auto slide = [](double time) {
    return Scenery{.underside = 0.0, .speed = 0.02 * std::sin(20.0 * time), .drift = 3.0};
  };
  EXPECT_TRUE(watch(slide, 2.0).empty());
}

// A drop or a sheet has a surface, but no water behind it; and closes nothing: the plunge that
// follows is told.
TEST(NoImpact, OnADropOrASheet) {
  const auto falls = [](double ahead) {
    return [ahead](double time) {
      const double height = 0.3 - 0.3 * time;
      const bool drop = time < 0.5;  // it hangs 15 cm above the water, and is gone then
      return Scenery{.underside = height,
                     .speed = -0.3,
                     .level = drop ? 0.2 : 0.0,
                     .ahead = drop ? ahead : 1.0};
    };
  };
  for (const double ahead : {0.0, 0.03}) {
    const auto all = watch(falls(ahead), 1.5);
    ASSERT_EQ(all.size(), 1U) << ahead;
    EXPECT_NEAR(all[0].impact.time, 1.0, 1.0e-3);
  }
  const auto deep = watch(falls(1.0), 0.5);
  ASSERT_EQ(deep.size(), 1U) << "the surface of deep water is one";
  EXPECT_NEAR(deep[0].impact.time, 1.0 / 3.0, 1.0e-3);
}

// Momentum grows with the speed, and no speed counts but that of the surfaces to each other.
TEST(Momentum, IsThatOfTheClosingSpeed) {
  const auto meet = [](double own, double flow) {
    return watch(
        [own, flow](double time) {
          return Scenery{.underside = 0.05 - own * time,
                         .speed = -own,
                         .level = flow * (time - 0.05 / own),
                         .flow = flow};
        },
        0.5);
  };
  for (const double flow : {-0.2, 0.0, 0.2}) {
    const auto all = meet(0.5, flow);
    ASSERT_EQ(all.size(), 1U) << flow;
    EXPECT_NEAR(all[0].impact.momentum, (0.5 + flow) * added_mass(kUnderside, 1.0), 1.0e-6);
  }
}

// DNV-RP-C205: one side of a plate a wide and b long, as a part of pi rho a^2 b / 8.
TEST(AddedMass, IsThatOfThePlatesTable) {
  const double table[][2] = {{1.0, 0.579},  {1.25, 0.642}, {2.0, 0.757},
                             {3.17, 0.840}, {5.0, 0.897},  {10.0, 0.947}};
  for (const auto& [aspect, coefficient] : table) {
    const double width = 0.1;
    const double plate = 1000.0 * 3.14159265 / 8.0 * width * width * (aspect * width);
    EXPECT_NEAR(added_mass(width * width * aspect, aspect), coefficient * plate, 0.015 * plate)
        << aspect;
  }
}

/// A standing body, and waves of that height that leave it and come back.
Story wave(double height) {
  return [height](double time) {
    const double turn = 2.0 * time;
    return Scenery{
        .underside = 0.0, .level = 0.5 * height * std::cos(turn), .flow = -height * std::sin(turn)};
  };
}

TEST(Waves, MakeImpactsWhereTheSceneWantsThem) {
  DetectSettings settings;
  EXPECT_TRUE(watch(wave(0.3), 10.0, settings).empty());
  settings.impact_waves = true;
  const auto all = watch(wave(0.3), 10.0, settings);
  ASSERT_EQ(all.size(), 3U) << "at three quarters of each turn";
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double turn = 3.14159265 * (1.5 + 2.0 * static_cast<double>(k));
    EXPECT_NEAR(all[k].impact.time, turn / 2.0, 0.01);
    EXPECT_NEAR(all[k].impact.approach, 0.3, 0.02);
    EXPECT_EQ(all[k].impact.speed, 0.0);
  }
  // Water that rises more slowly than it would fall over the roughness of its surface, 0.2 m/s
  // here, rises by its weight.
  EXPECT_TRUE(watch(wave(0.15), 10.0, settings).empty());
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
  DetectSettings settings = {.impact_speed = 0.41};
  EXPECT_TRUE(watch(fall, 1.0, settings).empty());
  settings.impact_speed = 0.39;
  settings.impact_lookahead = 0.030;
  const auto all = watch(fall, 1.0, settings);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_GT(all[0].impact.time, all[0].at + 0.020);
}

// Nothing is told before it happens.
TEST(Settings, OfNoLookAheadMeansAfterwards) {
  const DetectSettings settings = {.impact_lookahead = 0.0};
  const auto all = watch(path(0.1, {{0.5, -0.1}}), 1.0, settings);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_LE(all[0].impact.time, all[0].at);
  EXPECT_NEAR(all[0].impact.time, 0.25, 1.0e-5);
}

}  // namespace
}  // namespace splash::sim
