// SPDX-License-Identifier: MIT
// A cavity speaks once: which groups are new, and how large they sound.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim-server/detect/cavities.hpp"

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

}  // namespace
}  // namespace splash::sim
