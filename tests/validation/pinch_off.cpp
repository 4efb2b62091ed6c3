// SPDX-License-Identifier: MIT
// The hollow behind a disc that is driven into water closes 1.72 to 2.29 sqrt(R/g) after impact,
// whatever the speed (Glasheen & McMahon 1996: 2.285 for discs; spheres by author from 1.72 on).
#include <algorithm>
#include <cmath>

#include "program/text.hpp"
#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kDiameter = 0.1;  // of the scenes [m]
constexpr double kLevel = 0.55;
constexpr double kThickness = 0.025;
/// A pocket of this volume is a closed hollow, not a gap between particles.
constexpr double kPocket = kDiameter * kDiameter * kDiameter / 32.0;

/// When the hollow that becomes the largest pocket closed: splashes may have shut in a little air
/// for a moment before. Not a number when nothing closed [s].
double closing_time(const Column& time, const Column& pocket) {
  auto k =
      static_cast<std::size_t>(std::max_element(pocket.begin(), pocket.end()) - pocket.begin());
  if (pocket[k] < kPocket) return std::nan("");
  while (k > 0 && pocket[k] >= kPocket) --k;
  return time[k] + (time[k + 1] - time[k]) * (kPocket - pocket[k]) / (pocket[k + 1] - pocket[k]);
}

Outcome evaluate_pinch_off(const std::vector<Run>& runs) {
  Outcome outcome;
  Column times;
  for (const Run& run : runs) {
    const Column& time = run.gauges["time"];
    const double speed = -run.gauges["disc_vz"].at(1);
    const double contact = (run.gauges["disc_z"].front() - kThickness / 2.0 - kLevel) / speed;
    const double closed = closing_time(time, run.gauges["hollow_pocket"]) - contact;
    const double unit = std::sqrt(kDiameter / 2.0 / 9.81);
    times.push_back(closed / unit);
    const std::string name = program::format("Fr %.0f", speed / std::sqrt(9.81 * kDiameter));
    outcome.figures.push_back({"closing time at " + name, closed / unit, "sqrt(R/g)", 1.72, 2.29});
    const Column since = linear(1.0 / unit, time, -contact / unit);
    outcome.curves.push_back({name + ' ', since, linear(1e6, run.gauges["hollow_pocket"])});
  }
  outcome.figures.push_back(
      {"change with the speed", 100.0 * (times.back() / times.front() - 1.0), "%", -10.0, 10.0});
  return outcome;
}

std::vector<Curve> reference_pinch_off() {
  return {{"Glasheen & McMahon 1996", {2.285, 2.285}, {0.0, 3000.0}}};
}

}  // namespace

Case pinch_off() {
  return {.name = "pinch_off",
          .title = "The hollow behind a disc of 100 mm closes",
          .scenes = {"pinch_off_fr2", "pinch_off_fr3"},
          .seconds = 0.27,
          .spacings = {0.0125, 0.00833333, 0.00625},
          .size = kDiameter,
          .size_name = "D",
          .evaluate = evaluate_pinch_off,
          .reference = reference_pinch_off,
          .x_label = "time since contact [sqrt(R/g)]",
          .y_label = "closed volume [cm3]"};
}

}  // namespace splash::validation
