// SPDX-License-Identifier: MIT
// A gate with water on both sides of it keeps both until time begins; then the higher one runs into
// the lower as Stoker says.
#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/lattice.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/support/vectors.hpp"

namespace splash::sim {
namespace {

constexpr double kGate = 0.5;   ///< [m]
constexpr double kHigh = 0.2;   ///< water left of it [m]
constexpr double kLow = 0.08;   ///< and right of it [m]
constexpr double kWidth = 0.1;  ///< of the tank [m]

Scene wet_bed() {
  return parse_scene(
      "fluid: {spacing: 0.0134, solver: weakly_compressible}\n"
      "tank: {lower: [0, 0, 0], upper: [1.5, 0.1, 0.4]}\n"
      "gate: {x: 0.5}\n"
      "skip: {sleep: false}\n"
      "water:\n"
      "  - {lower: [0, 0, 0], upper: [0.5, 0.1, 0.2]}\n"
      "  - {lower: [0.5, 0, 0], upper: [1.5, 0.1, 0.08]}\n",
      "wet.yaml");
}

/// Depth of what is between two x, by its volume [m].
double depth(const std::vector<Vector3>& places, double from, double to, double particle) {
  double count = 0.0;
  for (const Vector3& x : places) count += x[0] >= from && x[0] < to;
  return count * particle / ((to - from) * kWidth);
}

/// Between bore and rarefaction (Stoker 1957, Water Waves, section 10.8): depth, and speed of the
/// bore.
struct Stoker {
  double middle = 0.0;  ///< [m]
  double bore = 0.0;    ///< [m/s]
};
Stoker stoker() {
  constexpr double kGravity = 9.81;
  double low = kLow;
  double high = kHigh;
  Stoker wave;
  for (int k = 0; k < 60; ++k) {
    wave.middle = 0.5 * (low + high);
    const double rarefied = 2.0 * (std::sqrt(kGravity * kHigh) - std::sqrt(kGravity * wave.middle));
    const double pushed =
        (wave.middle - kLow) * std::sqrt(0.5 * kGravity * (1.0 / wave.middle + 1.0 / kLow));
    (rarefied > pushed ? low : high) = wave.middle;
    wave.bore = pushed * wave.middle / (wave.middle - kLow);
  }
  return wave;
}

TEST(WetBed, IsHeldUntilTimeBeginsAndThenRunAcross) {
  Device device;
  Simulation simulation(device, wet_bed(), {});
  const double particle = particle_volume(simulation.scene());
  const Snapshot first = simulation.fluid().snapshot();
  const auto start = tests::vectors_of(first.position, first.id.size());
  EXPECT_NEAR(depth(start, 0.0, kGate, particle), kHigh, 0.01 * kHigh) << "what weighs is more";
  EXPECT_NEAR(depth(start, kGate, 1.5, particle), kLow, 0.01 * kLow);
  const double spacing = particle_spacing(simulation.scene());
  double left = 0.0;
  double right = 0.0;
  for (const Vector3& x : start) {
    double& top = x[0] < kGate ? left : right;
    top = std::max(top, x[2]);
  }
  EXPECT_NEAR(left, kHigh - 0.7 * spacing, 0.4 * spacing);
  EXPECT_NEAR(right, kLow - 0.7 * spacing, 0.4 * spacing);
  for (const Vector3& v : tests::vectors_of(first.velocity, first.id.size())) {
    EXPECT_EQ(v, (Vector3{0.0, 0.0, 0.0}));
  }
  for (const SupportState how : simulation.support_states())
    EXPECT_EQ(how, SupportState::supported);
  while (simulation.seconds() < 0.35) ASSERT_FALSE(simulation.advance().step_fault);
  const Stoker wave = stoker();
  const Snapshot later = simulation.fluid().snapshot();
  const auto now = tests::vectors_of(later.position, later.id.size());
  const double t = simulation.seconds();
  const double behind = kGate + 0.3 * wave.bore * t;
  const double ahead = kGate + 0.8 * wave.bore * t;
  const double middle = depth(now, behind, ahead, particle);
  EXPECT_NEAR(middle, wave.middle, 0.5 * spacing);
  EXPECT_NEAR(depth(now, kGate + wave.bore * t + 0.15, 1.4, particle), kLow, 0.25 * spacing);
}

}  // namespace
}  // namespace splash::sim
