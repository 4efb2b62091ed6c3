// SPDX-License-Identifier: MIT
// The scenes as they ship, and cavities that published physics foretells.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "tests/detection/script.hpp"
#include "tests/detection/shipped.hpp"
#include "tests/detection/sweeps.hpp"
#include "tests/support/source_folder.hpp"

namespace splash::detection {
namespace {

/// A stroke into deep water, and how many cavities it makes.
struct Stroke {
  std::string name;
  sim::Shape shape = hand();
  double speed = 1.0;  ///< [m/s]
  double depth = 0.0;  ///< where its underside stops [m]; 0: deep enough for the hollow to close
  double level = 0.0;  ///< [m]; 0: 15 cm more than that
  double width = 0.5;  ///< of the basin [m]
  double spacing = 0.025;
  Count cavities = {1, 1};
};

/// Radius of the disc of the area that goes in [m].
double radius_of(const sim::Shape& shape) {
  if (shape.kind != sim::ShapeKind::box) return 0.5 * shape.size[0];
  return std::sqrt(shape.size[0] * shape.size[1] / std::numbers::pi);
}

Case case_of(const Stroke& stroke) {
  const double radius = radius_of(stroke.shape);
  const double closes_after = 2.285 * std::sqrt(radius / 9.81);
  const double froude = stroke.speed / std::sqrt(9.81 * radius);
  const double depth =
      stroke.depth > 0.0 ? stroke.depth : std::max(0.3, 1.2 * stroke.speed * closes_after);
  Basin basin;
  basin.length = basin.width = stroke.width;
  basin.level = stroke.level > 0.0 ? stroke.level : depth + 0.15;
  basin.spacing = stroke.spacing;
  const double gap = std::max(0.03, 0.15 * stroke.speed);
  const double half = 0.5 * stroke.shape.size[2];
  Way way({0.0, 0.0, basin.level + gap + half});
  way.go({0.0, 0.0, -stroke.speed}, (gap + depth) / stroke.speed).wait(1.0);
  Case item;
  item.sweep = "cavities";
  item.name = stroke.name;
  item.scene = basin.scene({body_text("body", shape_text(stroke.shape), way.text())});
  item.seconds = gap / stroke.speed + 0.6;
  item.wishes.cavities = stroke.cavities;
  if (stroke.cavities.least == 1) {
    item.wishes.closes_after = closes_after;
    // Bergmann et al. 2009; its factor by a cone's estimate.
    item.wishes.air = 2.0 * std::pow(radius, 3) * froude * (1.0 + 0.26 * froude);
  }
  item.quick = stroke.name == "hand, 1 m/s" || stroke.name == "hand, 0.3 m/s";
  return item;
}

Case shipped_case(const std::string& name, double seconds, bool quick) {
  Case item;
  item.sweep = "scenes";
  item.name = name;
  item.scene = shipped(name + ".yaml");
  item.seconds = seconds;
  item.quick = quick;
  return item;
}

}  // namespace

std::filesystem::path scene_folder() {
  return tests::source_folder() / "configs" / "scenes";
}

std::string shipped(const std::string& name) {
  std::ifstream file(scene_folder() / name);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::runtime_error("no scene " + name);
  return text.str();
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) {
    throw std::runtime_error("not once in the scene: " + from);
  }
  return text.replace(at, from.size(), to);
}

std::string without_wave_impacts(const std::string& text) {
  const std::string key = "impact_waves: true";
  return text.find(key) == std::string::npos ? text : changed(text, key, "impact_waves: false");
}

std::vector<Case> cavity_cases() {
  const sim::Shape foot = box({0.26, 0.1, 0.08});
  std::vector<Stroke> strokes = {
      {.name = "hand, 1 m/s"},
      {.name = "hand, 1 m/s, 30 mm", .spacing = 0.03},
      {.name = "hand, 1 m/s, 20 mm", .spacing = 0.02},
      {.name = "hand, 1 m/s, 15 mm", .width = 0.42, .spacing = 0.015},
      {.name = "disc, 1 m/s", .shape = disc(0.144, 0.04)},
      {.name = "disc, 1 m/s, 15 mm", .shape = disc(0.144, 0.04), .width = 0.42, .spacing = 0.015},
      {.name = "hand, 2 m/s", .speed = 2.0},
      {.name = "hand, 3 m/s", .speed = 3.0},
      {.name = "hand, 5 m/s", .speed = 5.0, .width = 0.6},
      {.name = "hand, 0.3 m/s", .speed = 0.3, .cavities = {0, 0}},
      {.name = "hand, 0.5 m/s", .speed = 0.5, .cavities = {0, 0}},
      {.name = "hand, 1 m/s, 6 cm deep", .depth = 0.06, .level = 0.24, .cavities = {0, 0}},
      {.name = "foot, 1.5 m/s, 20 cm of water",
       .shape = foot,
       .speed = 1.5,
       .depth = 0.17,
       .level = 0.2,
       .cavities = {0, 0}}};
  std::vector<Case> all;
  for (const Stroke& stroke : strokes) all.push_back(case_of(stroke));
  return all;
}

std::vector<Case> scene_cases() {
  std::vector<Case> all = {shipped_case("basin", 10.0, true),  shipped_case("bucket", 9.0, false),
                           shipped_case("ducks", 8.0, false),  shipped_case("boat", 8.0, false),
                           shipped_case("plunge", 3.0, false), shipped_case("pool", 8.0, false),
                           shipped_case("beach", 20.0, false)};
  // Ten crests, one every two seconds, reach two feet; some of the backwash hits their toes.
  all.back().wishes.waves = Count{18, 36};
  return all;
}

}  // namespace splash::detection
