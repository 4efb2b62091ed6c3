// SPDX-License-Identifier: MIT
// Water in a tank that is accelerated, rocked, shaken and turned, against what theory says of it,
// with every solver.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

class TankMotions : public ::testing::TestWithParam<const char*> {};

/// The gauges' rows of a run, after each frame.
std::vector<std::vector<double>> run(const std::string& scene_text, double seconds) {
  Device device;
  const Scene scene = parse_scene(scene_text, "tank.yaml");
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  std::vector<std::vector<double>> rows;
  while (simulation.seconds() < seconds) {
    const FrameResult frame = simulation.advance();
    EXPECT_FALSE(frame.step_fault) << describe_fault(*frame.step_fault);
    rows.push_back(gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies()));
  }
  return rows;
}

/// Mean of a column over the rows from a time on.
double mean(const std::vector<std::vector<double>>& rows, std::size_t column, double from) {
  double sum = 0.0;
  int count = 0;
  for (const auto& row : rows) {
    if (row[0] < from) continue;
    sum += row[column];
    ++count;
  }
  return sum / count;
}

/// A tank 0.4 m long with 0.12 m of water, and two gauges 0.3 m apart.
std::string short_tank(const std::string& solver, const std::string& motion,
                       double spacing = 0.02) {
  return "fluid: {spacing: " + std::to_string(spacing) + ", solver: " + solver +
         "}\n"
         "tank: {lower: [0, 0, 0], upper: [0.4, 0.12, 0.4]}\n"
         "water: [{lower: [0, 0, 0], upper: [0.4, 0.12, 0.12]}]\n"
         "tank_motion: {" +
         motion +
         "}\n"
         "gauges:\n"
         "  probes:\n"
         "    - {name: low, kind: height, x: 0.05, y: 0.06}\n"
         "    - {name: high, kind: height, x: 0.35, y: 0.06}\n";
}

// The surface stands across gravity less acceleration: tan = a / g. It swings a little about that
// with the first mode, of 0.83 s: the mean is of three of its periods.
TEST_P(TankMotions, AcceleratedWaterTiltsByAOverG) {
  const auto rows = run(short_tank(GetParam(),
                                   "samples: [{time: 0}, "
                                   "{time: 0.83, acceleration: [1.5, 0, 0]}]"),
                        0.83 + 2.49);
  const double slope = (mean(rows, 3, 0.83) - mean(rows, 1, 0.83)) / 0.3;
  std::printf("%s: slope %.4f, -a/g %.4f\n", GetParam(), slope, -1.5 / 9.81);
  EXPECT_NEAR(slope, -1.5 / 9.81, 0.05 * 1.5 / 9.81);
}

// A narrow channel that turns about its middle: z = mean + w^2 (x^2 - mean of x^2) / (2 g). Its
// sides carry Coriolis' force. It swings about that with the second mode, of 0.52 s: the mean is of
// three of its periods.
TEST_P(TankMotions, SpunWaterStandsOnAParabola) {
  const std::string text = std::string("fluid: {spacing: 0.02, solver: ") + GetParam() + R"(}
tank: {lower: [-0.2, -0.04, 0], upper: [0.2, 0.04, 0.4]}
water: [{lower: [-0.2, -0.04, 0], upper: [0.2, 0.04, 0.12]}]
tank_motion: {samples: [{time: 0, spin: [0, 0, 5]}]}
gauges:
  probes:
    - {name: middle, kind: height, x: 0, y: 0}
    - {name: left, kind: height, x: -0.16, y: 0}
    - {name: right, kind: height, x: 0.16, y: 0}
)";
  const auto rows = run(text, 0.52 + 1.56);
  const double middle = mean(rows, 1, 0.52);
  const double left = mean(rows, 3, 0.52) - middle, right = mean(rows, 5, 0.52) - middle;
  const double rise = 25.0 * 0.16 * 0.16 / (2.0 * 9.81);
  std::printf("%s: left %.4f, right %.4f of %.4f m\n", GetParam(), left, right, rise);
  EXPECT_NEAR(left, rise, 0.003) << "a seventh of the spacing";
  EXPECT_NEAR(right, rise, 0.003);
}

INSTANTIATE_TEST_SUITE_P(Solvers, TankMotions,
                         ::testing::Values("weakly_compressible", "grid_projected"),
                         [](const auto& solver) { return std::string(solver.param); });

// Rocked slowly, at a fifth of the first mode's frequency, the surface stays level in the world,
// and a twentieth more: 1 / (1 - (f / f1)^2). With the solver that keeps waves.
TEST(TankMotion, RockedSlowlyTheSurfaceStaysLevel) {
  const double period = 4.15;
  const auto rows = run(
      short_tank("grid_projected", "roll: [0, 4, 0], pivot: [0.2, 0.06, 0], period: 4.15, ramp: 1"),
      1.1 + period);
  // Part of sin(omega t) in the slope, over one period.
  double part = 0.0, sum = 0.0;
  for (const auto& row : rows) {
    if (row[0] < 1.1) continue;
    const double sine = std::sin(2.0 * std::numbers::pi * row[0] / period);
    part += sine * (row[3] - row[1]) / 0.3;
    sum += sine * sine;
  }
  const double wanted = std::tan(4.0 * std::numbers::pi / 180.0) / (1.0 - 0.2 * 0.2);
  std::printf("slope %.4f, level in the world %.4f\n", part / sum, wanted);
  EXPECT_NEAR(part / sum, wanted, 0.06 * wanted);
}

// Swayed from rest at 0.7 times the first mode's frequency. Linear theory (Ibrahim 2005), for the
// height at the wall x = 0: b_n'' + w_n^2 b_n = k_n tanh(k_n h) 4 L / (n pi)^2 X'', odd n.
TEST(TankMotion, SwayedWaterSloshesAsLinearTheorySays) {
  const double length = 0.4, depth = 0.12, g = 9.81;
  const double first = std::numbers::pi / length;
  const double omega1 = std::sqrt(g * first * std::tanh(first * depth));
  const double period = 2.0 * std::numbers::pi / (0.7 * omega1);
  std::string text = short_tank(
      "grid_projected", "sway: [0.012, 0, 0], ramp: 0.6, period: " + std::to_string(period), 0.015);
  const auto rows = run(text, 2.4);
  TankMotion tank(
      {.present = true, .sway = {0.012, 0.0, 0.0}, .period = period, .ramp = 0.6, .samples = {}},
      {0.0, 0.0, 0.0});
  double off = 0.0, size = 0.0, b[3] = {}, rate[3] = {}, t = 0.0;
  const double dt = 1.0e-4;
  for (const auto& row : rows) {
    for (; t < row[0]; t += dt) {
      const double felt = tank.at(t).gravity[0];
      for (int m = 0; m < 3; ++m) {
        const double n = 2.0 * m + 1.0;
        const double k = n * first;
        const double lift = k * std::tanh(k * depth);
        const double push = 4.0 * length / (n * n * std::numbers::pi * std::numbers::pi);
        rate[m] += dt * lift * (-g * b[m] - push * felt);
        b[m] += dt * rate[m];
      }
    }
    double wanted = 0.0;
    for (int m = 0; m < 3; ++m) {
      const double k = (2.0 * m + 1.0) * first;
      wanted += b[m] * (std::cos(k * 0.05) - std::cos(k * 0.35));
    }
    const double miss = (row[1] - row[3]) - wanted;
    off += miss * miss;
    size += wanted * wanted;
  }
  std::printf("rms off by %.3f of the wave's\n", std::sqrt(off / size));
  EXPECT_LT(std::sqrt(off / size), 0.2);
}

}  // namespace
}  // namespace splash::sim
