// SPDX-License-Identifier: MIT
// Cavities that published physics foretells: a box or disc on a straight stroke into deep water.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim-server/scene/shape.hpp"
#include "tests/detection/script.hpp"
#include "tests/detection/sweeps.hpp"

namespace splash::detection {
namespace {

constexpr double kLeastRadius = 0.02;  ///< of a cavity that is told [m]
constexpr double kNear = 0.1;          ///< to a limit: either is right [1]
/// What is known of the factor of the closed volume, which is taken as 2 (Bergmann et al. 2009).
constexpr double kLeastFactor = 1.5;
constexpr double kMostFactor = 3.0;

struct Stroke {
  std::string name;
  sim::Shape shape = hand();
  double speed = 1.0;    ///< [m/s]
  double degrees = 0.0;  ///< so far it is turned, its +x end down
  double steep = 90.0;   ///< its way from the level [degrees], forwards
  double depth = 0.0;    ///< where its lowest point stops [m]; 0: deep enough to close the hollow
  double level = 0.0;    ///< [m]; 0: 15 cm more than that
  double width = 0.5;    ///< of the basin [m]
  double spacing = 0.025;
};

/// What the laws say of it.
struct Law {
  double radius = 0.0;     ///< R of the area across its motion [m]
  double thickness = 0.0;  ///< its volume by that area [m]
  double closes = 0.0;     ///< after the middle of its front went under [s]
  double air = 0.0;        ///< and the body's own volume [m3]
  double body = 0.0;       ///< [m3]
};

Law law_of(const Stroke& stroke) {
  const double across = std::numbers::pi * (stroke.degrees + 90.0 - stroke.steep) / 180.0;
  const double gravity = 9.81 * std::sin(std::numbers::pi * stroke.steep / 180.0);
  const sim::Vector3& size = stroke.shape.size;
  const bool is_box = stroke.shape.kind == sim::ShapeKind::box;
  const double area =
      is_box ? size[1] * (size[0] * std::cos(across) + size[2] * std::abs(std::sin(across)))
             : 0.25 * std::numbers::pi * size[0] * size[0];
  Law law;
  law.body = sim::volume_of(stroke.shape);
  law.radius = std::sqrt(area / std::numbers::pi);
  law.thickness = law.body / area;
  law.closes = 2.285 * std::sqrt(law.radius / gravity);
  const double froude = stroke.speed / std::sqrt(gravity * law.radius);  // its root
  law.air = 2.0 * std::pow(law.radius, 3) * froude * (1.0 + 0.26 * froude);
  return law;
}

/// None where it goes less far than R and its thickness until the hollow closes, or where the body
/// fills that.
Count cavities_of(const Law& law, double way) {
  const double far = way / (law.radius + law.thickness);
  const double told = 4.0 / 3.0 * std::numbers::pi * std::pow(kLeastRadius, 3);
  const bool may = 0.5 * kMostFactor * law.air - law.body > told;
  const bool must = 0.5 * kLeastFactor * law.air - law.body > told;
  if (far < 1.0 || !may) return {0, 0};
  return {far > 1.0 + kNear && must ? 1 : 0, 1};
}

Case case_of(const std::string& sweep, const Stroke& stroke) {
  const Law law = law_of(stroke);
  const double turn = std::numbers::pi * stroke.steep / 180.0;
  const double down = stroke.speed * std::sin(turn);
  sim::BodyState at_origin;
  at_origin.rotation = pitched(stroke.degrees);
  const double low = lowest_point(stroke.shape, at_origin)[2];
  // A box shows as much from behind: its front's middle is half its thickness before its own.
  const double sinks = (-low - 0.5 * law.thickness * std::sin(turn)) / down;
  const double depth =
      stroke.depth > 0.0 ? stroke.depth : std::max(0.3, 1.2 * down * law.closes + down * sinks);
  Basin basin;
  basin.width = stroke.width;
  const double gap = std::max(0.03, 0.15 * down);
  const double along = (gap + depth) / std::tan(turn);
  basin.length = stroke.width + along;
  basin.level = stroke.level > 0.0 ? stroke.level : depth + 0.15;
  basin.spacing = stroke.spacing;
  Way way({-0.5 * along, 0.0, basin.level + gap - low}, at_origin.rotation);
  way.go({stroke.speed * std::cos(turn), 0.0, -down}, (gap + depth) / down).wait(1.0);
  Case item = {sweep, stroke.name,
               basin.scene({body_text("body", shape_text(stroke.shape), way.text())}),
               gap / down + sinks + 0.5};
  const double reached =
      std::min(stroke.speed * law.closes, (depth - down * sinks) / std::sin(turn));
  item.wishes.cavities = cavities_of(law, reached);
  if (item.wishes.cavities->most > 0) {
    item.wishes.sinks_after = sinks;
    item.wishes.closes_after = law.closes;
    item.wishes.least_air = std::max(0.5 * kLeastFactor * law.air - law.body, 0.0);
    item.wishes.most_air = 0.5 * kMostFactor * law.air - law.body;
    item.wishes.body = law.body;
    item.wishes.hollow = law.air;
  }
  item.quick = stroke.name == "hand, 1 m/s" || stroke.name == "hand, 0.3 m/s" ||
               stroke.name == "60 degrees, 2 m/s";
  return item;
}

std::vector<Stroke> slanted_strokes() {
  std::vector<Stroke> strokes;
  for (const double degrees : {15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    for (const double speed : {1.0, 2.0, 3.0}) {
      strokes.push_back({.name = digits(degrees) + " degrees, " + digits(speed) + " m/s",
                         .speed = speed,
                         .degrees = degrees});
    }
  }
  for (const double steep : {45.0, 60.0}) {
    strokes.push_back({.name = "palm first, " + digits(steep) + " degrees from the level, 1.5 m/s",
                       .speed = 1.5,
                       .degrees = steep - 90.0,
                       .steep = steep});
  }
  return strokes;
}

}  // namespace

std::vector<Case> cavity_cases() {
  const sim::Shape foot = box({0.26, 0.1, 0.08});
  const std::vector<Stroke> flat = {
      {.name = "hand, 1 m/s"},
      {.name = "hand, 1 m/s, 30 mm", .spacing = 0.03},
      {.name = "hand, 1 m/s, 20 mm", .spacing = 0.02},
      {.name = "hand, 1 m/s, 15 mm", .width = 0.42, .spacing = 0.015},
      {.name = "disc, 1 m/s", .shape = disc(0.144, 0.04)},
      {.name = "disc, 1 m/s, 15 mm", .shape = disc(0.144, 0.04), .width = 0.42, .spacing = 0.015},
      {.name = "hand, 2 m/s", .speed = 2.0},
      {.name = "hand, 3 m/s", .speed = 3.0},
      {.name = "hand, 5 m/s", .speed = 5.0, .width = 0.6},
      {.name = "hand, 0.3 m/s", .speed = 0.3},
      {.name = "hand, 0.5 m/s", .speed = 0.5},
      {.name = "hand, 1 m/s, 6 cm deep", .depth = 0.06, .level = 0.24},
      {.name = "foot, 1.5 m/s, 20 cm of water",
       .shape = foot,
       .speed = 1.5,
       .depth = 0.17,
       .level = 0.2}};
  std::vector<Case> all;
  for (const Stroke& stroke : flat) all.push_back(case_of("cavities", stroke));
  for (const Stroke& stroke : slanted_strokes()) all.push_back(case_of("slanted", stroke));
  return all;
}

}  // namespace splash::detection
