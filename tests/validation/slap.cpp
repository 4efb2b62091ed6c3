// SPDX-License-Identifier: MIT
// A disc slaps the water flat: the impulse it gets is that of the water it sets in motion,
// 4/3 rho R^3 U (Lamb, Hydrodynamics, article 102; half of a disc's added mass in open water), and
// grows as its speed. What comes after, drag and buoyancy, grows steadily: the slap is where the
// straight line through the later impulse begins.
#include <cmath>
#include <limits>

#include "program/text.hpp"
#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kRadius = 0.08;  // of the scenes [m]
constexpr double kLevel = 0.32;
constexpr double kThickness = 0.04;
/// The slap is over after the sound has run this many radii; the first echo from floor or wall
/// comes after 8.
constexpr double kSlapEnds = 4.0;
constexpr double kEcho = 7.0;
constexpr double kShown = 5.0;  // middle of what the picture shows
constexpr int kPlaces = 100;    // on the line between them

struct Slap {
  double speed = 0.0;    // [m/s]
  double impulse = 0.0;  // [N s]
  Curve curve;           // impulse over 4/3 rho R^3 U against time since contact in R / c
};

/// Where the line through the later impulse begins; a force is the same all through a step.
double begun(const Column& since, const Column& sum) {
  Column x;
  Column y;
  for (int k = 0; k <= kPlaces; ++k) {
    x.push_back(kSlapEnds + (kEcho - kSlapEnds) * k / kPlaces);
    y.push_back(interpolate(since, sum, x.back()));
  }
  return fit_line(x, y, kSlapEnds, kEcho).first;
}

Slap measure(const Run& run) {
  const Column& time = run.gauges["time"];
  const Column& force = run.gauges["disc_fz"];
  Slap slap;
  slap.speed = -run.gauges["disc_vz"].at(1);
  const double contact = (run.gauges["disc_z"].front() - kThickness / 2.0 - kLevel) / slap.speed;
  const double sound = 8.0 * std::sqrt(9.81 * kLevel);
  Column since;
  Column sum;
  double total = 0.0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    total += force[k] * (time[k] - time[k - 1]);  // that of the step
    since.push_back((time[k] - contact) * sound / kRadius);
    sum.push_back(total);
  }
  slap.impulse = begun(since, sum);
  const double theory = 4.0 / 3.0 * 998.0 * std::pow(kRadius, 3) * slap.speed;
  for (std::size_t k = 0; k < since.size(); ++k) {
    if (std::abs(since[k] - kShown) > kShown + 2.0) continue;
    slap.curve.x.push_back(since[k]);
    slap.curve.y.push_back(sum[k] / theory);
  }
  return slap;
}

Outcome evaluate_slap(const std::vector<Run>& runs) {
  Outcome outcome;
  Column log_speed;
  Column log_impulse;
  for (const Run& run : runs) {
    const Slap slap = measure(run);
    const double theory = 4.0 / 3.0 * 998.0 * std::pow(kRadius, 3) * slap.speed;
    outcome.figures.push_back({program::format("impulse at %.1f m/s, error", slap.speed),
                               100.0 * (slap.impulse / theory - 1.0), "%", -20.0, 20.0});
    log_speed.push_back(std::log(slap.speed));
    log_impulse.push_back(std::log(slap.impulse));
    outcome.curves.push_back(slap.curve);
    outcome.curves.back().title = program::format("%.1f m/s ", slap.speed);
  }
  outcome.figures.push_back({"slope of log impulse against log speed",
                             fit_line(log_speed, log_impulse, -10.0, 10.0).second, "1", 0.9, 1.1});
  return outcome;
}

std::vector<Curve> reference_slap() {
  return {{"4/3 rho R^3 U", {0.0, 8.0}, {1.0, 1.0}}};
}

}  // namespace

Case slap() {
  return {.name = "slap",
          .title = "A disc of 160 mm slaps the water at 0.4, 0.8 and 1.6 m/s",
          .scenes = {"slap_slow", "slap_medium", "slap_fast"},
          .seconds = 0.1,
          .spacings = {0.02, 0.0133333, 0.01},
          .size = 2.0 * kRadius,
          .size_name = "D",
          .evaluate = evaluate_slap,
          .reference = reference_slap,
          .x_label = "time since contact [R/c]",
          .y_label = "impulse [4/3 rho R^3 U]"};
}

}  // namespace splash::validation
