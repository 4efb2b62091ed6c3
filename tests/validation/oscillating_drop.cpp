// SPDX-License-Identifier: MIT
// A drop that swings in a central field: its axes after Monaghan & Rafiee 2013, Int. J. Numer.
// Meth. Fluids 71, and energy, which nothing may add.
#include <cmath>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kRadius = 0.1;      // of the scene [m]
constexpr double kField = 10.0;      // Omega [1/s]
constexpr double kRate = 5.0;        // sigma at the start [1/s]
constexpr double kPeriod = 0.45674;  // 4.5674 / Omega for sigma = Omega / 2 [s]
constexpr double kSeconds = 4 * kPeriod;

/// Half axes of the exact ellipse over R along x and z; time [s].
///   d sigma/dt = (sigma^2 + Omega^2) (b^2 - a^2) / (b^2 + a^2),  da/dt = sigma a,  b = 1 / a
struct Exact {
  Column time, a, b;
};

Exact integrate() {
  constexpr int kSteps = 40000;
  const double dt = kSeconds / kSteps;
  Exact exact;
  double a = 1.0;
  double sigma = kRate;
  const auto change = [](double x, double s) {
    const double x4 = x * x * x * x;
    return std::pair{s * x, (s * s + kField * kField) * (1.0 - x4) / (1.0 + x4)};
  };
  for (int k = 0; k <= kSteps; ++k) {
    if (k % 100 == 0) {
      exact.time.push_back(k * dt);
      exact.a.push_back(a);
      exact.b.push_back(1.0 / a);
    }
    const auto [half_a, half_sigma] = change(a, sigma);
    const auto [da, dsigma] = change(a + 0.5 * dt * half_a, sigma + 0.5 * dt * half_sigma);
    a += dt * da;
    sigma += dt * dsigma;
  }
  return exact;
}

/// Twice the mean distance of the crossings of a sum that swings about zero.
double period_of(const Column& time, const Column& swing) {
  const Column crossings = zero_crossings(time, swing);
  if (crossings.size() < 3) return std::nan("");
  return 2.0 * (crossings.back() - crossings[0]) / (static_cast<double>(crossings.size()) - 1.0);
}

Outcome evaluate_oscillating_drop(const std::vector<Run>& runs) {
  const Series& g = runs.front().gauges;
  const Column& time = g["time"];
  const Column a = combine(2.0 / kRadius, g["drop_sx"], 0.0, time);
  const Column b = combine(2.0 / kRadius, g["drop_sz"], 0.0, time);
  const double period = period_of(time, combine(1.0, a, -1.0, b));
  const Exact exact = integrate();
  const double stretch = largest_between(exact.time, exact.a, 0.0, kPeriod);
  const Column& energy = g["sum_total"];
  const double rise = largest_rise(energy);
  // What swings; the rest holds the drop together.
  const double swing = g["sum_kinetic"].front();
  return {{{"period, error", 100.0 * (period / kPeriod - 1.0), "%", -3.0, 3.0},
           {"axis after one period, error", 100.0 * (interpolate(time, a, kPeriod) - 1.0), "%",
            -2.0, 2.0},
           {"longest axis of the first period, error",
            100.0 * (largest_between(time, a, 0.0, kPeriod) / stretch - 1.0), "%"},
           {"radius at the start, error", 100.0 * (a.front() - 1.0), "%"},
           {"energy of the swing lost in one period",
            100.0 * (energy.front() - interpolate(time, energy, kPeriod)) / swing, "%"},
           {"largest rise of energy, of the swing's", 100.0 * rise / swing, "%", 0.0, 0.1}},
          {{"along x ", time, a}, {"along z ", time, b}}};
}

std::vector<Curve> reference_oscillating_drop() {
  const Exact exact = integrate();
  return {{"exact", exact.time, exact.a}, {"exact", exact.time, exact.b}};
}

}  // namespace

Case oscillating_drop() {
  return {.name = "oscillating_drop",
          .title = "A drop swings in a central field",
          .scenes = {"oscillating_drop"},
          .seconds = kSeconds,
          .spacings = {0.01, 0.005, 0.0025},
          .size = kRadius,
          .size_name = "R",
          .evaluate = evaluate_oscillating_drop,
          .reference = reference_oscillating_drop,
          .x_label = "time [s]",
          .y_label = "half axes [R]"};
}

}  // namespace splash::validation
