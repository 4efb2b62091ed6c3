// SPDX-License-Identifier: MIT
// Fronts of collapsing columns twice as high as wide, against Martin & Moyce 1952 and Koshizuka &
// Oka 1996.
#include <cmath>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kLargestShift = 0.3;  // an experiment's gate takes time to open [1]

/// rms of Z / Z_reference - 1 when the experiment lags by `shift`.
double front_error(const Column& time, const Column& front, const Series& reference, double shift) {
  const Column& at = reference["T"];
  const Column& z = reference["Z"];
  double square = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (at[k] - shift > time.back()) continue;
    square += std::pow(interpolate(time, front, at[k] - shift) / z[k] - 1.0, 2);
    ++count;
  }
  return std::sqrt(square / count);
}

Outcome compare(const Run& run, double width, const Series& reference) {
  const Column& seconds = run.gauges["time"];
  const Column time = linear(std::sqrt(2.0 * 9.81 / width), seconds);
  const Column front = linear(1.0 / width, run.gauges["tip_front"]);
  double best_shift = 0.0;
  double best = front_error(time, front, reference, 0.0);
  const double raw = best;
  for (int k = 1; k <= 60; ++k) {
    const double shift = kLargestShift * k / 60.0;
    const double error = front_error(time, front, reference, shift);
    if (error < best) best_shift = shift;
    best = std::min(error, best);
  }
  return {{{"front, rms", 100.0 * raw, "%", 0.0, 10.0},
           {"front, rms with one shift", 100.0 * best, "%", 0.0, 5.0},
           {"that shift", best_shift, "sqrt(a/2g)", 0.0, kLargestShift}},
          {{"", time, front}}};
}

Outcome evaluate_martin_moyce(const std::vector<Run>& runs) {
  return compare(runs.front(), 0.05715, reference_named("martin_moyce_1952"));
}

Outcome evaluate_koshizuka_oka(const std::vector<Run>& runs) {
  return compare(runs.front(), 0.146, reference_named("koshizuka_oka_1996"));
}

std::vector<Curve> measured(const std::string& title, const std::string& name) {
  const Series series = reference_named(name);
  return {{title, series["T"], series["Z"]}};
}

}  // namespace

Case dam_martin_moyce() {
  return {.name = "dam_martin_moyce",
          .title = "Collapse of a column 57 mm wide and twice as high",
          .scenes = {"dam_martin_moyce"},
          .seconds = 0.185,
          .spacings = {0.005715, 0.0028575, 0.00142875},
          .size = 0.05715,
          .size_name = "a",
          .evaluate = evaluate_martin_moyce,
          .reference = [] { return measured("Martin & Moyce 1952", "martin_moyce_1952"); },
          .x_label = "t sqrt(2g/a)",
          .y_label = "front [a]"};
}

Case dam_koshizuka_oka() {
  return {.name = "dam_koshizuka_oka",
          .title = "Collapse of a column 146 mm wide and twice as high",
          .scenes = {"dam_koshizuka_oka"},
          .seconds = 0.28,
          .spacings = {0.0146, 0.0073, 0.00365},
          .size = 0.146,
          .size_name = "L",
          .evaluate = evaluate_koshizuka_oka,
          .reference = [] { return measured("Koshizuka & Oka 1996", "koshizuka_oka_1996"); },
          .x_label = "t sqrt(2g/L)",
          .y_label = "front [L]"};
}

}  // namespace splash::validation
