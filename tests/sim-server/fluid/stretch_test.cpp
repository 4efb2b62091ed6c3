// SPDX-License-Identifier: MIT
// Water that pulls: the rule against its reference implementation, and what it is for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/health/health.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/gauge/water_state.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.02;
constexpr Vector3 kMiddle = {0.4, 0.4, 0.4};

/// A ball of six spacings in radius that nothing pulls down, in the middle of a tank of 0.8 m.
Water ball() {
  Scene scene = tank_scene(kSpacing, {0.8, 0.8, 0.8}, 0.1);
  scene.water = {{{0.28, 0.28, 0.28}, {0.52, 0.52, 0.52}, WaterForm::sphere}};
  scene.fluid.gravity = {0.0, 0.0, 0.0};
  return {.scene = scene, .particles = initial_particles(scene)};
}

/// From its middle.
void stretch(Fluid& fluid, double factor) {
  change_particles(fluid, [factor](int, Vector3& place, Vector3&) {
    place = kMiddle + factor * (place - kMiddle);
  });
}

/// Density of the particle nearest to the middle over rho0, as the next step finds it [1].
double density_inside(Water& water) {
  water.fluid->prepare(water.step_at(0.0));
  const FluidState state = read_state(*water.fluid);
  const auto nearest =
      std::min_element(state.position.begin(), state.position.end(),
                       [](auto& a, auto& b) { return length(a - kMiddle) < length(b - kMiddle); });
  return state.density[static_cast<std::size_t>(nearest - state.position.begin())] /
         static_cast<double>(state.params.rest_density);
}

class Stretch : public ::testing::TestWithParam<int> {};

TEST_P(Stretch, IsTheTwins) {
  Device device(-1, false, GetParam());
  Water water = ball();
  water.start(device);
  std::vector<double> peak(water.particles.size(), 0.0);  // by id
  constexpr double dt = 5.0e-4;
  int pulling = 0;
  int torn = 0;
  // Denser, stretched, held there, looser, torn, and together again.
  for (const double factor : {0.99, 1.02, 1.0, 0.995, 1.03, 0.95}) {
    stretch(*water.fluid, factor);
    water.fluid->prepare(water.step_at(dt));
    const FluidState state = read_state(*water.fluid);
    const double bound = 1.0e-5 * static_cast<double>(state.params.rest_density);
    const double sound2 = std::pow(static_cast<double>(state.params.sound_speed), 2);
    for (std::size_t i = 0; i < state.id.size(); ++i) {
      double& before = peak[static_cast<std::size_t>(state.id[i])];
      const double now = reference_peak_density(state.params, dt, state.density[i], before);
      ASSERT_NEAR(state.peak_density[i], now, bound) << "particle " << state.id[i];
      before = state.peak_density[i];
      const double rest = static_cast<double>(state.params.rest_density);
      ASSERT_NEAR(state.pressure_term[i],
                  reference_pressure_term(state.params, state.density[i], state.peak_density[i]),
                  1.0e-6 * sound2 / rest)
          << "particle " << state.id[i];
      pulling += state.pressure_term[i] < 0.0;
      torn += state.density[i] < static_cast<double>(state.params.torn_density);
    }
  }
  EXPECT_GT(pulling, 100);
  EXPECT_GT(torn, 100);
}

INSTANTIATE_TEST_SUITE_P(Lanes, Stretch, ::testing::Values(1, 0));

/// Gives the ball a speed of rate times the way from its middle, and runs for `seconds`.
void part_and_run(Device& device, Water& water, double rate, double seconds) {
  water.start(device);
  change_particles(*water.fluid, [rate](int, Vector3& place, Vector3& velocity) {
    velocity = rate * (place - kMiddle);
  });
  run(water, seconds);
}

// A ball of radius R that flies apart at u = rate R swings like a ball of elastic stuff (Lamb
// 1882): it stops at a stretch of the order of rate R / c0 after about R / c0. Rows of particles
// that do not pull fly on: in a tenth of a second by 1.09 here.
TEST(Stretched, WaterHoldsTogether) {
  Device device;
  Water water = ball();
  part_and_run(device, water, 0.9, 0.1);
  EXPECT_GT(density_inside(water), 0.97);
}

// What is torn does not grow together by itself, and what flies apart fast enough tears.
TEST(Stretched, WaterTears) {
  Device device;
  Water water = ball();
  part_and_run(device, water, 30.0, 0.05);
  EXPECT_LT(density_inside(water), 0.5);
}

// To tear it takes energy, and nothing gives any back. Speeds belong to the middle between two
// steps' places, so the kinetic energy is the mean of before and after.
TEST(Stretched, EnergyNeverGrows) {
  Device device;
  for (const double rate : {0.9, 5.0, 30.0}) {
    SCOPED_TRACE(rate);
    Water water = ball();
    part_and_run(device, water, rate, 0.0);
    const double dt = 0.1 * largest_time_step(water.params, 3.0, 10.0, 1.0);
    double before = 1.0e9;
    for (int k = 0; k < 400; ++k) {
      water.fluid->prepare(water.step_at(0.0));
      const Energies now = energies(read_water(*water.fluid, true));
      water.step(dt);
      const Energies next = energies(read_water(*water.fluid, true));
      const double total = now.compression + 0.5 * (now.kinetic + next.kinetic);
      EXPECT_LT(total, before * (1.0 + 1.0e-4)) << "step " << k;
      before = total;
    }
  }
}

/// A ball that was as dense as at rest.
Water pressed_ball(Device& device) {
  Water water = ball();
  water.start(device);
  stretch(*water.fluid, 0.99);
  water.fluid->prepare(water.step_at(0.0));
  return water;
}

/// What it presses with once it is moved outward by a fiftieth: it pulls.
std::vector<double> pull_of(Water& water) {
  stretch(*water.fluid, 1.02);
  water.fluid->prepare(water.step_at(0.0));
  const std::vector<double> pull = read_state(*water.fluid).pressure_term;
  EXPECT_LT(*std::min_element(pull.begin(), pull.end()), 0.0);
  return pull;
}

// A snapshot holds all that the next step depends on.
TEST(Stretched, ASnapshotRemembersIt) {
  Device device;
  Water water = pressed_ball(device);
  const Snapshot peak = water.fluid->snapshot();
  const std::vector<double> first = pull_of(water);
  Water other = ball();
  other.start(device);
  other.fluid->restore(peak);
  EXPECT_EQ(pull_of(other), first);
}

// So does a checkpoint, which frames that fail are taken back to.
TEST(Stretched, ACheckpointRemembersIt) {
  Device device;
  Water water = pressed_ball(device);
  Checkpoint checkpoint;
  checkpoint.keep(device, water.fluid->state());
  const std::vector<double> first = pull_of(water);
  stretch(*water.fluid, 1.2);
  water.fluid->prepare(water.step_at(0.0));  // torn
  checkpoint.recall(device, water.fluid->state());
  EXPECT_EQ(pull_of(water), first);
}

}  // namespace
}  // namespace splash::sim
