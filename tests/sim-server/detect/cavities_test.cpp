// SPDX-License-Identifier: MIT
// Cavities by the number of bubbles: groups as the device grows them, against a union-find on the
// host; a cavity speaks once: which groups are new, and how large they sound.
#include "sim-server/detect/cavities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/detect/detect_reference.hpp"
#include "tests/sim-server/detect/detect_rig.hpp"

namespace splash::sim {
namespace {

constexpr std::size_t kRoom = 2000;

/// Every group that has a seed is a cavity.
DetectSettings all_groups() {
  return {.cavity_by_count = true, .cavity_colour = 0.5, .cavity_bubbles_min = 1};
}

/// A clump of bubbles in each other's reach: a seed for sure, all within 8 mm of `centre`.
std::vector<Vector3> clump(const Vector3& centre) {
  const Vector3 half = {0.008, 0.008, 0.008};
  return random_places(20, centre - half, centre + half, 101);
}

class Grow : public ::testing::TestWithParam<int> {
 protected:
  Grow() : device_(-1, false, GetParam()), water_(hanging_block()) { water_.start(device_); }

  /// The cavity of each bubble.
  std::vector<int> cavities_of(const std::vector<Vector3>& places) {
    const cl::Program program = detect_program(device_);
    bubbles_ = std::make_unique<Bubbles>(*water_.fluid, program, all_groups(), 1, kRoom);
    Cavities cavities(*water_.fluid, program, all_groups(), kRoom);
    fill_pool(*bubbles_, places);
    detect(water_, *bubbles_, 0.0);
    found_ = cavities.search(0.0, *bubbles_);
    rounds_ = cavities.rounds();
    std::vector<int> cavity;
    for (const PoolBubble& bubble : bubbles_->pool()) cavity.push_back(bubble.cavity);
    return cavity;
  }

  /// What union-find says, on the same floats.
  std::vector<int> groups_of(const std::vector<Vector3>& given) const {
    const std::vector<Vector3> places = as_floats(given);
    std::vector<bool> seed;
    for (std::size_t i = 0; i < places.size(); ++i) {
      seed.push_back(reference_bubble_colour(water_.params, places, i) >
                     all_groups().cavity_colour);
    }
    return reference_groups(places, static_cast<double>(water_.params.support), seed);
  }

  double reach() const { return static_cast<double>(water_.params.support); }

  Device device_;
  Water water_;
  std::unique_ptr<Bubbles> bubbles_;
  std::vector<DetectedCavity> found_;
  int rounds_ = 0;
};

/// The same parting, whatever the parts are called.
void expect_same_parts(const std::vector<int>& a, const std::vector<int>& b) {
  ASSERT_EQ(a.size(), b.size());
  std::map<int, int> there;
  std::map<int, int> back;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i] < 0, b[i] < 0) << "bubble " << i;
    if (a[i] < 0) continue;
    ASSERT_EQ(there.emplace(a[i], b[i]).first->second, b[i]) << "bubble " << i;
    ASSERT_EQ(back.emplace(b[i], a[i]).first->second, a[i]) << "bubble " << i;
  }
}

int parts_in(std::vector<int> groups) {
  std::erase(groups, -1);
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return static_cast<int>(groups.size());
}

/// Clouds and crumbs of all sizes: groups with and without seeds.
std::vector<Vector3> clouds() {
  std::vector<Vector3> places = random_places(330, {0.1, 0.1, 0.1}, {0.9, 0.9, 0.5}, 102);
  const auto centres = random_places(14, {0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}, 103);
  for (const Vector3& centre : centres) {
    const auto some = clump(centre);
    places.insert(places.end(), some.begin(), some.end());
  }
  return places;
}

TEST_P(Grow, IsUnionFindInAnyOrder) {
  const std::vector<Vector3> places = clouds();
  const std::vector<int> groups = groups_of(places);
  EXPECT_GT(parts_in(groups), 5);
  EXPECT_GT(std::count(groups.begin(), groups.end(), -1), 50);
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), 0U);
  std::mt19937 random(104);
  for (int k = 0; k < 3; ++k) {
    if (k > 0) std::shuffle(order.begin(), order.end(), random);
    std::vector<Vector3> shuffled;
    std::vector<int> expected;
    for (const std::size_t i : order) {
      shuffled.push_back(places[i]);
      expected.push_back(groups[i]);
    }
    expect_same_parts(cavities_of(shuffled), expected);
    EXPECT_EQ(static_cast<int>(found_.size()), parts_in(groups));
  }
}

/// A seed, and a chain of `links` bubbles from it, each only in reach of the next.
std::vector<Vector3> chain(int links, double reach, double direction) {
  const Vector3 start = {direction > 0.0 ? 0.02 : 0.98, 0.3, 0.3};
  std::vector<Vector3> places = clump(start);
  for (int k = 1; k <= links; ++k) {
    places.push_back({start[0] + direction * (0.008 + 0.75 * reach * k), 0.3, 0.3});
  }
  return places;
}

// One round reaches one link: four are enqueued between two looks.
TEST_P(Grow, FollowsChains) {
  for (const int links : {1, 3, 4, 5, 8, 9, 27}) {
    for (const double direction : {1.0, -1.0}) {
      SCOPED_TRACE(links);
      const auto places = chain(links, reach(), direction);
      const std::vector<int> cavity = cavities_of(places);
      EXPECT_EQ(std::count(cavity.begin(), cavity.end(), 0), std::ssize(places));
      ASSERT_EQ(found_.size(), 1U);
      EXPECT_EQ(found_[0].bubbles, std::ssize(places));
      // The chain, the clump it hangs on and the look that finds nothing more.
      EXPECT_GE(rounds_, links);
      EXPECT_LE(rounds_, links + 3 + 8);
    }
  }
}

TEST_P(Grow, StopsWhereTheChainIsBroken) {
  auto places = chain(27, reach(), 1.0);
  places.erase(places.begin() + 20 + 13);  // the 14th link
  const std::vector<int> cavity = cavities_of(places);
  EXPECT_EQ(std::count(cavity.begin(), cavity.end(), 0), 20 + 13);
  EXPECT_EQ(std::count(cavity.begin(), cavity.end(), -1), 13);
}

TEST_P(Grow, NeedsASeed) {
  std::vector<Vector3> places;
  for (int k = 0; k < 20; ++k) places.push_back({0.1 + 0.75 * reach() * k, 0.3, 0.3});
  const std::vector<int> cavity = cavities_of(places);
  EXPECT_EQ(std::count(cavity.begin(), cavity.end(), -1), 20);
  EXPECT_TRUE(found_.empty());
  EXPECT_EQ(rounds_, 0);
}

TEST_P(Grow, PlacesACavityInTheMiddleOfItsBubbles) {
  const std::vector<Vector3> places = chain(6, reach(), 1.0);
  static_cast<void>(cavities_of(places));
  ASSERT_EQ(found_.size(), 1U);
  Vector3 mean = {0.0, 0.0, 0.0};
  for (const Vector3& place : places) {
    mean = mean + (1.0 / static_cast<double>(places.size())) * place;
  }
  EXPECT_LT(length(found_[0].position - mean), 1.0e-6);
}

INSTANTIATE_TEST_SUITE_P(Lanes, Grow, kLaneCounts, lanes_name);

/// Three bubbles are enough.
DetectSettings of_three() {
  return {.cavity_by_count = true,
          .cavity_bubbles_min = 3,
          .cavity_bubbles_max = 13,
          .cavity_radius_min = 0.01,
          .cavity_radius_max = 0.06};
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
