// SPDX-License-Identifier: MIT
// Water at rest: its weight on the floor, the pressure above it, its level, and how calm it is.
#include <cmath>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kDepth = 0.3;  // of the scene [m]
constexpr double kLate = 5.0;   // from here on it has to be calm [s]

/// Mean over `places` gauges, numbered from 0.
Column mean_of(const Series& gauges, const std::string& name, int places,
               const std::string& quantity) {
  Column mean(gauges.size(), 0.0);
  for (int i = 0; i < places; ++i) {
    mean = combine(1.0, mean, 1.0 / places, gauges[name + std::to_string(i) + quantity]);
  }
  return mean;
}

Outcome evaluate_hydrostatic(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Series& g = run.gauges;
  const Column& time = g["time"];
  const double end = time.back();
  const double weight = run.scene.fluid.density * 9.81;
  const Column level = mean_of(g, "level", 5, "_height");
  const double floor = mean_between(time, mean_of(g, "floor", 25, "_pressure"), kLate, end);
  const double edge = mean_between(time, mean_of(g, "edge", 2, "_pressure"), kLate, end);
  double square = 0.0;
  Curve profile = {"", {}, {}};
  for (int i = 0; i < 6; ++i) {
    const double z = 0.05 * i;
    const double p = mean_between(time, g["line" + std::to_string(i) + "_pressure"], kLate, end);
    square += std::pow(p / (weight * kDepth) - (1.0 - z / kDepth), 2) / 6.0;
    profile.x.push_back(p);
    profile.y.push_back(z);
  }
  const double start = mean_between(time, level, 0.0, 0.5);
  const double last = mean_between(time, level, end - 0.5, end);
  const double wave = std::sqrt(9.81 * kDepth);
  const double fastest = largest_between(time, g["all_fastest"], kLate, end);
  const double rms = largest_between(time, g["all_rms"], kLate, end);
  return {{{"floor pressure, error", 100.0 * (floor / (weight * kDepth) - 1.0), "%", -1.0, 1.0},
           {"pressure in a corner and an edge of it, error",
            100.0 * (edge / (weight * kDepth) - 1.0), "%"},
           {"profile, rms of rho g H", 100.0 * std::sqrt(square), "%", 0.0, 2.0},
           {"level, error", (start - kDepth) / run.scene.fluid.spacing, "dp"},
           {"level, drift", (last - start) / run.scene.fluid.spacing, "dp", -0.25, 0.25},
           {"fastest particle after 5 s", 100.0 * fastest / wave, "% sqrt(gH)", 0.0, 1.0},
           {"rms speed after 5 s", 100.0 * rms / wave, "% sqrt(gH)"}},
          {profile}};
}

std::vector<Curve> reference_hydrostatic() {
  return {{"rho g (H - z)", {998.0 * 9.81 * kDepth, 0.0}, {0.0, kDepth}}};
}

}  // namespace

Case hydrostatic() {
  return {.name = "hydrostatic",
          .title = "Water 0.3 m deep at rest, 20 s",
          .scenes = {"hydrostatic"},
          .seconds = 20.0,
          .spacings = {0.03, 0.015, 0.01},
          .size = kDepth,
          .size_name = "H",
          .evaluate = evaluate_hydrostatic,
          .reference = reference_hydrostatic,
          .x_label = "pressure [Pa]",
          .y_label = "height [m]"};
}

}  // namespace splash::validation
