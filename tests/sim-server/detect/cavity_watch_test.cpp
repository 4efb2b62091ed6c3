// SPDX-License-Identifier: MIT
// Hollows of known form and time behind a hand: which are cavities, and what is told of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/detect/air_account.hpp"
#include "sim-server/detect/cavity_laws.hpp"
#include "sim-server/detect/cavity_watch.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

constexpr double kLevel = 0.4;
constexpr double kSlap = 0.1;  // when its underside meets the level [s]
constexpr double kFrame = 1.0 / 160.0;
constexpr double kSpacing = 0.02;
/// 2.285 sqrt(R / g), R^2 = 0.18 m 0.09 m / pi.
constexpr double kCloses = 0.19549;

struct Story {
  std::string path = "{time: 0, position: [0, 0, 0.52]}, {time: 0.4, position: [0, 0, 0.12]}";
  std::string size = "[0.18, 0.09, 0.04]";  ///< of the box [m]
  std::string body = "";                    ///< more keys of it
  double speed = 1.0;                       ///< told of its impact; 0: none [m/s]
  double slap = kSlap;                      ///< when [s]
  double floor = 0.0;                       ///< [m]
  /// Whether there is air below the level at a place, a time, and where the body's top is [m].
  std::function<bool(const Vector3&, double, double)> hollow;
};

/// As wide as the hand.
bool shaft(const Vector3& x, double /*time*/, double top) {
  return std::abs(x[0]) < 0.09 && std::abs(x[1]) < 0.045 && x[2] > top;
}

struct Told {
  std::vector<DetectedCavity> cavities;
  int readings = 0;  ///< of the water
  std::uint64_t looks = 0;
  NoCavity none;
};

Told tell(const Story& story) {
  const std::string floor = std::to_string(story.floor);
  const Scene scene = parse_scene(
      "fluid: {spacing: 0.02}\n"
      "tank: {lower: [-0.3, -0.3, " +
          floor +
          "], upper: [0.3, 0.3, 1]}\n"
          "water: [{lower: [-0.3, -0.3, " +
          floor +
          "], upper: [0.3, 0.3, 0.4]}]\n"
          "bodies:\n"
          "  - name: hand\n"
          "    shape: {kind: box, size: " +
          story.size + "}\n" + story.body +
          "    motion: {kind: script, smooth: false, keyframes: [" + story.path + "]}\n",
      "test scene");
  constexpr double kSupport = 2.5 * kSpacing;
  std::vector<std::unique_ptr<Motion>> motions;
  motions.push_back(make_motion(scene.bodies[0], {}));
  const Bodies bodies(sample_bodies(scene.bodies, kSpacing, kSupport), std::move(motions),
                      kSupport);
  CavityWatch watch(scene, sample_skins(scene.bodies, kSpacing), std::pow(kSpacing, 3));
  Told told;
  for (int frame = 1; frame * kFrame < 0.6; ++frame) {
    const double time = frame * kFrame;
    std::vector<DetectedImpact> impacts;
    if (story.speed > 0.0 && time >= story.slap && time - kFrame < story.slap) {
      DetectedImpact impact;
      impact.time = story.slap;
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
            if (x[2] < story.floor || in_hand || story.hollow(x, time, hand[2])) continue;
            water.push_back(x);
          }
        }
      }
      return water;
    };
    for (const DetectedCavity& c : watch.observe(time, impacts, bodies, read)) {
      told.cavities.push_back(c);
    }
  }
  told.looks = watch.looks();
  told.none = watch.none();
  return told;
}

Story plain() {
  Story story;
  story.hollow = shaft;
  return story;
}

// The air is what the law leaves beside the hand, within what is uncertain of its factor.
TEST(CavityWatch, TellsOneCavityOfADeepStroke) {
  const Told told = tell(plain());
  ASSERT_EQ(told.cavities.size(), 1U);
  const DetectedCavity& cavity = told.cavities.front();
  EXPECT_EQ(cavity.body, 0);
  EXPECT_NEAR(cavity.time, kSlap + kCloses, 0.002);
  const double hand = 0.18 * 0.09 * 0.04;
  const double radius = std::sqrt(0.18 * 0.09 / std::numbers::pi);
  EXPECT_GT(bubble_volume(cavity.radius), closed_volume(radius, 1.0, 9.81, 1.5) - hand);
  EXPECT_LT(bubble_volume(cavity.radius), closed_volume(radius, 1.0, 9.81, 3.0) - hand);
  EXPECT_NEAR(cavity.position[0], 0.0, 0.005);
  EXPECT_LT(cavity.position[2], kLevel - 0.5 * kCloses);
  EXPECT_GT(cavity.position[2], kLevel - kCloses);
  EXPECT_NEAR(cavity.life, ring_life(cavity.radius, kLevel - cavity.position[2], 9.81),
              0.02 * cavity.life);
  EXPECT_GE(cavity.epsilon, 0.002);
  EXPECT_LE(cavity.epsilon, 0.035);
}

TEST(CavityWatch, CostsNothingWithoutAnImpact) {
  Story story = plain();
  story.speed = 0.0;
  const Told told = tell(story);
  EXPECT_TRUE(told.cavities.empty());
  EXPECT_EQ(told.readings, 0);
  EXPECT_EQ(told.looks, 0U);
}

// u t_p < R + thickness below 0.57 m/s: but for the level at the impact nothing is looked at.
TEST(CavityWatch, NeedsSpeed) {
  Story story = plain();
  story.path = "{time: 0, position: [0, 0, 0.47]}, {time: 0.6, position: [0, 0, 0.17]}";
  const Told told = tell(story);
  EXPECT_TRUE(told.cavities.empty());
  EXPECT_EQ(told.looks, 1U);
  EXPECT_EQ(told.none.stopped, 1U);
  story.path = "{time: 0, position: [0, 0, 0.485]}, {time: 0.5, position: [0, 0, 0.16]}";
  EXPECT_EQ(tell(story).cavities.size(), 1U);
}

TEST(CavityWatch, NeedsABodyThatPartsTheWater) {
  Story story = plain();
  story.body = "    cavity: false\n";
  EXPECT_TRUE(tell(story).cavities.empty());
}

// It stops when its underside is 6, 10 and 12 cm deep.
TEST(CavityWatch, NeedsDepth) {
  for (const double depth : {0.06, 0.1, 0.12}) {
    Story story = plain();
    story.path = "{time: 0, position: [0, 0, 0.52]}, {time: " + std::to_string(0.1 + depth) +
                 ", position: [0, 0, " + std::to_string(0.42 - depth) + "]}";
    const Told told = tell(story);
    EXPECT_TRUE(told.cavities.empty()) << depth;
    EXPECT_EQ(told.none.stopped, depth < 0.11 ? 1U : 0U) << depth;
    EXPECT_EQ(told.none.filled, depth < 0.11 ? 0U : 1U) << depth;
  }
}

TEST(CavityWatch, NeedsDeepWater) {
  Story story = plain();
  story.floor = kLevel - 0.1;
  const Told told = tell(story);
  EXPECT_TRUE(told.cavities.empty());
  EXPECT_EQ(told.none.shallow, 1U);
  story.floor = kLevel - 0.16;
  EXPECT_EQ(tell(story).cavities.size(), 1U);
}

// A board of 40 by 2 cm, turned by 60 degrees, goes in at 1 m/s until its middle is under, 0.17 s
// after its lower end. At that speed its upper end sticks out when its hollow closes.
TEST(CavityWatch, NeedsABodyThatGoesUnder) {
  for (const double then : {1.0, 2.0}) {
    Story story = plain();
    story.size = "[0.4, 0.02, 0.01]";
    const std::string turn = ", rotation: [0, 0.5, 0, 0.8660254]}";
    story.path = "{time: 0, position: [0, 0, 0.58]" + turn +
                 ", {time: 0.18, position: [0, 0, 0.4]" + turn + ", {time: 0.3, position: [0, 0, " +
                 std::to_string(0.4 - 0.12 * then) + "]" + turn;
    story.slap = 0.01;
    EXPECT_EQ(tell(story).none.afloat, then < 1.5 ? 1U : 0U) << then;
  }
}

TEST(CavityWatch, NeedsABodyThatDoesNotComeOut) {
  Story story = plain();
  story.path =
      "{time: 0, position: [0, 0, 0.52]}, {time: 0.28, position: [0, 0, 0.24]}, "
      "{time: 0.6, position: [0, 0, 0.32]}";
  EXPECT_TRUE(tell(story).cavities.empty());
}

// No hollow is behind the hand in the water, or one that was never joined to the sky; but one
// narrower than four spacings need not be seen.
TEST(CavityWatch, NeedsAHollowInTheWater) {
  Story story = plain();
  story.hollow = [](const Vector3&, double, double) { return false; };
  const Told told = tell(story);
  EXPECT_TRUE(told.cavities.empty());
  EXPECT_EQ(told.none.unseen, 1U);
  story.hollow = [](const Vector3& x, double time, double top) {
    return shaft(x, time, top) && x[2] < kLevel - 0.08;
  };
  EXPECT_TRUE(tell(story).cavities.empty());
  story.size = "[0.08, 0.055, 0.04]";
  EXPECT_EQ(tell(story).cavities.size(), 1U);
}

// Where the body went in, it must be R / 2 = 3.6 cm deep; it need not reach the body.
TEST(CavityWatch, NeedsAHollowAlongTheWay) {
  for (const double deep : {0.03, 0.07}) {
    Story story = plain();
    story.path = "{time: 0, position: [0, 0, 0.52]}, {time: 0.2, position: [0, 0, 0.12]}";
    story.speed = 2.0;
    story.slap = 0.05;
    story.hollow = [deep](const Vector3& x, double time, double top) {
      return shaft(x, time, top) && x[2] > kLevel - deep;
    };
    EXPECT_EQ(tell(story).cavities.size(), deep > 0.036 ? 1U : 0U) << deep;
  }
}

// A hand turned by 60 degrees shows 11.5 by 9 cm from above, its middle 7.8 cm above its lowest
// edge; where the edge met the water is not where the hollow begins.
TEST(CavityWatch, CountsFromTheMiddleOfASlantedFront) {
  Story story = plain();
  const std::string turn = ", rotation: [0, 0.5, 0, 0.8660254]}";
  story.path =
      "{time: 0, position: [0, 0, 0.58]" + turn + ", {time: 0.3, position: [0, 0, 0.13]" + turn;
  story.speed = 1.5;
  // Its lowest edge is 7.8 cm + 1.0 cm below its middle.
  story.slap = (0.58 - 0.0879 - kLevel) / 1.5;
  story.hollow = [](const Vector3& x, double, double top) {
    return std::abs(x[0]) < 0.05 && std::abs(x[1]) < 0.045 && x[2] > top + 0.02;
  };
  const Told told = tell(story);
  ASSERT_EQ(told.cavities.size(), 1U);
  // What faces down is the underside, 18 by 9 cm, and the end, 4 by 9 cm.
  const double under = 0.18 * 0.5;
  const double end = 0.04 * 0.8660254;
  const double middle = (under * 0.02 * 0.5 + end * 0.09 * 0.8660254) / (under + end);
  const double radius = std::sqrt((under + end) * 0.09 / std::numbers::pi);
  EXPECT_NEAR(told.cavities[0].time,
              (0.58 - middle - kLevel) / 1.5 + 2.285 * std::sqrt(radius / 9.81), 0.002);
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
