// SPDX-License-Identifier: MIT
// A cavity speaks once: which groups are new, and how large they sound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "sim-server/detect/cavities.hpp"
#include "sim-server/fluid/smoothing.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// Three bubbles are enough.
DetectSettings of_three() {
  DetectSettings settings;
  settings.cavity_by_count = true;
  settings.cavity_bubbles_min = 3;
  settings.cavity_bubbles_max = 13;
  settings.cavity_radius_min = 0.01;
  settings.cavity_radius_max = 0.06;
  return settings;
}

/// A pool of bubbles along x, and the names given so far.
struct Pool {
  explicit Pool(int count) {
    for (int k = 0; k < count; ++k) bubbles.push_back({{0.1 * k, 1.0, -0.2 * k}, 0.0, k, -1});
  }
  std::vector<DetectedCavity> name(const std::vector<int>& label) {
    return name_cavities(bubbles, label, time, of_three(), next);
  }
  std::vector<int> names() const {
    std::vector<int> all;
    for (const PoolBubble& bubble : bubbles) all.push_back(bubble.cavity);
    return all;
  }
  std::vector<PoolBubble> bubbles;
  int next = 0;
  double time = 2.5;
};

TEST(NameCavities, SpeaksOnce) {
  Pool pool(5);
  const std::vector<int> label = {0, 0, 0, 0, -1};
  const auto found = pool.name(label);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].bubbles, 4);
  EXPECT_EQ(found[0].time, 2.5);
  EXPECT_NEAR(found[0].radius, 0.015, 1.0e-12);
  EXPECT_NEAR(found[0].position[0], 0.15, 1.0e-12);
  EXPECT_NEAR(found[0].position[1], 1.0, 1.0e-12);
  EXPECT_NEAR(found[0].position[2], -0.3, 1.0e-12);
  EXPECT_EQ(pool.names(), (std::vector<int>{0, 0, 0, 0, -1}));
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(pool.name(label).empty());
}

TEST(NameCavities, LeavesSmallGroupsAlone) {
  Pool pool(5);
  EXPECT_TRUE(pool.name({4, 4, -1, 7, 7}).empty());
  EXPECT_EQ(pool.names(), std::vector<int>(5, -1));
  EXPECT_EQ(pool.next, 0);
}

// It grows around what is left of it, however little; and the newcomers carry it on.
TEST(NameCavities, GoesOnWhileAnyBubbleLives) {
  Pool pool(7);
  ASSERT_EQ(pool.name({0, 0, 0, -1, -1, -1, -1}).size(), 1U);
  // Of the first three one is left, among four that are new.
  EXPECT_TRUE(pool.name({-1, -1, 2, 2, 2, 2, 2}).empty());
  EXPECT_EQ(pool.names()[6], 0);
  pool.bubbles.erase(pool.bubbles.begin(), pool.bubbles.begin() + 3);
  EXPECT_TRUE(pool.name({0, 0, 0, 0}).empty());
}

// The last bubble of it, too few to be one, still keeps the name.
TEST(NameCavities, KeepsItsNameWhenSmall) {
  Pool pool(4);
  ASSERT_EQ(pool.name({0, 0, 0, -1}).size(), 1U);
  EXPECT_TRUE(pool.name({-1, -1, 2, 2}).empty());
  EXPECT_EQ(pool.names()[3], 0);
}

TEST(NameCavities, MergesInSilence) {
  Pool pool(8);
  ASSERT_EQ(pool.name({0, 0, 0, -1, -1, 5, 5, 5}).size(), 2U);
  EXPECT_EQ(pool.names(), (std::vector<int>{0, 0, 0, -1, -1, 1, 1, 1}));
  EXPECT_TRUE(pool.name({0, 0, 0, 0, 0, 0, 0, 0}).empty());
  EXPECT_EQ(pool.names(), std::vector<int>(8, 0));
  // Parted again, both are the one that it was.
  EXPECT_TRUE(pool.name({0, 0, 0, 0, 4, 4, 4, 4}).empty());
}

TEST(NameCavities, SpeaksAgainAfterAllAreGone) {
  Pool pool(6);
  ASSERT_EQ(pool.name({0, 0, 0, -1, -1, -1}).size(), 1U);
  pool.bubbles.erase(pool.bubbles.begin(), pool.bubbles.begin() + 3);
  const auto found = pool.name({0, 0, 0});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(pool.names(), std::vector<int>(3, 1));
}

TEST(NameCavities, CountsThemByTheirFirstBubble) {
  Pool pool(6);
  const auto found = pool.name({3, 1, 3, 1, 3, 1});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].position[0], 0.3, 1.0e-12);  // bubbles 1, 3 and 5 of group 1
  EXPECT_NEAR(found[1].position[0], 0.2, 1.0e-12);
  EXPECT_EQ(pool.next, 2);
}

TEST(CavityRadius, IsALineBetweenItsBounds) {
  const DetectSettings settings = of_three();
  EXPECT_DOUBLE_EQ(cavity_radius(3, settings), 0.01);
  EXPECT_DOUBLE_EQ(cavity_radius(8, settings), 0.035);
  EXPECT_DOUBLE_EQ(cavity_radius(13, settings), 0.06);
  EXPECT_DOUBLE_EQ(cavity_radius(1, settings), 0.01);
  EXPECT_DOUBLE_EQ(cavity_radius(5000, settings), 0.06);
}

TEST(CavityRadius, SurvivesBoundsThatMeet) {
  DetectSettings settings = of_three();
  settings.cavity_bubbles_max = settings.cavity_bubbles_min;
  EXPECT_DOUBLE_EQ(cavity_radius(3, settings), 0.01);
  EXPECT_DOUBLE_EQ(cavity_radius(4, settings), 0.06);
}

// By the space they take up: bubbles that fill a block, however finely, make the sphere of its
// volume.
TEST(CavityVolume, IsThatOfTheSpaceTheBubblesFill) {
  FluidParams params = {};
  const double spacing = 0.02;
  const double support = kSupportSpacings * spacing;
  params.support = static_cast<float>(support);
  params.mass = static_cast<float>(1000.0 * spacing * spacing * spacing);
  params.rest_density = 1000.0F;
  const double unit = spacing * spacing * spacing;
  const double edge = 0.12;
  for (const int side : {6, 9, 12}) {
    SCOPED_TRACE(side);
    std::vector<PoolBubble> pool;
    for (int k = 0; k < side * side * side; ++k) {
      PoolBubble bubble;
      bubble.position = {edge * (k % side + 0.5) / side, edge * (k / side % side + 0.5) / side,
                         edge * (k / (side * side) + 0.5) / side};
      pool.push_back(bubble);
    }
    for (PoolBubble& bubble : pool) {
      double colour = -unit * kernel_value(0.0, support);
      for (const PoolBubble& other : pool) {
        colour += unit * kernel_value(length(bubble.position - other.position), support);
      }
      bubble.volume = bubble_volume(colour, params);
    }
    DetectSettings settings;
    settings.cavity_radius_max = 1.0;
    int next = 0;
    const auto found = name_cavities(pool, std::vector<int>(pool.size(), 0), 1.0, settings, next);
    ASSERT_EQ(found.size(), 1U);
    const double exact = std::cbrt(3.0 * edge * edge * edge / (4.0 * std::numbers::pi));
    std::printf("%d bubbles along an edge: radius %.4f m, exact %.4f m\n", side, found[0].radius,
                exact);
    // Bubbles at the faces take up space on their far side, too.
    EXPECT_GT(found[0].radius, exact);
    EXPECT_LT(found[0].radius, 1.2 * exact);
  }
}

TEST(CavityVolume, TooLittleOfItIsNone) {
  std::vector<PoolBubble> pool(3);
  for (PoolBubble& bubble : pool) bubble.volume = 1.0e-5;
  int next = 0;
  DetectSettings settings;
  settings.cavity_radius_min = 0.02;  // 3.35e-5 m3
  EXPECT_TRUE(name_cavities(pool, {0, 0, 0}, 1.0, settings, next).empty());
  for (PoolBubble& bubble : pool) bubble.volume = 1.2e-5;
  EXPECT_EQ(name_cavities(pool, {0, 0, 0}, 1.0, settings, next).size(), 1U);
  for (PoolBubble& bubble : pool) bubble = {{0.0, 0.0, 0.0}, 0.0, 0, -1, 1.0};
  EXPECT_EQ(name_cavities(pool, {0, 0, 0}, 1.0, settings, next).at(0).radius,
            settings.cavity_radius_max);
}

}  // namespace
}  // namespace splash::sim
