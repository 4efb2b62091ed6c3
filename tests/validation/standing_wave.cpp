// SPDX-License-Identifier: MIT
// The first sloshing mode: its period after Airy, and the viscosity that its decay betrays.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/validation/cases.hpp"
#include "tests/validation/sloshing.hpp"

namespace splash::validation {

namespace {

using std::numbers::pi;

constexpr double kLength = 1.0;  // of the scene [m]
constexpr double kDepth = 0.5;
constexpr double kAmplitude = 0.025;
const double kNumber = pi / kLength;
const double kOmega = std::sqrt(9.81 * kNumber * std::tanh(kNumber * kDepth));

/// Decay rate of the kinetic energy's maxima [1/s].
double decay(const Column& time, const Column& kinetic) {
  Column at;
  Column logarithm;
  for (std::size_t k = 2; k + 2 < time.size(); ++k) {
    const bool top = kinetic[k] >= kinetic[k - 1] && kinetic[k] > kinetic[k + 1] &&
                     kinetic[k] > kinetic[k - 2] && kinetic[k] > kinetic[k + 2];
    if (!top || (!at.empty() && time[k] - at.back() < 0.25 * 2.0 * pi / kOmega)) continue;
    at.push_back(time[k]);
    logarithm.push_back(std::log(kinetic[k]));
  }
  if (at.size() < 3) return std::nan("");
  return -fit_line(at, logarithm, at.front(), at.back()).second;
}

/// Decay rate of the mode itself, which noise in the velocities does not hide [1/s]: the centre of
/// mass swings as far sideways as it is high.
double mode_decay(const Column& time, const Column& centre) {
  return swing_decay(time, linear(1.0, centre, -0.5 * kLength), 0.0);
}

Outcome evaluate_standing_wave(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Column& time = run.gauges["time"];
  const Column slope = combine(0.5, run.gauges["left_height"], -0.5, run.gauges["right_height"]);
  const double period = period_of(time, slope);
  const double viscosity = decay(time, run.gauges["all_kinetic"]) / (4.0 * kNumber * kNumber);
  return {{{"period, error", 100.0 * (period * kOmega / (2.0 * pi) - 1.0), "%", -3.0, 3.0},
           {"viscosity from the mode's decay",
            mode_decay(time, run.gauges["mass_x"]) / (2.0 * kNumber * kNumber), "m2/s"},
           {"viscosity from the decay", viscosity, "m2/s"},
           {"the same over that asked for", viscosity / run.scene.fluid.viscosity, "1"},
           {"first crest", largest_between(time, slope, 0.0, 0.6) / kAmplitude, "of A"}},
          {{"", time, slope}}};
}

std::vector<Curve> reference_standing_wave() {
  Curve airy = {"Airy, nu = 1e-3 m2/s", {}, {}};
  for (int k = 0; k <= 600; ++k) {
    const double t = 0.01 * k;
    airy.x.push_back(t);
    // Lamb, Hydrodynamics, article 348: amplitudes fall as exp(-2 nu k^2 t).
    airy.y.push_back(kAmplitude * std::exp(-2.0e-3 * kNumber * kNumber * t) * std::sin(kOmega * t));
  }
  return {airy};
}

}  // namespace

Case standing_wave() {
  return {.name = "standing_wave",
          .title = "First sloshing mode, 1 m long, 0.5 m deep, 25 mm high",
          .scenes = {"standing_wave"},
          .seconds = 6.0,
          .spacings = {0.05, 0.025, 0.0125},
          .size = kDepth,
          .size_name = "H",
          .evaluate = evaluate_standing_wave,
          .reference = reference_standing_wave,
          .x_label = "time [s]",
          .y_label = "height at the wall, half of the difference [m]"};
}

}  // namespace splash::validation
