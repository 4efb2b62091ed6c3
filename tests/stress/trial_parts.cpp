// SPDX-License-Identifier: MIT
#include "tests/stress/trial_parts.hpp"

#include <algorithm>
#include <stdexcept>

namespace splash::stress {

using sim::BodySettings;
using sim::MotionKind;
using sim::Scene;
using sim::ShapeKind;
using sim::Vector3;

Scene basin(double spacing) {
  Scene scene;
  scene.name = "stress";
  scene.fluid.spacing = spacing;
  scene.tank.lower = {0.0, 0.0, 0.0};
  scene.tank.upper = {kWide, kWide, 0.6};
  scene.water = {{{0.0, 0.0, 0.0}, {kWide, kWide, kDeep}}};
  return scene;
}

BodySettings ball(const Vector3& place, double width) {
  BodySettings body;
  body.name = "ball";
  body.shape = {.kind = ShapeKind::sphere, .size = {width, width, width}};
  body.rest.position = place;
  return body;
}

BodySettings box(const std::string& name, const Vector3& size, const Vector3& place) {
  BodySettings body;
  body.name = name;
  body.shape = {.kind = ShapeKind::box, .size = size};
  body.rest.position = place;
  return body;
}

BodySettings moved(BodySettings body, const std::vector<std::pair<double, Vector3>>& way) {
  body.motion.kind = MotionKind::script;
  body.motion.smooth = false;
  for (const auto& [time, place] : way)
    body.motion.keyframes.push_back({time, place, {0, 0, 0, 1}});
  body.rest.position = way.front().second;
  return body;
}

BodySettings tracked(BodySettings body) {
  body.motion.kind = MotionKind::osc;
  return body;
}

Scene with(Scene scene, std::vector<BodySettings> bodies) {
  scene.bodies = std::move(bodies);
  return scene;
}

std::vector<Trial> all_trials() {
  std::vector<Trial> all;
  add_body_trials(all);
  add_free_trials(all);
  add_water_trials(all);
  return all;
}

const Trial& trial_named(const std::string& name) {
  static const std::vector<Trial> kAll = all_trials();
  const auto found =
      std::find_if(kAll.begin(), kAll.end(), [&](const Trial& t) { return t.name == name; });
  if (found == kAll.end()) throw std::logic_error("no trial is called " + name);
  return *found;
}

}  // namespace splash::stress
