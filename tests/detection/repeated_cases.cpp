// SPDX-License-Identifier: MIT
// Again and again: plunges in a row, patting, rain; each entry once, whatever the last one left.
#include <array>
#include <cmath>
#include <numbers>

#include "tests/detection/script.hpp"
#include "tests/detection/sweeps.hpp"

namespace splash::detection {
namespace {

constexpr int kPlunges = 8;
constexpr double kAbove = 0.1;   ///< between plunges its underside is so high [m]
constexpr double kDepth = 0.12;  ///< [m]
constexpr double kHold = 0.25;   ///< down there [s]

Case plunges(const sim::Shape& shape, double degrees, double speed, double pause) {
  Basin basin;
  basin.length = 0.6;
  basin.width = 0.5;
  basin.level = 0.3;
  sim::BodyState at_origin;
  at_origin.rotation = pitched(degrees);
  const double low = lowest_point(shape, at_origin)[2];
  const sim::Vector3 top = {0.0, 0.0, basin.level + kAbove - low};
  const sim::Vector3 bottom = {0.0, 0.0, basin.level - kDepth - low};
  Way way(top, at_origin.rotation);
  way.wait(0.05);
  for (int k = 0; k < kPlunges; ++k) way.to(bottom, speed).wait(kHold).to(top, speed).wait(pause);
  Case item = {"repeated",
               digits(speed) + " m/s, pause " + digits(pause) + " s" +
                   (degrees > 0.0 ? ", " + digits(degrees) + " degrees" : "") +
                   (shape.kind == sim::ShapeKind::sphere ? ", sphere" : ""),
               basin.scene({body_text("body", shape_text(shape), way.text())}), way.end()};
  item.quick = pause == 0.05;
  // Without a pause it turns round in the column of water that it has pulled up.
  if (item.quick) item.pulled = kAbove / speed;
  return item;
}

/// The palm swings about the level.
Case pats(double height, double frequency) {
  constexpr double kSeconds = 2.0;
  constexpr int kParts = 64;  // of a period
  Basin basin;
  const double amplitude = 0.5 * height;
  const double thickness = hand().size[2];
  const double middle = basin.level + 0.5 * thickness;
  Way way({0.0, 0.0, middle + amplitude});
  const double part = 1.0 / (frequency * kParts);
  const auto count = static_cast<int>(std::lround(kSeconds / part));
  for (int k = 1; k <= count; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / kParts;
    const sim::Vector3 next = {0.0, 0.0, middle + amplitude * std::cos(turn)};
    way.go({0.0, 0.0, (next[2] - way.place()[2]) / part}, part);
  }
  Case item = {"patting", digits(100.0 * height) + " cm at " + digits(frequency) + " Hz",
               basin.scene({body_text("hand", shape_text(hand()), way.text())}), way.end()};
  item.quick = height == 0.015;
  return item;
}

/// Free balls in rows, let go from heights that are all different.
Case rain(double diameter, double spacing) {
  constexpr std::array<int, 16> kOrder = {5, 12, 1, 10, 15, 0, 7, 3, 8, 14, 2, 11, 4, 9, 13, 6};
  Basin basin;
  basin.length = basin.width = 0.6;
  basin.level = 0.2;
  basin.spacing = spacing;
  std::vector<std::string> balls;
  for (int k = 0; k < 16; ++k) {
    const double height = 0.08 + 0.06 * kOrder[static_cast<std::size_t>(k)];
    const int row = k / 4;
    const sim::Vector3 place = {0.14 * (k % 4 - 1.5), 0.14 * (row - 1.5),
                                basin.level + 0.5 * diameter + height};
    balls.push_back(
        free_text("ball" + std::to_string(k), shape_text(ball(diameter)), place, 600.0));
  }
  Case item = {"rain", "16 balls of " + digits(100.0 * diameter) + " cm", basin.scene(balls), 1.1};
  item.quick = diameter > 0.045;
  return item;
}

}  // namespace

std::vector<Case> repeated_cases() {
  return {plunges(hand(), 0.0, 1.2, 0.05),
          plunges(hand(), 0.0, 0.6, 0.4),
          plunges(hand(), 0.0, 0.8, 1.0),
          plunges(hand(), 35.0, 1.0, 0.4),
          plunges(hand(), 35.0, 1.2, 1.0),
          plunges(ball(0.1), 0.0, 1.0, 0.4),
          pats(0.08, 1.0),
          pats(0.05, 2.0),
          pats(0.03, 4.0),
          pats(0.015, 4.0),
          rain(0.05, 0.025),
          rain(0.04, 0.02)};
}

}  // namespace splash::detection
