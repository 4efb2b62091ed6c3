// SPDX-License-Identifier: MIT
// A drop drawn out in free fall: its axes after Monaghan 1994, J. Comput. Phys. 110, section 6;
// momentum; and energy, which nothing may add.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kRadius = 0.1;  // of the scene [m]
constexpr double kRate = 10.0;   // [1/s]
constexpr double kEnd = 0.0754;  // Monaghan's last time, 7.54 ms at 100 /s [s]

/// Half axes of the exact ellipse over R, the short one first; time in 1 / rate.
///   da/dt = -a A,  dA/dt = A^2 (a^4 - 1) / (a^4 + 1),  b = 1 / a
struct Exact {
  Column time, a, b;
};

Exact integrate(double end) {
  constexpr int kSteps = 20000;
  Exact exact;
  double a = 1.0;
  double rate = 1.0;
  const double dt = end / kSteps;
  const auto change = [](double x, double s) {
    const double x4 = x * x * x * x;
    return std::pair{-x * s, s * s * (x4 - 1.0) / (x4 + 1.0)};
  };
  for (int k = 0; k <= kSteps; ++k) {
    if (k % 100 == 0) {
      exact.time.push_back(k * dt);
      exact.a.push_back(a);
      exact.b.push_back(1.0 / a);
    }
    const auto [half_a, half_rate] = change(a, rate);
    const auto [da, drate] = change(a + 0.5 * dt * half_a, rate + 0.5 * dt * half_rate);
    a += dt * da;
    rate += dt * drate;
  }
  return exact;
}

Outcome evaluate_elliptical_drop(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Series& g = run.gauges;
  const Column& time = g["time"];
  const Column shorter = combine(2.0 / kRadius, g["drop_sz"], 0.0, time);
  const Column longer = combine(2.0 / kRadius, g["drop_sx"], 0.0, time);
  const Exact exact = integrate(kRate * kEnd);
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
           {"momentum, of mass times speed", 100.0 * drift / (mass * kRate * kRadius), "%", 0.0,
            0.001}},
          {{"short ", time, shorter}, {"long ", time, longer}}};
}

std::vector<Curve> reference_elliptical_drop() {
  const Exact exact = integrate(1.0);
  const Column time = combine(1.0 / kRate, exact.time, 0.0, exact.time);
  return {{"exact", time, exact.a}, {"exact", time, exact.b}};
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

}  // namespace splash::validation
