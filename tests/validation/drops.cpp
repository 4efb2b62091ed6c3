// SPDX-License-Identifier: MIT
// Drops: one drawn out in free fall, its axes after Monaghan 1994, J. Comput. Phys. 110, section 6,
// with its momentum; and one that swings in a central field, after Monaghan & Rafiee 2013, Int. J.
// Numer. Meth. Fluids 71. Nothing may add energy to either.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kRadius = 0.1;  // of both scenes [m]
constexpr double kDrawn = 10.0;  // rate at which the one in free fall is drawn out [1/s]
constexpr double kEnd = 0.0754;  // Monaghan's last time, 7.54 ms at 100 /s [s]

constexpr double kField = 10.0;      // Omega [1/s]
constexpr double kSwung = 5.0;       // sigma of the one that swings, at the start [1/s]
constexpr double kPeriod = 0.45674;  // 4.5674 / Omega for sigma = Omega / 2 [s]
constexpr double kSeconds = 4 * kPeriod;

/// Half axes of the exact ellipse over R; time [s].
///   d sigma/dt = (sigma^2 + Omega^2) (b^2 - a^2) / (b^2 + a^2),  da/dt = sigma a,  b = 1 / a
struct Exact {
  Column time, a, b;
};

Exact axes_of(double sigma, double field, double end) {
  constexpr int kSteps = 40000;
  const double dt = end / kSteps;
  Exact exact;
  double a = 1.0;
  const auto change = [field](double x, double s) {
    const double x4 = x * x * x * x;
    return std::pair{s * x, (s * s + field * field) * (1.0 - x4) / (1.0 + x4)};
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

std::vector<Curve> curves_of(const Exact& exact) {
  return {{"exact", exact.time, exact.a}, {"exact", exact.time, exact.b}};
}

Outcome evaluate_elliptical_drop(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Series& g = run.gauges;
  const Column& time = g["time"];
  const Column shorter = linear(2.0 / kRadius, g["drop_sz"]);
  const Column longer = linear(2.0 / kRadius, g["drop_sx"]);
  const Exact exact = axes_of(-kDrawn, 0.0, kEnd);
  const double a = interpolate(time, shorter, kEnd);
  const double b = interpolate(time, longer, kEnd);
  const Column& energy = g["sum_total"];
  const double rise = largest_rise(energy);
  const double mass = 998.0 * M_PI * kRadius * kRadius * 0.02;
  double drift = 0.0;
  for (const char* axis : {"all_x", "all_z"}) {  // the walls push along y
    for (const double p : g[axis]) drift = std::max(drift, std::abs(p - g[axis].front()));
  }
  return {{{"short axis, error", 100.0 * (a / exact.a.back() - 1.0), "%", -2.0, 2.0},
           {"long axis, error", 100.0 * (b / exact.b.back() - 1.0), "%", -2.0, 2.0},
           {"radius at the start, error", 100.0 * (shorter.front() - 1.0), "%"},
           {"energy left", 100.0 * energy.back() / energy.front(), "%"},
           {"largest rise of energy", 100.0 * rise / energy.front(), "%", 0.0, 0.01},
           {"momentum, of mass times speed", 100.0 * drift / (mass * kDrawn * kRadius), "%", 0.0,
            0.001}},
          {{"short ", time, shorter}, {"long ", time, longer}}};
}

std::vector<Curve> reference_elliptical_drop() {
  return curves_of(axes_of(-kDrawn, 0.0, 1.0 / kDrawn));
}

Outcome evaluate_oscillating_drop(const std::vector<Run>& runs) {
  const Series& g = runs.front().gauges;
  const Column& time = g["time"];
  const Column a = linear(2.0 / kRadius, g["drop_sx"]);
  const Column b = linear(2.0 / kRadius, g["drop_sz"]);
  const double period = period_of(time, combine(1.0, a, -1.0, b));
  const Exact exact = axes_of(kSwung, kField, kSeconds);
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
  return curves_of(axes_of(kSwung, kField, kSeconds));
}

}  // namespace

Case elliptical_drop() {
  return {.name = "elliptical_drop",
          .title = "A round drop drawn out in free fall",
          .scenes = {"elliptical_drop"},
          .seconds = 0.08,
          .spacings = {0.01, 0.005, 0.0025},
          .size = kRadius,
          .size_name = "R",
          .evaluate = evaluate_elliptical_drop,
          .reference = reference_elliptical_drop,
          .x_label = "time [s]",
          .y_label = "half axes [R]"};
}

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
