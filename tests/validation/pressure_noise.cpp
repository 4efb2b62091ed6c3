// SPDX-License-Identifier: MIT
// Pressure of water that sloshes changes slowly: what a sensor reads a thousand times a second,
// less its mean over a tenth of sqrt(H / g) around, is noise of the solver. From a dam break's
// first impact on; H is the water's height behind the gate.
#include <cmath>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kHeight = 0.3;                     // [m]
constexpr double kWeight = 998.0 * 9.81 * kHeight;  // [Pa]
constexpr double kMeanOver = 0.1;                   // [sqrt(H/g)]
constexpr double kFrom = 0.6, kTo = 3.0;            // the wave has met the far wall [s]

/// Of `pressure` less its mean over `window` around, between kFrom and kTo: rms [Pa].
double noise(const Column& time, const Column& pressure, double window) {
  double square = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (time[k] < kFrom || time[k] > kTo) continue;
    const double mean =
        mean_between(time, pressure, time[k] - 0.5 * window, time[k] + 0.5 * window);
    square += std::pow(pressure[k] - mean, 2);
    ++count;
  }
  return std::sqrt(square / count);
}

Outcome evaluate_pressure_noise(const std::vector<Run>& runs) {
  const Series& g = runs.front().gauges;
  const Column& time = g["time"];
  const double window = kMeanOver * std::sqrt(kHeight / 9.81);
  const Column& floor = g["floor_pressure"];
  const Column& wall = g["wall_pressure"];
  return {{{"noise in the floor, rms of rho g H", 100.0 * noise(time, floor, window) / kWeight, "%",
            0.0, 4.0},
           {"noise in the wall, rms of rho g H", 100.0 * noise(time, wall, window) / kWeight, "%",
            0.0, 4.0}},
          {{"", time, floor}}};
}

}  // namespace

Case pressure_noise() {
  return {.name = "pressure_noise",
          .title = "A dam breaks in a short tank: noise of pressures",
          .scenes = {"pressure_noise"},
          .seconds = 3.1,
          .spacings = {0.02, 0.0133333, 0.01},
          .size = kHeight,
          .size_name = "H",
          .evaluate = evaluate_pressure_noise,
          .reference =
              [] {
                return std::vector<Curve>{{"at rest", {0.0, 3.1}, {979.0, 979.0}}};
              },
          .x_label = "time [s]",
          .y_label = "pressure in the floor [Pa]"};
}

}  // namespace splash::validation
