// SPDX-License-Identifier: MIT
// Bodies that the water moves: a cuboid that floats (Archimedes; its heave by the linear theory of
// waves in its tank, which the added mass of open water alone misses), and a cube that sinks (Wu et
// al. 2014, as replotted by Qiu et al. 2017).
#include <cmath>
#include <numbers>

#include "tests/validation/cases.hpp"
#include "tests/validation/linear_heave.hpp"

namespace splash::validation {

namespace {

constexpr double kGravity = 9.81;

// Of float.yaml.
constexpr double kHeight = 0.12;  // of the cuboid [m]
constexpr double kDraft = 0.06;   // at half the water's density [m]
constexpr double kLate = 3.0;     // it floats calmly from here on [s]
constexpr double kHeaving = 1.6;  // and heaves until here [s]
constexpr int kLevels = 4;
const Heave kHeave = {
    .half_width = 0.12, .draft = kDraft, .half_tank = 0.4, .depth = 0.4, .edge = 0.02};

/// Twice the mean time between the passages of where it comes to rest while it heaves.
double period_of(const Column& passages) {
  Column early;
  for (const double t : passages) {
    if (t < kHeaving) early.push_back(t);
  }
  if (early.size() < 2) return std::nan("");
  return 2.0 * (early.back() - early.front()) / static_cast<double>(early.size() - 1);
}

Outcome evaluate_float(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Series& g = run.gauges;
  const Column& time = g["time"];
  const Column& z = g["cuboid_z"];
  const double end = time.back();
  double level = 0.0;
  for (int i = 0; i < kLevels; ++i) {
    const Column& height = g["level" + std::to_string(i) + "_height"];
    level += mean_between(time, height, kLate, end) / kLevels;
  }
  const double rest = mean_between(time, z, kLate, end);
  const double draft = level - (rest - kHeight / 2.0);
  const double spacing = run.scene.fluid.spacing;
  const double hydrostatic = 2.0 * std::numbers::pi * std::sqrt(kDraft / kGravity);
  const double period =
      period_of(zero_crossings(time, combine(1.0, z, -rest, Column(time.size(), 1.0))));
  const double theory = period_of(heave_passages(kHeave, kHeaving));
  const double upright =
      1.0 - 2.0 * (std::pow(g["cuboid_qx"].back(), 2) + std::pow(g["cuboid_qy"].back(), 2));
  // Wanted: 3 % of the body's height or half a spacing, whichever is more.
  const double wanted = std::max(3.0, 100.0 * 0.5 * spacing / kHeight);
  return {
      {{"draft, error, of the height", 100.0 * (draft - kDraft) / kHeight, "%", -wanted, wanted},
       {"draft, error", (draft - kDraft) / spacing, "dp", -0.5, 0.5},
       {"heave period, error", 100.0 * (period / theory - 1.0), "%", -15.0, 15.0},
       {"heave period over the hydrostatic one", period / hydrostatic, "1", 1.0},
       {"the same by linear theory", theory / hydrostatic, "1"},
       {"tilt", 180.0 / std::numbers::pi * std::acos(std::min(upright, 1.0)), "degrees", 0.0, 5.0}},
      {{"", time, combine(1.0, z, 0.0, z)}}};
}

std::vector<Curve> reference_float() {
  return {{"Archimedes", {0.0, 4.0}, {0.4 + kHeight / 2.0 - kDraft, 0.4 + kHeight / 2.0 - kDraft}}};
}

Outcome evaluate_sinking(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Column& time = run.gauges["time"];
  const Column& z = run.gauges["cube_z"];
  const Series reference = reference_named("wu_2014_sinking_cube");
  const Column& at = reference["t"];
  const Column& fallen = reference["fallen"];
  double error = 0.0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    error += std::abs(z.front() - interpolate(time, z, at[k]) - fallen[k]) /
             static_cast<double>(at.size());
  }
  const Column way = combine(-1.0, z, z.front(), Column(z.size(), 1.0));
  const double landing = first_reach(time, way, fallen.back());
  return {{{"way, mean error, of all of it", 100.0 * error / fallen.back(), "%", 0.0, 10.0},
           {"time of landing, error", 100.0 * (landing / at.back() - 1.0), "%", -10.0, 10.0}},
          {{"", time, way}}};
}

std::vector<Curve> reference_sinking() {
  const Series series = reference_named("wu_2014_sinking_cube");
  return {{"Wu et al. 2014", series["t"], series["fallen"]}};
}

}  // namespace

Case floating() {
  return {.name = "float",
          .title = "A cuboid of half the water's density floats",
          .scenes = {"float"},
          .seconds = 5.0,
          .spacings = {0.04, 0.03, 0.02},
          .size = kHeight,
          .size_name = "h",
          .evaluate = evaluate_float,
          .reference = reference_float,
          .x_label = "time [s]",
          .y_label = "height of its centre [m]"};
}

Case sinking_cube() {
  return {.name = "sinking_cube",
          .title = "A cube of 20 mm and 2700 kg/m3 sinks",
          .scenes = {"sinking_cube"},
          .seconds = 0.8,
          .spacings = {0.006666667, 0.005, 0.004},
          .size = 0.02,
          .size_name = "a",
          .evaluate = evaluate_sinking,
          .reference = reference_sinking,
          .x_label = "time [s]",
          .y_label = "way down [m]"};
}

}  // namespace splash::validation
