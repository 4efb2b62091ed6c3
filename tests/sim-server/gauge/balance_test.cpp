// SPDX-License-Identifier: MIT
// Energies, momentum and spread of water whose sums have a closed form.
#include "sim-server/gauge/water_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/gauge/lattice.hpp"

namespace splash::sim {
namespace {

/// The integral of p / rho^2 from `from` to `density`, by midpoints, where it is `term` [J/kg].
double work(double from, double density, const std::function<double(double)>& term) {
  constexpr int kParts = 200000;
  const double step = (density - from) / kParts;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) sum += term(from + step * (i + 0.5)) * step;
  return sum;
}

TEST(Balance, CompressionIsTheWorkDoneOnTheWater) {
  const WaterState water = lattice_water({0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}, 0.05);
  const double sound2 = water.sound_speed * water.sound_speed;
  const double pushed =
      work(1000.0, 1040.0, [sound2](double rho) { return sound2 * (rho - 1000.0) / (rho * rho); });
  EXPECT_NEAR(compression_energy(water, 1040.0, 1000.0) / pushed, 1.0, 1e-9);
  EXPECT_EQ(compression_energy(water, 1000.0, 1000.0), 0.0);
}

TEST(Balance, AStretchTakesWorkFromTheKnitOn) {
  const WaterState water = lattice_water({0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}, 0.05);
  const double sound2 = water.sound_speed * water.sound_speed;
  const double pulled =
      work(980.0, 940.0, [sound2](double rho) { return 0.5 * sound2 * (rho - 980.0) / 1.0e6; });
  EXPECT_NEAR(compression_energy(water, 940.0, 980.0) / pulled, 1.0, 1e-9);
  EXPECT_EQ(compression_energy(water, 990.0, 980.0), 0.0) << "neither pushes nor pulls";
  EXPECT_EQ(compression_energy(water, 500.0, 500.0), 0.0) << "torn";
}

TEST(Balance, EnergiesOfABlockThatMovesAsOne) {
  WaterState water = lattice_water({0.0, 0.0, 1.0}, {0.1, 0.2, 1.4}, 0.01);
  water.density.assign(water.position.size(), 1010.0);
  water.peak_density.assign(water.position.size(), 1000.0);
  for (Vector3& v : water.velocity) v = {0.3, 0.0, -0.4};
  const double mass = 1000.0 * 0.1 * 0.2 * 0.4;
  const Energies e = energies(water);
  EXPECT_NEAR(e.kinetic, 0.5 * mass * 0.25, 1e-9);
  EXPECT_NEAR(e.potential, mass * 9.81 * 1.2, 1e-9);
  EXPECT_NEAR(e.compression, mass * compression_energy(water, 1010.0, 1000.0), 1e-12);
  EXPECT_NEAR(e.total(), e.kinetic + e.potential + e.compression, 1e-12);
}

// A leapfrog's velocities are those of half a step before its positions: of a fall from rest the
// sum of energies never changes.
TEST(Balance, EnergyOfAFallInStepsStays) {
  WaterState water = lattice_water({0.0, 0.0, 5.0}, {0.1, 0.1, 5.1}, 0.05);
  water.density.assign(water.position.size(), 1000.0);
  water.peak_density.assign(water.position.size(), 1000.0);
  constexpr double kStep = 0.01;
  water.lag = 0.5 * kStep;
  double first = 0.0;
  for (int k = 0; k < 50; ++k) {
    for (std::size_t i = 0; i < water.position.size(); ++i) {
      water.velocity[i][2] = -9.81 * (k + 0.5) * kStep;
      water.position[i][2] += kStep * water.velocity[i][2];
    }
    const double total = energies(water).total();
    if (k == 0) first = total;
    ASSERT_NEAR(total / first, 1.0, 1.0e-12) << k;
  }
}

TEST(Balance, ACentralFieldHasAPotentialWhoseSlopeItIs) {
  WaterState water = lattice_water({0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}, 0.05);
  water.pull = {4.0, 0.0, 9.0};
  water.pull_centre = {0.2, 5.0, -0.1};
  const Vector3 place = {0.5, 0.3, 0.4};
  constexpr double kWay = 1.0e-4;
  const auto potential = [&](const Vector3& x) { return water.potential_at(x); };
  const Vector3 slope = (0.5 / kWay) * differences(potential, place, kWay);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(water.field_at(place)[axis], -slope[axis], 1e-6);
  }
  EXPECT_NEAR(water.field_at(place)[0], -4.0 * 0.3, 1e-12);
  EXPECT_NEAR(water.field_at(place)[2], -9.81 - 9.0 * 0.5, 1e-12);
  EXPECT_NEAR(water.potential_at({0.7, 0.0, -0.1}), -0.981 + 0.5 * 4.0 * 0.25, 1e-12);
}

TEST(Balance, MomentumOfTurningWaterIsNone) {
  WaterState water = lattice_water({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.1}, 0.01);
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    const Vector3& x = water.position[i];
    water.velocity[i] = {-2.0 * x[1], 2.0 * x[0], 0.0};
  }
  const Momentum turning = momentum(water);
  for (const double part : turning.sum) EXPECT_NEAR(part, 0.0, 1e-12);
  EXPECT_NEAR(turning.fastest, 2.0 * std::hypot(0.095, 0.095), 1e-12);
  // Mean of x^2 over n midpoints: L^2/12 (1 - 1/n^2).
  const double mean_square = 0.2 * 0.2 / 12.0 * (1.0 - 1.0 / 400.0);
  EXPECT_NEAR(turning.rms, 2.0 * std::sqrt(2.0 * mean_square), 1e-12);
  for (Vector3& v : water.velocity) v[2] = 0.5;
  EXPECT_NEAR(momentum(water).sum[2], 1000.0 * 0.004 * 0.5, 1e-9);
}

TEST(Balance, SpreadOfADiscIsHalfItsRadius) {
  const Vector3 centre = {0.3, 0.0, 0.2};
  const WaterState water = lattice_water(
      {0.2, 0.0, 0.1}, {0.4, 0.02, 0.3}, 0.002,
      [&](const Vector3& x) { return std::hypot(x[0] - centre[0], x[2] - centre[2]) < 0.1; });
  const Spread s = spread(water);
  EXPECT_NEAR(s.centre[0], 0.3, 1e-12);
  EXPECT_NEAR(s.centre[2], 0.2, 1e-12);
  EXPECT_NEAR(s.deviation[0], 0.05, 1e-4);
  EXPECT_NEAR(s.deviation[2], 0.05, 1e-4);
}

}  // namespace
}  // namespace splash::sim
