// SPDX-License-Identifier: MIT
// SPHERIC test 2: heights in the tank and pressures on the box, against Kleefsman et al. 2005.
#include <cmath>
#include <limits>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

/// First peak of each sensor in the 1 kHz record and when a quarter of it is passed.
struct Peak {
  const char* sensor;
  double pressure;  // [Pa]
  double arrival;   // [s]
};
constexpr Peak kPeaks[] = {
    {"P1", 11239.0, 0.395}, {"P2", 8127.0, 0.412}, {"P3", 6564.0, 0.426}, {"P4", 7203.0, 0.434}};
constexpr double kImpactEnd = 0.9;  // [s]
constexpr double kColumn = 0.55;    // height of the water at the start [m]
constexpr const char* kHeights = "H1 to H4, mean error, of the column";

double height_error(const Run& run, const Series& reference, const std::string& name) {
  const Column& at = reference["t"];
  const Column& h = reference[name];
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < at.size() && at[k] <= run.simulated; ++k) {
    // As the record, means over 50 ms.
    sum += std::abs(mean_between(run.gauges["time"], run.gauges[name + "_height"], at[k] - 0.025,
                                 at[k] + 0.025) -
                    h[k]);
    ++count;
  }
  return sum / count;
}

double impulse(const Column& time, const Column& pressure, double first, double last) {
  double sum = 0.0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    if (time[k - 1] < first || time[k] > last) continue;
    sum += 0.5 * (pressure[k] + pressure[k - 1]) * (time[k] - time[k - 1]);
  }
  return sum;
}

Outcome evaluate_spheric2(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Series heights = reference_named("kleefsman_2005_heights");
  const Series pressures = reference_named("kleefsman_2005_pressures");
  const Column& time = run.gauges["time"];
  Outcome outcome;
  double of_all = 0.0;
  for (const char* name : {"H2", "H4", "H1", "H3"}) {
    const double error = height_error(run, heights, name);
    const bool held = name[1] == '2' || name[1] == '4';
    outcome.figures.push_back({std::string(name) + ", mean error", error, "m", 0.0,
                               held ? 0.03 : std::numeric_limits<double>::infinity()});
    of_all += 0.25 * error;
  }
  outcome.figures.push_back({kHeights, 100.0 * of_all / kColumn, "%"});
  for (const Peak& peak : kPeaks) {
    const std::string name = peak.sensor;
    const Column& p = run.gauges[name + "_pressure"];
    const double late = first_reach(time, p, 0.25 * peak.pressure) - peak.arrival;
    const double allowed = name == "P1" ? 0.02 : std::numeric_limits<double>::infinity();
    outcome.figures.push_back({name + ", arrival, error", late, "s", -allowed, allowed});
    const double ratio = impulse(time, p, 0.35, kImpactEnd) /
                         impulse(pressures["t"], pressures[name], 0.35, kImpactEnd);
    outcome.figures.push_back(
        {name + ", impulse to 0.9 s, error", 100.0 * (ratio - 1.0), "%", -25.0, 25.0});
    outcome.figures.push_back(
        {name + ", peak, error",
         100.0 * (largest_between(time, p, 0.35, kImpactEnd) / peak.pressure - 1.0), "%"});
  }
  outcome.curves = {{"H2 ", time, run.gauges["H2_height"]}, {"H4 ", time, run.gauges["H4_height"]}};
  return outcome;
}

std::vector<Curve> reference_spheric2() {
  const Series heights = reference_named("kleefsman_2005_heights");
  return {{"Kleefsman 2005, H2", heights["t"], heights["H2"]},
          {"Kleefsman 2005, H4", heights["t"], heights["H4"]}};
}

}  // namespace

Case spheric2() {
  return {.name = "spheric2",
          .title = "A dam breaks onto a box (SPHERIC test 2)",
          .scenes = {"spheric2"},
          .seconds = 6.0,
          .spacings = {0.04, 0.03, 0.02},
          .size = kColumn,
          .size_name = "H",
          .evaluate = evaluate_spheric2,
          .reference = reference_spheric2,
          .x_label = "time [s]",
          .y_label = "height of the water [m]"};
}

}  // namespace splash::validation
