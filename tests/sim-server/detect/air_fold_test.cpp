// SPDX-License-Identifier: MIT
// How much air each particle folds in, against the brute-force double-precision reference; and that
// the sum is the water's, not the particles'.
#include "sim-server/detect/air_folds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>

#include "tests/sim-server/detect/detect_reference.hpp"
#include "tests/sim-server/detect/detect_rig.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

constexpr double kLeastAir = 0.03;  ///< LEAST_AIR of air_fold.cl
constexpr double kFrame = 0.004;    ///< [s]

/// Those of all particles, each with the rate of its own water.
std::vector<AirFold> folds_of(Water& water, const DetectSettings& settings) {
  AirFolds folds(*water.fluid, detect_program(water.fluid->device()));
  const Step step = prepare(water);
  std::vector<AirFold> all;
  for (int phase = 0; phase < SPLASH_FOLDS_APART; ++phase) {
    folds.enqueue(step, settings, phase);
    folds.enqueue_read();
    water.fluid->device().queue().finish();
    for (AirFold fold : folds.read()) {
      fold.rate /= SPLASH_FOLDS_APART;
      all.push_back(fold);
    }
  }
  return all;
}

double sum_of(const std::vector<AirFold>& folds) {
  double sum = 0.0;
  for (const AirFold& fold : folds) sum += static_cast<double>(fold.rate);
  return sum;
}

class FoldAir : public ::testing::TestWithParam<int> {};

// Water of all kinds, with walls, slope, piston and bodies around; half of it is at rest.
TEST_P(FoldAir, IsAShareOfTheEnergyThatEddiesLoseBesideAir) {
  const DetectSettings s = {.bubble_energy = 0.3, .bubble_eddy = 0.07, .bubble_onset = 0.4};
  const double least = 1.5 * s.bubble_onset * s.bubble_onset;
  Device device(-1, false, GetParam());
  std::size_t checked = 0;
  std::size_t doubtful = 0;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.stir(1.1, 91);
    const double middle = 0.5 * (water.scene.tank.lower[0] + water.scene.tank.upper[0]);
    change_particles(*water.fluid, [middle](int, Vector3& place, Vector3& velocity) {
      if (place[0] < middle) velocity = {};
    });
    std::map<int, AirFold> found;
    for (const AirFold& fold : folds_of(water, s)) found[fold.id] = fold;
    const FluidState state = read_state(*water.fluid, water.piston.offset);
    const FluidParams& p = state.params;
    const double width = eddy_width(s, static_cast<double>(p.spacing));
    const double gravity = length(vector(p.gravity_x, p.gravity_y, p.gravity_z));
    const double volume = static_cast<double>(p.mass) / static_cast<double>(p.rest_density);
    for (std::size_t i = 0; i < state.id.size(); ++i) {
      const ReferenceEddies eddies = reference_eddies(state, i, width);
      if (std::abs(eddies.energy - least) < 1e-4 || std::abs(eddies.air - kLeastAir) < 1e-4) {
        ++doubtful;
        continue;
      }
      const bool should = eddies.energy > least && eddies.air > kLeastAir;
      const auto fold = found.find(state.id[i]);
      ASSERT_EQ(fold != found.end(), should)
          << "particle " << state.id[i] << ", k " << eddies.energy << ", air " << eddies.air;
      if (!should) continue;
      const double loss = std::pow(eddies.energy - least, 1.5) / width;  // [m2/s3]
      const double mixed = 4.0 * eddies.air * (1.0 - eddies.air);
      const double rate = s.bubble_energy * loss * mixed * volume / (gravity * s.bubble_eddy);
      ASSERT_NEAR(static_cast<double>(fold->second.rate), rate, 0.01 * rate + 1e-4 * volume);
      ++checked;
    }
  }
  std::printf("%zu rates, %zu in doubt\n", checked, doubtful);
  EXPECT_GT(checked, 500U);
  EXPECT_LT(doubtful, 10U);
}

INSTANTIATE_TEST_SUITE_P(Lanes, FoldAir, kLaneCounts, lanes_name);

/// A block with air all around whose water turns in eddies 8 cm wide, at that spacing [m].
Water eddying_block(Device& device, double spacing) {
  constexpr double kSide = 0.24;  // [m]
  constexpr double kSpeed = 1.0;  // [m/s]
  Water water = {.scene = tank_scene(spacing, {1.0, 1.0, 1.0}, 1.0)};
  const int across = static_cast<int>(std::lround(kSide / spacing));
  for (int k = 0; k < across * across * across; ++k) {
    const auto along = [&](int cells) { return 0.4 + (cells + 0.5) * spacing; };
    water.particles.push_back(
        {along(k % across), along(k / across % across), along(k / across / across)});
  }
  water.start(device);
  change_particles(*water.fluid, [](int, Vector3& place, Vector3& velocity) {
    const double x = std::numbers::pi / 0.08 * place[0];
    const double z = std::numbers::pi / 0.08 * place[2];
    velocity = {kSpeed * std::sin(x) * std::cos(z), 0.0, -kSpeed * std::cos(x) * std::sin(z)};
  });
  return water;
}

TEST(Folds, AreAsMuchWithHalfTheSpacing) {
  const DetectSettings s = {.bubble_energy = 0.3};
  Device device;
  Water coarse = eddying_block(device, 0.02);
  Water fine = eddying_block(device, 0.01);
  const double few = sum_of(folds_of(coarse, s));
  const double many = sum_of(folds_of(fine, s));
  std::printf("%.3g and %.3g m3/s\n", few, many);
  EXPECT_GT(few, 1e-4);
  EXPECT_NEAR(many / few, 1.0, 0.1);
}

TEST(Folds, NeedMotionThatIsNarrowerThanAnEddy) {
  const DetectSettings s = {.bubble_energy = 0.3};
  Device device;
  Water water = hanging_block();
  water.start(device);
  change_particles(*water.fluid, [](int, Vector3&, Vector3& velocity) {
    velocity[2] = -5.0;  // all of it falls
  });
  EXPECT_TRUE(folds_of(water, s).empty());
  water.stir(1.0, 5);
  EXPECT_FALSE(folds_of(water, s).empty());
}

/// Stirred water, and what is told of it.
struct StirredBlock {
  explicit StirredBlock(const DetectSettings& settings)
      : water(stirred(device)), bubbles(*water.fluid, detect_program(device), settings, 7, 2000) {}

  std::vector<DetectedBubble> next_frame() {
    detect(water, bubbles, kFrame);
    ++frames;
    return bubbles.collect(kFrame * frames, kFrame, frames);
  }

  static Water stirred(Device& device) {
    Water water = hanging_block();
    water.start(device);
    water.stir(1.0, 6);
    return water;
  }

  Device device;
  Water water;
  Bubbles bubbles;
  std::uint32_t frames = 0;
};

// The pool's bubbles are one matter, the told ones another: these use up the air that is folded in.
TEST(Folds, AreToldToTheLastBubble) {
  const DetectSettings s = {.bubble_energy = 0.3, .bubbles_per_second = 1.0e6};
  StirredBlock block(s);
  Bubbles& bubbles = block.bubbles;
  std::set<int> places;
  for (int k = 0; k < 100; ++k) {
    for (const DetectedBubble& bubble : block.next_frame()) {
      EXPECT_GE(bubble.radius, s.radius_min);
      EXPECT_LE(bubble.radius, s.radius_max);
      EXPECT_GT(bubble.time, kFrame * k - 1e-9);
      EXPECT_LE(bubble.time, kFrame * (k + 1));
      places.insert(bubble.particle);
    }
    ASSERT_GE(bubbles.air().told, bubbles.air().entrapped * (1.0 - 1e-9));
    ASSERT_LE(bubbles.air().told - bubbles.air().entrapped, bubble_volume(s.radius_max));
  }
  std::printf("%.3g m3 folded in, %.3g told, at %zu particles\n", bubbles.air().entrapped,
              bubbles.air().told, places.size());
  EXPECT_GT(bubbles.air().entrapped, 10.0 * bubble_volume(s.radius_max));
  EXPECT_GT(places.size(), 50U);
  EXPECT_EQ(bubbles.air().thinned, 0U);
}

// The share may be set to 0 while a scene runs, and back; with a body at work besides.
TEST(Folds, ComeBackAfterTheirShareWasZero) {
  DetectSettings s;
  StirredBlock block(s);
  const auto air_of_frames = [&](double share) {
    const double before = block.bubbles.air().entrapped;
    s.bubble_energy = share;
    block.bubbles.set(s);
    for (int k = 0; k < 20; ++k) block.next_frame();
    return block.bubbles.air().entrapped - before;
  };
  const double some = air_of_frames(0.38);
  EXPECT_GT(some, 0.0);
  EXPECT_EQ(air_of_frames(0.0), 0.0);
  EXPECT_NEAR(air_of_frames(0.38), some, 1e-6 * some);
}

TEST(Folds, AboveTheBudgetAreToldInLargerBubbles) {
  const DetectSettings s = {.bubble_energy = 0.3, .bubbles_per_second = 500.0};
  StirredBlock block(s);
  std::size_t told = 0;
  for (int k = 0; k < 100; ++k) told += block.next_frame().size();
  EXPECT_LE(told, 200U + 26U);  // and what 50 ms left at first
  const AirTotals& air = block.bubbles.air();
  EXPECT_GT(air.thinned, 0U);
  EXPECT_LE(air.told, air.entrapped + bubble_volume(s.radius_max));
}

}  // namespace
}  // namespace splash::sim
