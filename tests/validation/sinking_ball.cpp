// SPDX-License-Identifier: MIT
// A ball twice as dense as the water sinks from rest. What holds it back while it falls, its weight
// in water less what its mass and the water that goes along take, is its drag.
#include <cmath>
#include <numbers>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kGravity = 9.81;
constexpr double kWater = 998.0;  // [kg/m3]

// Of sinking_ball.yaml.
constexpr double kDiameter = 0.12;   // [m]
constexpr double kDensity = 2000.0;  // [kg/m3]
constexpr double kStart = 0.36;      // height of its centre [m]

constexpr double kAlong = 0.5;    // water that goes along, of what it displaces, unbounded [1]
constexpr double kDrag = 0.45;    // of a smooth ball at Re 1e3 to 1e5 [1]
constexpr double kFirst = 0.02;   // its first acceleration is that from rest to here [s]
constexpr double kFrom = 0.5;     // of its way to a diameter above the floor's touch: the drag
constexpr double kLowest = 0.12;  // is that from there down to where its centre is this high [m]

/// Speed after a way, from rest, of a ball with this drag in open water.
double speed_after(double way, double drag) {
  const double inertia = kDensity + kAlong * kWater;
  const double pull = (kDensity - kWater) * kGravity / inertia;
  const double rate = 0.75 * kWater * drag / (kDiameter * inertia);  // dv/dt = pull - rate v^2
  return std::sqrt(pull / rate * (1.0 - std::exp(-2.0 * rate * way)));
}

/// The drag with which a ball that comes by one place at one speed comes by another at another:
/// with w = v^2, dw/ds = 2 (pull - rate w), so the way between tells the rate.
double drag_between(double first, double last, double way) {
  const double inertia = kDensity + kAlong * kWater;
  const double pull = (kDensity - kWater) * kGravity / inertia;
  double low = -10.0;
  double high = 100.0;
  for (int turn = 0; turn < 60; ++turn) {
    const double drag = 0.5 * (low + high);
    const double rate = 0.75 * kWater * drag / (kDiameter * inertia);
    const double fade = std::exp(-2.0 * rate * way);
    const double gained = std::abs(rate) > 1e-9 ? (1.0 - fade) / rate : 2.0 * way;
    (first * first * fade + pull * gained > last * last ? low : high) = drag;
  }
  return 0.5 * (low + high);
}

Outcome evaluate_sinking_ball(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Column& time = run.gauges["time"];
  const Column& z = run.gauges["ball_z"];
  const Column down = linear(-1.0, run.gauges["ball_vz"]);
  const Column way = linear(-1.0, z, kStart);
  const double reach = kStart - kLowest;
  const double halfway = first_reach(time, way, kFrom * reach);
  const double end = first_reach(time, way, reach);
  const double first = interpolate(time, down, halfway);
  const double last = interpolate(time, down, end);
  const double began = interpolate(time, down, kFirst) / kFirst;
  const double pull = (kDensity - kWater) * kGravity / (kDensity + kAlong * kWater);
  return {
      {{"drag coefficient, lower half of its way", drag_between(first, last, (1.0 - kFrom) * reach),
        "1", 0.0, run.scene.fluid.spacing > kDiameter / 8.0 ? 1.5 : 1.0},
       {"drag coefficient, all of its way", drag_between(0.0, last, reach), "1"},
       {"first acceleration, error", 100.0 * (began / pull - 1.0), "%", -15.0, 15.0},
       {"speed a diameter above the floor", last, "m/s"},
       {"the same, error", 100.0 * (last / speed_after(reach, kDrag) - 1.0), "%", -15.0, 15.0}},
      {{"", way, down}}};
}

std::vector<Curve> reference_sinking_ball() {
  Curve curve = {"Cd 0.45, added mass 1/2, open water", {}, {}};
  for (int k = 0; k <= 30; ++k) {
    curve.x.push_back(0.01 * k);
    curve.y.push_back(speed_after(0.01 * k, kDrag));
  }
  return {curve};
}

}  // namespace

Case sinking_ball() {
  return {.name = "sinking_ball",
          .title = "A ball of 120 mm and 2000 kg/m3 sinks",
          .scenes = {"sinking_ball"},
          .seconds = 0.7,
          .spacings = {0.02, 0.012},
          .size = kDiameter,
          .size_name = "D",
          .evaluate = evaluate_sinking_ball,
          .reference = reference_sinking_ball,
          .x_label = "way down [m]",
          .y_label = "speed [m/s]"};
}

}  // namespace splash::validation
