// SPDX-License-Identifier: MIT
// A dam breaks in a short tank: whatever the water does, its energy only falls, and where it ends
// at rest it has lost what a heap has over a level pool.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

// 0.2 x 0.3 m of water in a tank 0.6 m long: levels out at 0.1 m.
constexpr double kFreed = 0.3 / 2.0 - 0.1 / 2.0;  // fall of the centre of mass [m]

Outcome evaluate(const std::vector<Run>& runs) {
  const Series& g = runs.front().gauges;
  const Column& time = g["time"];
  const Column& total = g["sum_total"];
  const double freed = 998.0 * 0.2 * 0.12 * 0.3 * 9.81 * kFreed;
  const double rise = largest_rise(total);
  const Column lost =
      combine(-1.0 / freed, total, total.front() / freed, Column(total.size(), 1.0));
  return {{{"largest rise of energy, of what was freed", 100.0 * rise / freed, "%", 0.0, 0.1},
           {"lost by the end, of what was freed", 100.0 * lost.back(), "%"},
           {"momentum across, of mass times sqrt(gH)",
            100.0 *
                std::max(largest_between(time, g["all_y"], 0.0, 100.0),
                         -largest_between(time, combine(-1.0, g["all_y"], 0.0, time), 0.0, 100.0)) /
                (7.18 * 1.716),
            "%"}},
          {{"", time, lost}}};
}

std::vector<Curve> reference() {
  return {{"all that is freed", {0.0, 4.0}, {1.0, 1.0}}};
}

}  // namespace

Case closed_box() {
  return {.name = "closed_box",
          .title = "A dam breaks in a short tank: energy",
          .scenes = {"closed_box"},
          .seconds = 4.0,
          .spacings = {0.02, 0.0133333, 0.01},
          .size = 0.3,
          .size_name = "H",
          .evaluate = evaluate,
          .reference = reference,
          .x_label = "time [s]",
          .y_label = "energy lost over that freed"};
}

}  // namespace splash::validation
