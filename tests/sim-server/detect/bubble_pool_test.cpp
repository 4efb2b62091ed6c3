// SPDX-License-Identifier: MIT
// Who stays in the pool of bubbles: not those alone, above the water, or old; and no more than
// there is room for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim-server/detect/bubble_draw.hpp"
#include "sim-server/detect/bubbles.hpp"
#include "tests/sim-server/detect/detect_reference.hpp"
#include "tests/sim-server/detect/detect_rig.hpp"

namespace splash::sim {
namespace {

constexpr double kFrame = 0.004;

/// One bubble for each particle that spawns.
DetectSettings literal() {
  return {.bubble_per_particle = true, .bubbles_per_second = 1.0e6};
}

class Pool : public ::testing::Test {
 protected:
  Pool() : water_(hanging_block()) { water_.start(device_); }

  Bubbles& make(std::size_t room, const DetectSettings& settings = literal()) {
    bubbles_ = std::make_unique<Bubbles>(*water_.fluid, detect_program(device_), settings, 1, room);
    return *bubbles_;
  }

  /// One frame that ends at `time`.
  std::vector<DetectedBubble> live_until(double time) {
    detect(water_, *bubbles_, kFrame);
    auto fresh = bubbles_->collect(time, kFrame, 1);
    bubbles_->renew(time);
    return fresh;
  }

  /// Serials of those that live.
  std::vector<int> serials() const {
    std::vector<int> all;
    for (const PoolBubble& bubble : bubbles_->pool()) all.push_back(bubble.serial);
    return all;
  }

  /// Two bubbles in each other's reach.
  static std::vector<Vector3> pair_at(double x, double z) { return {{x, 0.5, z}, {x, 0.51, z}}; }

  Device device_;
  Water water_;
  std::unique_ptr<Bubbles> bubbles_;
};

constexpr double kBelow = kBlockBottom - 0.01;
constexpr double kAbove = kBlockTop + 0.01;

// Company at the very rim of the support is none.
TEST_F(Pool, DropsThoseThatBarelyHaveCompany) {
  for (const double share : {0.9, 0.98}) {
    Bubbles& bubbles = make(16);
    const double support = static_cast<double>(water_.params.support);
    fill_pool(bubbles, {{0.5, 0.5, kBelow}, {0.5, 0.5 + share * support, kBelow}});
    const double colour = reference_bubble_colour(
        water_.params, {{0.5, 0.5, kBelow}, {0.5, 0.5 + share * support, kBelow}}, 0);
    static_cast<void>(live_until(0.1));
    EXPECT_EQ(bubbles.pool().size(), colour > 1.0e-6 ? 2U : 0U) << "c_b " << colour;
    EXPECT_EQ(colour > 1.0e-6, share < 0.95);
  }
}

TEST_F(Pool, DropsTheOld) {
  Bubbles& bubbles = make(16);
  fill_pool(bubbles, pair_at(0.5, kBelow), 1.0);
  fill_pool(bubbles, pair_at(0.45, kBelow), 1.1);
  const double life = DetectSettings{}.bubble_life;
  static_cast<void>(live_until(1.0 + life - 0.001));
  EXPECT_EQ(bubbles.pool().size(), 4U);
  static_cast<void>(live_until(1.0 + life + 0.001));
  EXPECT_EQ(serials(), (std::vector<int>{2, 3}));
}

// Those above the water go.
TEST_F(Pool, KeepsItsOrderAndMarks) {
  Bubbles& bubbles = make(32);
  std::vector<Vector3> places;
  for (const double x : {0.56, 0.44, 0.5}) {
    for (const Vector3& place : pair_at(x, kBelow)) places.push_back(place);
    for (const Vector3& place : pair_at(x, kAbove)) places.push_back(place);
  }
  fill_pool(bubbles, places);
  for (PoolBubble& bubble : bubbles.pool()) bubble.cavity = 100 + bubble.serial;
  static_cast<void>(live_until(0.1));
  EXPECT_EQ(serials(), (std::vector<int>{0, 1, 4, 5, 8, 9}));
  for (const PoolBubble& bubble : bubbles.pool()) EXPECT_EQ(bubble.cavity, 100 + bubble.serial);
}

TEST_F(Pool, MovesWithTheWater) {
  water_.stir(1.0, 111);
  Bubbles& bubbles = make(16);
  const auto places = as_floats(pair_at(0.5, kBelow + 0.02));
  fill_pool(bubbles, places);
  detect(water_, bubbles, kFrame);
  const std::vector<BubbleState> states = bubbles.states();
  bubbles.renew(0.1);
  ASSERT_EQ(bubbles.pool().size(), 2U);
  for (const BubbleState& state : states) {
    const PoolBubble& bubble = bubbles.pool()[static_cast<std::size_t>(state.id)];
    EXPECT_EQ(bubble.position[0], static_cast<double>(state.x));
    EXPECT_EQ(bubble.position[2], static_cast<double>(state.z));
    EXPECT_NE(bubble.position, places[static_cast<std::size_t>(state.id)]);
  }
}

/// The block falls fast, and all but its top layer spawn: particles 0 to 399.
class Spawns : public Pool {
 protected:
  static DetectSettings eager() {
    DetectSettings settings = literal();
    settings.bubble_gradient = -0.4;
    return settings;
  }

  void drop() {
    change_particles(*water_.fluid, [](int id, Vector3&, Vector3& velocity) {
      if (id < 500) velocity[2] = -1.0;
    });
  }
};

// All of them, once each, though they are more than are read at once.
TEST_F(Spawns, JoinThePoolInTheOrderOfTheirParticles) {
  Bubbles& bubbles = make(800, eager());
  fill_pool(bubbles, pair_at(0.5, kBelow));
  drop();
  const auto fresh = live_until(0.1);
  ASSERT_EQ(fresh.size(), 400U);
  ASSERT_EQ(bubbles.pool().size(), 402U);
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    EXPECT_EQ(fresh[k].particle, static_cast<int>(k));
    EXPECT_EQ(bubbles.pool()[k + 2].position, fresh[k].position);
    EXPECT_EQ(bubbles.pool()[k + 2].born, 0.1);
    EXPECT_EQ(bubbles.pool()[k + 2].serial, static_cast<int>(k));
    EXPECT_EQ(bubbles.pool()[k + 2].cavity, -1);
  }
  EXPECT_EQ(bubbles.dropped(), 0U);
}

// Heard they are all the same: the pool is for cavities.
TEST_F(Spawns, BeyondThePoolsRoomAreCounted) {
  Bubbles& bubbles = make(401, eager());
  fill_pool(bubbles, pair_at(0.5, kBelow));
  drop();
  const auto fresh = live_until(0.1);
  EXPECT_EQ(fresh.size(), 400U);
  EXPECT_EQ(bubbles.pool().size(), 401U);
  EXPECT_EQ(bubbles.dropped(), 1U);
  // The old ones keep their places.
  EXPECT_EQ(bubbles.pool()[1].serial, 1);
}

/// Half a second of a flood.
class Flood : public Spawns {
 protected:
  static constexpr int kFrames = 125;
  static constexpr double kBudget = 1000.0;  ///< bubbles a second

  /// From 400 places alike, `times` the air that the budget's bubbles of mean size hold.
  void flood(double times) {
    told_.clear();
    const DetectSettings settings = {.bubbles_per_second = kBudget};
    WakeAir wakes;
    for (int place = 0; place < 400; ++place) {
      const double rate = times * kBudget * mean_volume(settings) / 400.0;
      wakes.folds.push_back({place, 0.5F, 0.5F, 0.1F, static_cast<float>(rate)});
    }
    listen(settings, wakes);
  }

  /// From 400 particles in the first frame, by the paper's rule.
  void spawn_at_once() {
    DetectSettings settings = eager();
    settings.bubbles_per_second = kBudget;
    drop();
    listen(settings, {});
  }

  /// Of the radii, once what was left at the beginning is used up.
  [[nodiscard]] double median() const { return radius(0.5); }
  [[nodiscard]] double smallest() const { return radius(0.0); }
  [[nodiscard]] double radius(double share) const {
    std::vector<double> radii;
    for (const DetectedBubble& bubble : told_) {
      if (bubble.time > 0.05) radii.push_back(bubble.radius);
    }
    std::sort(radii.begin(), radii.end());
    return radii.at(static_cast<std::size_t>(share * static_cast<double>(radii.size())));
  }

  std::vector<DetectedBubble> told_;
  std::size_t most_ = 0;  ///< in a frame
  AirTotals air_;

 private:
  void listen(const DetectSettings& settings, const WakeAir& wakes) {
    Bubbles& bubbles = make(800, settings);
    for (unsigned k = 1; k <= kFrames; ++k) {
      detect(water_, bubbles, kFrame);
      const auto told = bubbles.collect(k * kFrame, kFrame, k, wakes);
      most_ = std::max(most_, told.size());
      told_.insert(told_.end(), told.begin(), told.end());
    }
    air_ = bubbles.air();
    printf("%zu told, at most %zu in a frame, %.3f of %.3f l, %llu thinned\n", told_.size(), most_,
           1e3 * air_.told, 1e3 * air_.entrapped, static_cast<unsigned long long>(air_.thinned));
  }
};

TEST_F(Flood, IsToldInNoMoreBubblesThanTheBudgetHas) {
  flood(10.0);
  constexpr double kBurst = 0.05 * kBudget;
  EXPECT_LE(static_cast<double>(told_.size()), kFrames * kFrame * kBudget + kBurst);
  EXPECT_GE(static_cast<double>(told_.size()), kFrames * kFrame * kBudget);
  EXPECT_LE(most_, static_cast<std::size_t>(kBurst));
  const double wanted = air_.entrapped / mean_volume(DetectSettings{});
  // In the first tenth of a second bubbles are smaller, and there would be more of them.
  EXPECT_NEAR(static_cast<double>(air_.thinned + told_.size()), wanted, 0.15 * wanted);
}

// Larger ones: but for the last bubble the air is the same.
TEST_F(Flood, LosesNoAir) {
  flood(10.0);
  EXPECT_NEAR(air_.told, air_.entrapped, bubble_volume(DetectSettings{}.radius_max));
  EXPECT_GT(median(), 0.010);
  flood(0.5);
  EXPECT_LT(median(), 0.005);
}

// Where the largest do not hold it, an octave of pitches is left, and what is lost is counted.
TEST_F(Flood, ThatNoBubblesHoldIsCounted) {
  flood(200.0);
  EXPECT_GE(median(), 0.018);
  EXPECT_LT(air_.told, 0.2 * air_.entrapped);
  EXPECT_GT(air_.told, 0.08 * air_.entrapped);
}

TEST_F(Flood, ComesFromAllPlacesAlike) {
  flood(10.0);
  int low = 0;
  for (const DetectedBubble& bubble : told_) low += bubble.particle < 200;
  const double share = low / static_cast<double>(told_.size());
  EXPECT_NEAR(share, 0.5, 0.1);
}

TEST_F(Flood, WithinTheBudgetChangesNothing) {
  flood(0.5);
  EXPECT_EQ(air_.thinned, 0U);
  EXPECT_LT(smallest(), 0.0031);
}

TEST_F(Flood, OfThePapersRuleIsThinnedAlike) {
  spawn_at_once();
  EXPECT_EQ(most_, 50U);
  EXPECT_EQ(air_.thinned + told_.size(), 400U);
}

}  // namespace
}  // namespace splash::sim
