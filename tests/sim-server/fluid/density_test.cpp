// SPDX-License-Identifier: MIT
// Density and pressure against the double-precision reference.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

/// Relative. Measured at most 4.3e-6 with PoCL: tens of float
/// roundings of 6e-8.
constexpr double kBound = 1.0e-5;

class Density : public ::testing::TestWithParam<int> {};

TEST_P(Density, IsTheTwins) {
  Device device(-1, false, GetParam());
  double worst = 0.0;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.fluid->set_bodies(water.bodies->at(0.0));
    water.fluid->prepare(water.step_at(0.0));
    const FluidState state = read_state(*water.fluid, water.piston.offset);
    const std::vector<double> reference = reference_density(state);
    const double sound = static_cast<double>(state.params.sound_speed);
    for (std::size_t i = 0; i < reference.size(); ++i) {
      ASSERT_NEAR(state.density[i], reference[i], kBound * reference[i])
          << "particle " << state.id[i];
      worst = std::max(worst, std::abs(state.density[i] / reference[i] - 1.0));
      // The pressure is a small difference of densities: it inherits their absolute error.
      ASSERT_NEAR(state.pressure_term[i],
                  reference_pressure_term(state.params, reference[i], reference[i]),
                  2.0 * kBound * sound * sound / reference[i])
          << "particle " << state.id[i];
    }
  }
  RecordProperty("worst_relative_error", std::to_string(worst));
  std::printf("worst relative error of density: %.2e\n", worst);
}

// A particle that is no number any more must not lead any index astray: those out of its reach
// stay what they were.
TEST_P(Density, OfOthersOutlivesNoNumbers) {
  Device device(-1, false, GetParam());
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(), -3.0e38F, 3.0e38F}) {
    SCOPED_TRACE(bad);
    std::vector<Water> all = situations();
    Water& water = all.front();
    water.start(device);
    Snapshot snapshot = water.fluid->snapshot();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::size_t i : {7U, 300U}) {
        snapshot.position[part(*water.fluid, axis, i + axis)] = bad;
      }
    }
    water.fluid->restore(snapshot);
    water.step(1.0e-4);
    water.step(1.0e-4, [&](Fluid& fluid) {
      const FluidState state = read_state(fluid);
      std::vector<int> seen(state.id.size(), 0);
      for (const int id : state.id) {
        ASSERT_GE(id, 0);
        ASSERT_LT(id, water.params.count);
        EXPECT_EQ(++seen[static_cast<std::size_t>(id)], 1) << "id " << id;
      }
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Builds, Density, kLaneCounts, lanes_name);

}  // namespace
}  // namespace splash::sim
