// SPDX-License-Identifier: MIT
// Air that bodies take down, against the integral of the law, by hand-made skins and water.
#include "sim-server/detect/wake_air.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/detect/cavity_laws.hpp"
#include "tests/sim-server/detect/impact_stories.hpp"

namespace splash::sim {
namespace {

constexpr double kGravity = 9.81;    ///< [m/s2]
constexpr double kDensity = 1000.0;  ///< [kg/m3]
constexpr double kDrag = 1.1;        ///< C_d of a disc [1]

struct Taken {
  double air = 0.0;   ///< [m3]
  double work = 0.0;  ///< [J]
};

/// Lives through a story and shows the air of each frame. `cosine`: of how far the skin looks
/// askew, for its wake.
template <class Show>
void live(const Story& story, double seconds, const DetectSettings& settings, const Show& show,
          double cosine = 1.0) {
  ImpactWatch watch({kUnderside}, settings, surface_distance());
  Wakes wakes(kGravity, kDensity, 1000);
  for (int k = 0; k * kStoryFrame < seconds; ++k) {
    const double time = k * kStoryFrame;
    std::vector<SurfacePoint> points;
    add_body(points, 0, story(time));
    static_cast<void>(watch.observe(time, kStoryFrame, points));
    for (SurfacePoint& point : points) point.touch.nz = static_cast<float>(-cosine);
    show(time, wakes.observe(time, kStoryFrame, points, watch, settings));
  }
}

Taken taken(const Story& story, double seconds, const DetectSettings& settings = {}) {
  Taken sum;
  live(story, seconds, settings, [&](double, const WakeAir& air) {
    for (const AirFold& fold : air.folds) sum.air += kStoryFrame * static_cast<double>(fold.rate);
    sum.work += air.work;
  });
  return sum;
}

/// At constant speed from 5 cm above the water until `stop` [m].
Story plunge(double speed, double stop = -9.0) {
  const double begins = 0.0013;  // never on a frame [s]
  return [=](double time) {
    const double height = 0.05 - speed * (time - begins);
    return Scenery{.underside = std::max(height, stop), .speed = height > stop ? -speed : 0.0};
  };
}

/// How long the hollow behind the underside is open [s].
double closes_after() {
  return closing_time(std::sqrt(kUnderside / std::numbers::pi), kGravity);
}

/// What the law gives an underside that goes on [m3].
double law(double speed, const DetectSettings& settings = {}) {
  const double least = 3.0 * settings.bubble_onset;
  return settings.bubble_drag * kDrag * kUnderside * (speed * speed - least * least) / kGravity;
}

class WakeOf : public ::testing::TestWithParam<double> {};

TEST_P(WakeOf, AFlatPlungeHoldsAsMuchAirAsTheLaw) {
  const double speed = GetParam();
  const Taken all = taken(plunge(speed), 0.05 / speed + 3.0 * closes_after());
  EXPECT_NEAR(all.air, law(speed), 0.02 * law(speed));
  // The share eta of the work lifts it from u t_p / 2 on average.
  const double lift = kDensity * kGravity * 0.5 * speed * closes_after();
  EXPECT_NEAR(all.air * lift, DetectSettings{}.bubble_drag * all.work, 1e-6 * all.work);
}

TEST_P(WakeOf, AStrokeThatEndsHoldsItsPart) {
  const double speed = GetParam();
  const Taken part = taken(plunge(speed, -0.25 * speed * closes_after()), 0.6);
  EXPECT_NEAR(part.air / law(speed), 0.25, 1.0 * kStoryFrame / closes_after());
}

INSTANTIATE_TEST_SUITE_P(Speeds, WakeOf, ::testing::Values(0.4, 1.0, 2.0, 5.0));

/// With what a body at 1 m/s takes down in a frame, once its skin looks so far askew: the cosine.
double work_of(double cosine) {
  double work = 0.0;
  const auto last = [&](double, const WakeAir& air) { work = air.work; };
  live(plunge(1.0), 0.098, {.bubble_onset = 0.0}, last, cosine);
  return work;
}

// Of a sphere the square of the cosine counts: half a disc's.
TEST(Wake, OfSkinAskewIsByTheCubeOfItsNormalSpeed) {
  EXPECT_NEAR(work_of(1.0), 0.5 * kDrag * kDensity * kUnderside * kStoryFrame, 1e-5);
  EXPECT_NEAR(work_of(0.8) / work_of(1.0), 0.512, 1e-5);
}

// The hollow collapses before its air breaks up.
TEST(Wake, BreaksUpWhereItWasTakenHalfAClosingTimeLater) {
  const double enters = 0.0513;
  double first = 0.0;
  double last = 0.0;
  live(plunge(1.0), 0.598, {}, [&](double time, const WakeAir& air) {
    for (const AirFold& fold : air.folds) {
      if (first == 0.0) first = time;
      last = time;
      const double taken = time - 0.5 * closes_after();
      EXPECT_NEAR(static_cast<double>(fold.z), enters - taken, 2.0 * kStoryFrame);
      EXPECT_GE(fold.id, 1000);
      EXPECT_LT(fold.id, 1016);
    }
  });
  EXPECT_NEAR(first - enters, 0.5 * closes_after(), 2.0 * kStoryFrame);
  EXPECT_NEAR(last - enters, 1.5 * closes_after(), 2.0 * kStoryFrame);
}

TEST(Wake, HoldsNothingOfASlowBodyNorOfOneThatComesOut) {
  EXPECT_EQ(taken(plunge(0.29), 0.6).air, 0.0);
  EXPECT_GT(taken(plunge(0.35), 0.6).air, 0.0);
  EXPECT_EQ(
      taken([](double time) { return Scenery{.underside = -0.1 + time, .speed = 1.0}; }, 0.5).air,
      0.0);
}

TEST(Wake, NeedsSkinThatCameFromTheAir) {
  EXPECT_EQ(
      taken([](double time) { return Scenery{.underside = -0.1 - time, .speed = -1.0}; }, 0.5).air,
      0.0)
      << "under water from the beginning";
}

// Two pats hold twice the air of one: skin that was out of the water counts anew.
TEST(Wake, IsThereAgainWithEachEntry) {
  const auto pats = [](int count) {
    return path(0.05, count == 1 ? std::vector<Leg>{{0.1, -0.05}, {0.9, 0.05}, {1.9, 0.05}}
                                 : std::vector<Leg>{{0.1, -0.05}, {0.9, 0.05}, {1.0, -0.05}});
  };
  EXPECT_NEAR(taken(pats(2), 1.2).air, 2.0 * taken(pats(1), 1.2).air,
              0.1 * taken(pats(1), 1.2).air);
}

// Water that comes along is not gone through.
TEST(Wake, IsRelativeToTheWaterAsItWasBefore) {
  const auto falling = [](double flow) {
    return [flow](double time) {
      return Scenery{.underside = 0.05 - time, .speed = -1.0, .level = flow * time, .flow = flow};
    };
  };
  const double still = taken(falling(0.0), 0.6).air;
  EXPECT_NEAR(taken(falling(-0.5), 0.6).air / still, (0.25 - 0.09) / (1.0 - 0.09), 0.02);
}

TEST(Wake, IsNoneWithoutAShare) {
  EXPECT_EQ(taken(plunge(1.0), 0.6, {.bubble_drag = 0.0}).air, 0.0);
}

}  // namespace
}  // namespace splash::sim
