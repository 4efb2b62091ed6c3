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

DetectSettings settings() {
  DetectSettings settings;
  settings.bubble_energy = 0.3;
  settings.bubble_eddy = 0.07;
  settings.bubble_onset = 0.4;
  return settings;
}

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

// Water of all kinds, with walls, slope, piston and bodies around.
TEST_P(FoldAir, IsAShareOfTheEnergyThatEddiesLoseBesideAir) {
  const DetectSettings s = settings();
  const double least = 1.5 * s.bubble_onset * s.bubble_onset;
  Device device(-1, false, GetParam());
  std::size_t checked = 0;
  std::size_t doubtful = 0;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.stir(1.1, 91);
    std::map<int, AirFold> found;
    for (const AirFold& fold : folds_of(water, s)) found[fold.id] = fold;
    const FluidState state = read_state(*water.fluid, water.piston.offset);
    const FluidParams& p = state.params;
    const double width = eddy_width(s, static_cast<double>(p.spacing));
    const double gravity =
        std::hypot(static_cast<double>(p.gravity_x), static_cast<double>(p.gravity_y),
                   static_cast<double>(p.gravity_z));
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
  Water water;
  water.scene = tank_scene(spacing, {1.0, 1.0, 1.0}, 1.0);
  const int across = static_cast<int>(std::lround(kSide / spacing));
  for (int k = 0; k < across * across * across; ++k) {
    const auto along = [&](int cells) { return 0.4 + (cells + 0.5) * spacing; };
    water.particles.push_back(
        {along(k % across), along(k / across % across), along(k / across / across)});
  }
  water.start(device);
  Snapshot snapshot = water.fluid->snapshot();
  const double wave = std::numbers::pi / 0.08;
  for (std::size_t i = 0; i < water.particles.size(); ++i) {
    const Vector3 place = vector_of(*water.fluid, snapshot.position, i);
    const double x = wave * place[0];
    const double z = wave * place[2];
    const Vector3 velocity = {kSpeed * std::sin(x) * std::cos(z), 0.0,
                              -kSpeed * std::cos(x) * std::sin(z)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      snapshot.velocity[part(*water.fluid, axis, i)] = static_cast<float>(velocity[axis]);
    }
  }
  water.fluid->restore(snapshot);
  return water;
}

TEST(Folds, AreAsMuchWithHalfTheSpacing) {
  DetectSettings s;
  s.bubble_energy = 0.3;
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
  DetectSettings s;
  s.bubble_energy = 0.3;
  Device device;
  Water water = hanging_block();
  water.start(device);
  Snapshot snapshot = water.fluid->snapshot();
  for (std::size_t i = 0; i < water.particles.size(); ++i) {
    snapshot.velocity[part(*water.fluid, 2, i)] = -5.0F;  // all of it falls
  }
  water.fluid->restore(snapshot);
  EXPECT_TRUE(folds_of(water, s).empty());
  water.stir(1.0, 5);
  EXPECT_FALSE(folds_of(water, s).empty());
}

// The pool's bubbles are one matter, the told ones another: these use up the air that is folded in.
TEST(Folds, AreToldToTheLastBubble) {
  DetectSettings s;
  s.bubble_energy = 0.3;
  s.bubbles_per_second = 1.0e6;
  Device device;
  Water water = hanging_block();
  water.start(device);
  water.stir(1.0, 6);
  Bubbles bubbles(*water.fluid, detect_program(device), s, 7, 2000);
  std::set<int> places;
  for (std::uint32_t step = 1; step <= 100; ++step) {
    detect(water, bubbles, 0.004);
    for (const DetectedBubble& bubble : bubbles.collect(0.004 * step, 0.004, step)) {
      EXPECT_GE(bubble.radius, s.radius_min);
      EXPECT_LE(bubble.radius, s.radius_max);
      EXPECT_GT(bubble.time, 0.004 * (step - 1.0) - 1e-9);
      EXPECT_LE(bubble.time, 0.004 * step);
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
  Device device;
  Water water = hanging_block();
  water.start(device);
  water.stir(1.0, 6);
  Bubbles bubbles(*water.fluid, detect_program(device), s, 7, 2000);
  const auto air_of_frames = [&](double share, std::uint32_t first) {
    const double before = bubbles.air().entrapped;
    s.bubble_energy = share;
    bubbles.set(s);
    for (std::uint32_t step = first; step < first + 20; ++step) {
      detect(water, bubbles, 0.004);
      static_cast<void>(bubbles.collect(0.004 * step, 0.004, step));
    }
    return bubbles.air().entrapped - before;
  };
  const double some = air_of_frames(0.38, 1);
  EXPECT_GT(some, 0.0);
  EXPECT_EQ(air_of_frames(0.0, 21), 0.0);
  EXPECT_NEAR(air_of_frames(0.38, 41), some, 1e-6 * some);
}

TEST(Folds, AboveTheBudgetAreToldInLargerBubbles) {
  DetectSettings s;
  s.bubble_energy = 0.3;
  s.bubbles_per_second = 500.0;
  Device device;
  Water water = hanging_block();
  water.start(device);
  water.stir(1.0, 6);
  Bubbles bubbles(*water.fluid, detect_program(device), s, 7, 2000);
  int told = 0;
  for (std::uint32_t step = 1; step <= 100; ++step) {
    detect(water, bubbles, 0.004);
    told += static_cast<int>(bubbles.collect(0.004 * step, 0.004, step).size());
  }
  EXPECT_LE(told, 200 + 26);  // and what 50 ms left at first
  EXPECT_GT(bubbles.air().thinned, 0U);
  EXPECT_LE(bubbles.air().told, bubbles.air().entrapped + bubble_volume(s.radius_max));
}

}  // namespace
}  // namespace splash::sim
