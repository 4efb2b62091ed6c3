// SPDX-License-Identifier: MIT
// Hollows of known form and time behind a hand: which are cavities, and what is told of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/detect/cavity_laws.hpp"
#include "sim-server/detect/pockets.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/tracking/make_motion.hpp"

namespace splash::sim {
namespace {

constexpr double kLevel = 0.4;
constexpr double kSlap = 0.1;  // when its underside meets the level [s]
constexpr double kFrame = 1.0 / 160.0;
constexpr double kSpacing = 0.02;
/// 2.285 sqrt(R / g), R^2 = 0.18 m 0.09 m / pi.
constexpr double kCloses = 0.19549;
/// The water closes over the hollow's lower part; between two frames.
constexpr double kNeck = kSlap + kCloses + 0.4 * kFrame;
constexpr double kNeckHeight = kLevel - 0.1;

struct Story {
  std::string path = "{time: 0, position: [0, 0, 0.52]}, {time: 0.4, position: [0, 0, 0.12]}";
  std::string body = "";  ///< more keys of the hand
  double speed = 1.0;     ///< told of its impact; 0: none [m/s]
  /// Whether there is air below the level at a place, a time, and where the hand's top is [m].
  std::function<bool(const Vector3&, double, double)> hollow;
};

/// The hollow behind the hand as wide as the hand, open above the neck until it closes.
bool shaft(const Vector3& x, double time, double top) {
  if (std::abs(x[0]) > 0.09 || std::abs(x[1]) > 0.045 || x[2] < top) return false;
  return time < kNeck || x[2] < kNeckHeight;
}

struct Told {
  std::vector<DetectedCavity> cavities;
  int readings = 0;  ///< of the water
  std::uint64_t looks = 0;
};

Told tell(const Story& story) {
  const Scene scene = parse_scene(
      "fluid: {spacing: 0.02}\n"
      "tank: {lower: [-0.3, -0.3, 0], upper: [0.3, 0.3, 1]}\n"
      "water: [{lower: [-0.3, -0.3, 0], upper: [0.3, 0.3, 0.4]}]\n"
      "bodies:\n"
      "  - name: hand\n"
      "    shape: {kind: box, size: [0.18, 0.09, 0.04]}\n" +
          story.body + "    motion: {kind: script, smooth: false, keyframes: [" + story.path +
          "]}\n",
      "test scene");
  constexpr double kSupport = 2.5 * kSpacing;
  std::vector<std::unique_ptr<Motion>> motions;
  motions.push_back(make_motion(scene.bodies[0], {}));
  const Bodies bodies(sample_bodies(scene.bodies, kSpacing, kSupport), std::move(motions),
                      kSupport);
  Pockets pockets(scene, sample_skins(scene.bodies, kSpacing), std::pow(kSpacing, 3));
  Told told;
  for (int frame = 1; frame * kFrame < 0.6; ++frame) {
    const double time = frame * kFrame;
    std::vector<DetectedImpact> impacts;
    if (story.speed > 0.0 && time >= kSlap && time - kFrame < kSlap) {
      DetectedImpact impact;
      impact.time = kSlap;
      impact.speed = impact.approach = story.speed;
      impact.momentum = 0.43 * story.speed;
      impact.position = {0.0, 0.0, kLevel};
      impacts.push_back(impact);
    }
    const Vector3 hand = bodies.state(0, time).position;
    const auto read = [&] {
      ++told.readings;
      std::vector<Vector3> water;
      for (int k = 0; k < 20; ++k) {
        for (int j = 0; j < 30; ++j) {
          for (int i = 0; i < 30; ++i) {
            const Vector3 x = {(i - 14.5) * kSpacing, (j - 14.5) * kSpacing, (k + 0.5) * kSpacing};
            const bool in_hand = distance_to(scene.bodies[0].shape, x - hand) < 0.0;
            if (!in_hand && !story.hollow(x, time, hand[2])) water.push_back(x);
          }
        }
      }
      return water;
    };
    for (const DetectedCavity& c : pockets.observe(time, impacts, bodies, read)) {
      told.cavities.push_back(c);
    }
  }
  told.looks = pockets.looks();
  return told;
}

Story plain() {
  Story story;
  story.hollow = shaft;
  return story;
}

TEST(Pockets, AreToldOnceWithTheirAir) {
  const Told told = tell(plain());
  ASSERT_EQ(told.cavities.size(), 1U);
  const DetectedCavity& cavity = told.cavities.front();
  EXPECT_EQ(cavity.body, 0);
  EXPECT_NEAR(cavity.time, kNeck, kFrame);
  // The hand's top is then 4 cm less deep than its underside, which is as deep as it went.
  const double top = kLevel - (kNeck - kSlap) + 0.04;
  const double exact = 0.18 * 0.09 * (kNeckHeight - top);
  std::printf("%.0f ml of air, exact %.0f; centre at %.3f m, exact %.3f\n",
              1e6 * 4.0 / 3.0 * std::numbers::pi * std::pow(cavity.radius, 3), 1e6 * exact,
              cavity.position[2], 0.5 * (kNeckHeight + top));
  EXPECT_NEAR(4.0 / 3.0 * std::numbers::pi * std::pow(cavity.radius, 3) / exact, 1.0, 0.25);
  EXPECT_NEAR(cavity.position[0], 0.0, 0.005);
  EXPECT_NEAR(cavity.position[2], 0.5 * (kNeckHeight + top), 0.01);
  EXPECT_NEAR(cavity.life, ring_life(cavity.radius, kLevel - cavity.position[2], 9.81),
              0.03 * cavity.life);
  EXPECT_GE(cavity.epsilon, 0.002);
  EXPECT_LE(cavity.epsilon, 0.1);
}

TEST(Pockets, CostNothingWithoutAnImpactOfTheirBody) {
  Story story = plain();
  story.speed = 0.0;
  const Told told = tell(story);
  EXPECT_TRUE(told.cavities.empty());
  EXPECT_EQ(told.readings, 0);
  EXPECT_EQ(told.looks, 0U);
}

// u t_p < R + thickness below 0.57 m/s.
TEST(Pockets, NeedSpeed) {
  Story story = plain();
  story.speed = 0.5;
  const Told told = tell(story);
  EXPECT_TRUE(told.cavities.empty());
  EXPECT_EQ(told.looks, 0U);
  story.speed = 0.65;
  EXPECT_EQ(tell(story).cavities.size(), 1U);
}

TEST(Pockets, NeedABodyThatPartsTheWater) {
  Story story = plain();
  story.body = "    cavity: false\n";
  EXPECT_TRUE(tell(story).cavities.empty());
}

// It stops when its underside is 8 cm deep.
TEST(Pockets, NeedDepth) {
  Story story = plain();
  story.path = "{time: 0, position: [0, 0, 0.52]}, {time: 0.18, position: [0, 0, 0.34]}";
  story.hollow = [](const Vector3& x, double time, double top) {
    return shaft(x, time, top) && (time < kNeck || x[2] < kLevel - 0.03);
  };
  const Told told = tell(story);
  EXPECT_TRUE(told.cavities.empty());
}

TEST(Pockets, NeedABodyThatDoesNotComeOut) {
  Story story = plain();
  story.path =
      "{time: 0, position: [0, 0, 0.52]}, {time: 0.28, position: [0, 0, 0.24]}, "
      "{time: 0.6, position: [0, 0, 0.32]}";
  story.hollow = [](const Vector3& x, double time, double top) {
    return shaft(x, time, std::min(top, 0.26));
  };
  EXPECT_TRUE(tell(story).cavities.empty());
}

TEST(Pockets, CloseInTime) {
  for (const double share : {0.5, 1.7}) {
    Story story = plain();
    story.hollow = [share](const Vector3& x, double time, double top) {
      const bool open = time < kSlap + share * kCloses;
      return shaft(x, 0.0, top) && (open || x[2] < kNeckHeight);
    };
    EXPECT_TRUE(tell(story).cavities.empty()) << share;
  }
}

// Water that comes apart below the level was never joined to the sky.
TEST(Pockets, WereJoinedToTheSky) {
  Story story = plain();
  story.hollow = [](const Vector3& x, double time, double top) {
    return time >= kNeck && shaft(x, time, top);
  };
  EXPECT_TRUE(tell(story).cavities.empty());
}

TEST(Pockets, StayClosed) {
  Story story = plain();
  story.hollow = [](const Vector3& x, double time, double top) {
    return shaft(x, time < kNeck + kFrame ? time : 0.0, top);
  };
  EXPECT_TRUE(tell(story).cavities.empty());
}

TEST(Pockets, LieAtTheBody) {
  Story story = plain();
  story.hollow = [](const Vector3& x, double time, double top) {
    return shaft(x, time, std::max(top, 0.0)) && x[2] > 0.35;
  };
  EXPECT_TRUE(tell(story).cavities.empty());
}

TEST(Pockets, OfOneMomentAreOne) {
  Story story = plain();
  // A wall of two spacings' water comes between its halves.
  const auto parted = [](const Vector3& x, double time, double top) {
    return shaft(x, time, top) && (time < kNeck || std::abs(x[0]) > 0.02);
  };
  story.hollow = parted;
  const Told two = tell(story);
  ASSERT_EQ(two.cavities.size(), 1U);
  const double whole = std::pow(tell(plain()).cavities.at(0).radius, 3);
  EXPECT_GT(std::pow(two.cavities[0].radius, 3), 0.6 * whole);
  EXPECT_LT(std::pow(two.cavities[0].radius, 3), 0.95 * whole);
}

TEST(CavityLaws, AreThoseOfTheSources) {
  const double hand = std::sqrt(0.18 * 0.09 / std::numbers::pi);
  EXPECT_NEAR(closing_time(hand, 9.81), 0.1955, 0.0005);
  EXPECT_NEAR(1e3 * closed_volume(hand, 1.0, 9.81), 1.16, 0.02);  // litres
  EXPECT_NEAR(1e3 * closed_volume(hand, 5.0, 9.81), 11.2, 0.2);
  EXPECT_NEAR(sphere_radius(4.18879e-3), 0.1, 1e-6);
  // 10 cm deep: 0.0023; a litre that closes within 0.06 to 0.12 s: 0.008 to 0.016.
  EXPECT_NEAR(ring_excitation(1e-3, 0.0, 0.1, 998.0, 9.81), 0.0023, 0.0001);
  EXPECT_NEAR(ring_excitation(1e-3, -1e-3 / 0.12, 0.1, 998.0, 9.81), 0.0087, 0.0005);
  EXPECT_NEAR(ring_excitation(1e-3, -1e-3 / 0.06, 0.1, 998.0, 9.81), 0.0170, 0.0005);
  EXPECT_NEAR(ring_excitation(1e-3, -1.0, 0.1, 998.0, 9.81), 0.0178, 0.0002);
  EXPECT_EQ(ring_excitation(1e-3, 0.0, 0.01, 998.0, 9.81), 0.002);
  EXPECT_NEAR(ring_life(0.03, 0.1, 9.81), 0.184, 0.001);
  EXPECT_NEAR(ring_life(0.08, 0.1, 9.81), 0.112, 0.001);
}

}  // namespace
}  // namespace splash::sim
