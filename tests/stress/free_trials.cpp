// SPDX-License-Identifier: MIT
// Group 6: bodies that the water moves, a thousandth to a thousand times as dense as it: let go
// under water, dropped from 10 m, on each other.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/stress/trial_parts.hpp"

namespace splash::stress {
namespace {

constexpr double kWater = 998.0;  // [kg/m3]

/// Of what falls 10 m [m/s].
const double kDropped = std::sqrt(2.0 * 9.81 * 10.0);

sim::BodySettings free_body(sim::BodySettings body, double ratio) {
  body.motion.kind = sim::MotionKind::free;
  body.motion.density = ratio * kWater;
  return body;
}

std::string with_ratio(const std::string& what, double ratio) {
  std::array<char, 16> text = {};
  std::snprintf(text.data(), text.size(), "%g", ratio);
  return what + ", density " + text.data();
}

/// Ten plates, each on the one beneath it, from the floor of the basin to out of its water.
sim::Scene stack(double spacing, double ratio) {
  constexpr double kThick = 0.04;  // [m]
  std::vector<sim::BodySettings> plates;
  for (int k = 0; k < 10; ++k) {
    plates.push_back(free_body(
        box("plate " + std::to_string(k), {0.12, 0.12, kThick}, {0.2, 0.2, (k + 0.5) * kThick}),
        ratio));
  }
  return with(basin(spacing), plates);
}

void add_stacks(std::vector<Trial>& all) {
  for (const double ratio : {0.5, 2.0, 10.0}) {
    all.push_back({.group = 6,
                   .name = with_ratio("ten on each other", ratio),
                   .seconds = 2.0,
                   .speed = kFall,
                   .stands = ratio > 1.0,
                   .scene = [=](double s) { return stack(s, ratio); }});
  }
}

}  // namespace

void add_free_trials(std::vector<Trial>& all) {
  add_stacks(all);
  for (const double ratio : {1.0e-3, 1.0e-2, 0.1, 0.5, 1.0, 10.0, 1.0e3}) {
    all.push_back({.group = 6,
                   .name = with_ratio("let go under water", ratio),
                   .seconds = 1.5,
                   .speed = kFall,
                   .scene = [=](double s) {
                     return with(basin(s), {free_body(ball({0.2, 0.2, 0.1}), ratio)});
                   }});
    all.push_back({.group = 6,
                   .name = with_ratio("dropped from 10 m", ratio),
                   .seconds = 1.0,
                   .speed = kDropped,
                   .scene = [=](double s) {
                     sim::BodySettings body = free_body(ball({0.2, 0.2, 0.4}), ratio);
                     body.motion.velocity = {0.0, 0.0, -kDropped};
                     return with(basin(s), {body});
                   }});
    all.push_back({.group = 6,
                   .name = with_ratio("a box tumbles in", ratio),
                   .seconds = 1.5,
                   .speed = 3.0,
                   .scene = [=](double s) {
                     sim::BodySettings body =
                         free_body(box("box", {0.16, 0.1, 0.06}, {0.2, 0.2, 0.35}), ratio);
                     body.motion.velocity = {0.3, 0.0, -2.0};
                     body.motion.spin = {5.0, -8.0, 3.0};
                     return with(basin(s), {body});
                   }});
  }
}

}  // namespace splash::stress
