// SPDX-License-Identifier: MIT
// A dam breaks in a short tank: whatever the water does, its energy only falls, and where it ends
// at rest it has lost what a heap has over a level pool. Until then it sloshes, and nothing else is
// left of the splash.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/sloshing.hpp"

namespace splash::validation {

namespace {

// 0.2 x 0.3 m of water in a tank 0.6 m long: levels out at 0.1 m.
constexpr Basin kLevel = {.length = 0.6, .width = 0.12, .depth = 0.1};
constexpr double kFreed = 0.3 / 2.0 - 0.1 / 2.0;  // fall of the centre of mass [m]
constexpr double kSettled = 5.0;       // from then on the water sloshes without breaking [s]
constexpr double kViscosity = 1.0e-6;  // of real water, which rubs on walls [m2/s]

Outcome evaluate_closed_box(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Series& g = run.gauges;
  const Column& time = g["time"];
  const Column& total = g["sum_total"];
  const double freed = 998.0 * 0.2 * 0.12 * 0.3 * 9.81 * kFreed;
  const double rise = largest_rise(total);
  const Column lost = linear(-1.0 / freed, total, total.front() / freed);
  const Parts left = split(kLevel, run.places, run.velocities);
  const Column aside = linear(1.0, g["mass_x"], -0.5 * kLevel.length);
  return {
      {{"largest rise of energy, of what was freed", 100.0 * rise / freed, "%", 0.0, 0.1},
       {"lost by the end, of what was freed", 100.0 * lost.back(), "%"},
       {"momentum across, of mass times sqrt(gH)",
        100.0 *
            std::max(largest_between(time, g["all_y"], 0.0, 100.0),
                     -largest_between(time, linear(-1.0, g["all_y"]), 0.0, 100.0)) /
            (7.18 * 1.716),
        "%"},
       {"rms speed at the end", std::hypot(left.sloshing, left.rest), "m/s"},
       {"rms speed at the end, without six modes of sloshing", left.rest, "m/s", 0.0, 0.03},
       {"decay of the sloshing over that by walls that rub",
        swing_decay(time, aside, kSettled) / wall_decay(kLevel, kViscosity, 9.81), "1", 0.0, 2.0}},
      {{"", time, lost}}};
}

std::vector<Curve> reference_closed_box() {
  return {{"all that is freed", {0.0, 15.0}, {1.0, 1.0}}};
}

}  // namespace

Case closed_box() {
  return {.name = "closed_box",
          .title = "A dam breaks in a short tank: energy",
          .scenes = {"closed_box"},
          .seconds = 15.0,
          .spacings = {0.02, 0.0133333, 0.01},
          .size = 0.3,
          .size_name = "H",
          .evaluate = evaluate_closed_box,
          .reference = reference_closed_box,
          .x_label = "time [s]",
          .y_label = "energy lost over that freed"};
}

}  // namespace splash::validation
