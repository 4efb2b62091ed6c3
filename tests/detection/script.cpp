// SPDX-License-Identifier: MIT
#include "tests/detection/script.hpp"

#include <cmath>
#include <numbers>
#include <span>

#include "program/text.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::detection {

using namespace sim;  // operators of vectors among it

namespace {

std::string in_brackets(std::span<const double> values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? ", " : "") + digits(value);
  return text + "]";
}

}  // namespace

std::string digits(double value) {
  return program::format("%.9g", value);
}

std::string digits(const sim::Vector3& place) {
  return in_brackets(place);
}

sim::Quaternion pitched(double degrees) {
  return sim::from_turn({0.0, degrees * std::numbers::pi / 180.0, 0.0});
}

sim::Shape box(const sim::Vector3& size) {
  sim::Shape shape;
  shape.size = size;
  return shape;
}

sim::Shape ball(double diameter) {
  sim::Shape shape = box({diameter, diameter, diameter});
  shape.kind = sim::ShapeKind::sphere;
  return shape;
}

sim::Shape disc(double diameter, double thickness) {
  sim::Shape shape = box({diameter, diameter, thickness});
  shape.kind = sim::ShapeKind::cylinder;
  return shape;
}

sim::Shape hand() {
  return box({0.18, 0.09, 0.04});
}

Way::Way(const sim::Vector3& start, const sim::Quaternion& turn) : keys_{{0.0, start, turn}} {}

void Way::add(const sim::Vector3& place, double time) {
  keys_.push_back({time, place, keys_.front().rotation});
}

Way& Way::to(const sim::Vector3& place, double speed) {
  const sim::Vector3 way = place - keys_.back().position;
  add(place, end() + sim::length(way) / speed);
  return *this;
}

Way& Way::go(const sim::Vector3& velocity, double seconds) {
  add(place() + seconds * velocity, end() + seconds);
  return *this;
}

Way& Way::wait(double seconds) {
  add(place(), end() + seconds);
  return *this;
}

std::string Way::text() const {
  std::string text = "{kind: script, smooth: false, keyframes: [";
  for (const sim::Keyframe& key : keys_) {
    text += "\n        {time: " + digits(key.time) + ", position: " + digits(key.position) +
            ", rotation: " + in_brackets(key.rotation) + "},";
  }
  return text + "]}";
}

std::string Pool::scene(const std::vector<std::string>& bodies, const std::string& water) const {
  std::string text = "fluid: {spacing: " + digits(spacing) + "}\ntank: {lower: " + digits(lower) +
                     ", upper: " + digits({upper[0], upper[1], upper[2] + above}) +
                     "}\nwater:\n  - {lower: " + digits(lower) + ", upper: " + digits(upper) +
                     "}\n" + water + "bodies:\n";
  for (const std::string& body : bodies) text += body;
  return text;
}

std::string Basin::scene(const std::vector<std::string>& bodies, const std::string& water) const {
  const Pool pool = {
      {-0.5 * length, -0.5 * width, 0.0}, {0.5 * length, 0.5 * width, level}, spacing, 0.6};
  return pool.scene(bodies, water);
}

std::string shape_text(const sim::Shape& shape) {
  const char* kinds[] = {"box", "sphere", "cylinder"};
  std::string text =
      "kind: " + std::string(kinds[static_cast<int>(shape.kind)]) + ", size: " + digits(shape.size);
  if (shape.rocker > 0.0) {
    text += ", rocker: " + digits(shape.rocker) + ", flat: " + digits(shape.flat);
  }
  return text;
}

std::string body_text(const std::string& name, const std::string& shape,
                      const std::string& motion) {
  return "  - name: " + name + "\n    shape: {" + shape + "}\n    motion: " + motion + "\n";
}

std::string free_text(const std::string& name, const std::string& shape, const sim::Vector3& place,
                      double density) {
  return "  - name: " + name + "\n    shape: {" + shape +
         "}\n    rest: {position: " + digits(place) +
         "}\n    motion: {kind: free, density: " + digits(density) + "}\n";
}

}  // namespace splash::detection
