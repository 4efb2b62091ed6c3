// SPDX-License-Identifier: MIT
#include "sim-server/scene/scene_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "sim-server/scene/tank_motion.hpp"

namespace splash::sim {

namespace {

using program::ConfigMap;

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
/// Positions this close count as equal [m].
constexpr double kTouch = 1.0e-9;

std::string text(double value) {
  std::string digits = std::to_string(value);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

void check_corners(const ConfigMap& map, const Vector3& lower, const Vector3& upper) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (upper[i] > lower[i]) continue;
    throw map.error("upper", std::string(kAxes[i]) + " is " + text(upper[i]) +
                                 ", not above that of 'lower' (" + text(lower[i]) + ")");
  }
}

bool overlap(const WaterBlock& a, const WaterBlock& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.upper[i] <= b.lower[i] + kTouch || b.upper[i] <= a.lower[i] + kTouch) return false;
  }
  return true;
}

/// Two keys whose values stand in an order.
struct Order {
  const char* low_key;
  double low;
  const char* high_key;
  double high;
};

std::array<Order, 4> orders_of(const DetectSettings& d) {
  return {{{"radius_min", d.radius_min, "radius_max", d.radius_max},
           {"epsilon_min", d.epsilon_min, "epsilon_max", d.epsilon_max},
           {"cavity_bubbles_min", static_cast<double>(d.cavity_bubbles_min), "cavity_bubbles_max",
            static_cast<double>(d.cavity_bubbles_max)},
           {"cavity_radius_min", d.cavity_radius_min, "cavity_radius_max", d.cavity_radius_max}}};
}

/// Empty: it holds.
std::string wrong(const Order& order) {
  if (order.high > order.low) return {};
  return std::string(order.high_key) + " is " + text(order.high) + ", not above " + order.low_key +
         " (" + text(order.low) + ")";
}

}  // namespace

Quaternion checked_rotation(const ConfigMap& map, const Quaternion& q) {
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (length < 1.0e-3) throw map.error("rotation", "is no rotation: its length is zero");
  return unit(q);
}

void check_tank(const ConfigMap& map, const Tank& tank) {
  check_corners(map, tank.lower, tank.upper);
}

void check_slope(const ConfigMap& map, const Slope& slope, const Tank& tank) {
  if (slope.foot < tank.lower[0] || slope.foot >= tank.upper[0]) {
    throw map.error("foot", text(slope.foot) + " is outside the tank, whose x goes from " +
                                text(tank.lower[0]) + " to " + text(tank.upper[0]));
  }
  const double top = tank.lower[2] + slope.gradient * (tank.upper[0] - slope.foot);
  if (top > tank.upper[2]) {
    throw map.error("gradient", "the slope ends at a height of " + text(top) +
                                    " m, above the tank's upper z (" + text(tank.upper[2]) +
                                    "); make it flatter or the tank higher");
  }
}

void check_wave_maker(const ConfigMap& map, const WaveMaker& maker, const Tank& tank) {
  const double half = 0.5 * (tank.upper[0] - tank.lower[0]);
  if (maker.stroke < half) return;
  throw map.error(
      "stroke", text(maker.stroke) + " is not below half the tank's length (" + text(half) + " m)");
}

void check_tank_motion(const ConfigMap& map, const TankMotionSettings& motion) {
  const bool swings = length(motion.sway) > 0.0 || length(motion.roll) > 0.0;
  for (const char* key : {"period", "ramp"}) {
    if (map.has(key) && !swings) throw map.error(key, "has no meaning without 'sway' or 'roll'");
  }
  if (swings && !map.has("period")) throw map.error("period", "is missing: sway and roll need it");
  if (swings || !motion.samples.empty()) return;
  throw map.error("samples",
                  "nothing moves the tank: give 'sway', 'roll' or 'samples', or leave "
                  "out 'tank_motion'");
}

void check_turning(const ConfigMap& motion, const Scene& scene) {
  if (!turns(scene.tank_motion)) return;
  for (const BodySettings& body : scene.bodies) {
    if (!is_free(body)) continue;
    throw motion.error(motion.has("roll") ? "roll" : "samples",
                       "the tank turns, in which the free body '" + body.name +
                           "' cannot be yet; it may sway and be accelerated, or the body may go "
                           "its own way");
  }
}

void check_water(const ConfigMap& map, const WaterBlock& block, const Scene& scene) {
  const Tank& tank = scene.tank;
  check_corners(map, block.lower, block.upper);
  if (block.form != WaterForm::box && scene.slope.present) {
    throw map.error("form", "only boxes of water can lie on a slope");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string axis = kAxes[i];
    if (block.lower[i] < tank.lower[i] - kTouch) {
      throw map.error("lower", axis + " is " + text(block.lower[i]) +
                                   ", outside the tank, which begins at " + text(tank.lower[i]));
    }
    if (block.upper[i] > tank.upper[i] + kTouch) {
      throw map.error("upper", axis + " is " + text(block.upper[i]) +
                                   ", outside the tank, which ends at " + text(tank.upper[i]));
    }
  }
  for (const auto& other : scene.water) {
    if (overlap(block, other)) throw map.error("lower", "this water overlaps a block before it");
  }
}

void check_gate(const ConfigMap& map, const Scene& scene) {
  const Gate& gate = scene.gate;
  if (scene.wave_maker.present) throw map.error("x", "a wave maker's tank cannot have a gate");
  if (gate.x <= scene.tank.lower[0] || gate.x >= scene.tank.upper[0]) {
    throw map.error("x", text(gate.x) + " is outside the tank, whose x goes from " +
                             text(scene.tank.lower[0]) + " to " + text(scene.tank.upper[0]));
  }
  for (const WaterBlock& block : scene.water) {
    const bool is_beside = block.upper[0] <= gate.x + kTouch || block.lower[0] >= gate.x - kTouch;
    if (is_beside) continue;
    throw map.error("x", "the gate at " + text(gate.x) + " stands in the water, a block of which " +
                             "goes from x = " + text(block.lower[0]) + " to " +
                             text(block.upper[0]) + "; water on both sides of it is two blocks");
  }
}

namespace {

/// How far a place is inside the tank, from its floor and its sides [m].
double distance_to_walls(const Tank& tank, const Vector3& place) {
  double least = place[2] - tank.lower[2];
  for (std::size_t i = 0; i < 2; ++i) {
    least = std::min({least, place[i] - tank.lower[i], tank.upper[i] - place[i]});
  }
  return least;
}

/// A sensor with a size is let into something, and one that rides on a body is not inside it.
void check_sensor(const ConfigMap& map, const GaugeSettings& gauge, const Scene& scene) {
  const double let_in = kLetIn * particle_spacing(scene);
  const double distance = gauge.rides ? distance_to(scene.bodies[gauge.body].shape, gauge.place)
                                      : distance_to_walls(scene.tank, gauge.place);
  if (gauge.rides && distance < -let_in) {
    throw map.error("place", "is " + text(-distance) + " m inside the body '" +
                                 scene.bodies[gauge.body].name +
                                 "', where no water comes; it is told in that body's own axes");
  }
  if (gauge.radius == 0.0 || std::abs(distance) <= let_in) return;
  throw map.error("radius",
                  "a sensor with a size is let into a wall, the floor or the skin of the "
                  "body that `body` names, but this one is " +
                      text(distance) + " m from it, and may be " + text(let_in) +
                      " m at most, a quarter of a particle spacing");
}

}  // namespace

void check_gauge(const ConfigMap& map, const GaugeSettings& gauge, const Scene& scene) {
  if (gauge.kind == GaugeKind::cavity) return check_corners(map, gauge.lower, gauge.upper);
  const bool line = gauge.kind == GaugeKind::height;
  const bool point = gauge.kind == GaugeKind::pressure || gauge.kind == GaugeKind::velocity;
  if (gauge.rides) return check_sensor(map, gauge, scene);
  if (!(line || point)) return;
  const Tank& tank = scene.tank;
  const Vector3 place = line ? Vector3{gauge.x, gauge.y, tank.lower[2]} : gauge.place;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool inside =
        place[i] >= tank.lower[i] - kTouch && (i == 2 || place[i] <= tank.upper[i] + kTouch);
    if (inside) continue;
    throw map.error(line ? kAxes[i] : "place", std::string(kAxes[i]) + " is " + text(place[i]) +
                                                   ", outside the tank, which goes from " +
                                                   text(tank.lower[i]) + " to " +
                                                   text(tank.upper[i]));
  }
  if (point) check_sensor(map, gauge, scene);
}

void check_shape(const ConfigMap& map, const Shape& shape) {
  if (const std::string reason = wrong_size(shape); !reason.empty())
    throw map.error("size", reason);
  const bool round = shape.kind != ShapeKind::box;
  for (const char* key : {"rocker", "flat"}) {
    if (round && map.has(key)) throw map.error(key, "only a box has a sole");
  }
  if (shape.rocker >= shape.size[2]) {
    throw map.error("rocker", text(shape.rocker) + " is not below the box's height (" +
                                  text(shape.size[2]) + " m)");
  }
}

namespace {

/// No moment is larger than the other two together, and nothing moves as it is held.
void check_inertia(const ConfigMap& map, const MotionSettings& motion) {
  const Vector3& moments = motion.inertia;
  const double half = 0.5 * (moments[0] + moments[1] + moments[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    if (moments[i] > (1.0 + kTouch) * half) {
      throw map.error("inertia", std::string("the moment about ") + kAxes[i] +
                                     " is larger than the other two together, as of no body");
    }
    const bool moves = (motion.held >> i & 1) != 0 && motion.velocity[i] != 0.0;
    const bool turns = (motion.held >> (i + 3) & 1) != 0 && motion.spin[i] != 0.0;
    if (moves || turns) {
      throw map.error("held", std::string("the body is held by ") + (moves ? "" : "r") + kAxes[i] +
                                  ", but its " + (moves ? "'velocity'" : "'spin'") + " is not 0");
    }
  }
}

}  // namespace

void check_free(const ConfigMap& map, const MotionSettings& motion) {
  check_inertia(map, motion);
  if (map.has("density") != map.has("mass")) return;
  const bool spring = motion.coupling == CouplingKind::spring;
  throw map.error(motion.mass > 0.0 ? "mass" : "kind",
                  std::string(spring ? "a body on a spring" : "a free motion") +
                      " needs one of 'density' and 'mass'");
}

void check_spring(const ConfigMap& map, const MotionSettings& motion) {
  for (const char* key : {"stiffness", "device_damping"}) {
    if (map.has(key)) continue;
    throw map.error("coupling", std::string("a spring needs '") + key + "'");
  }
  if (motion.gap == GapKind::hold) {
    throw map.error("gap",
                    "hold plays poses late, and a spring that is felt late gives a hand "
                    "energy; with coupling: spring leave it out");
  }
}

// A spring that acts tau seconds late is, to a slow hand, one with a damper of -k tau. Samples that
// are held for a time T are T/2 late (Colgate & Schenkel 1997: b > k T/2 + |B|). Here they are held
// for a frame, computed within one, and their poses may be played delay_limit late.
void check_passivity(const ConfigMap& map, const MotionSettings& motion, double frame_rate) {
  const double late = 1.5 / frame_rate + motion.delay_limit;
  const double needed = motion.stiffness * late + motion.damping;
  if (motion.device_damping >= needed) return;
  const double most = std::max(motion.device_damping - motion.damping, 0.0) / late;
  throw map.error("stiffness",
                  "is " + text(motion.stiffness) + " N/m: felt " + text(1.0e3 * late) +
                      " ms late (one and a half frames and delay_limit) it needs a device with a "
                      "damping of " +
                      text(needed) + " N s/m, and device_damping is " +
                      text(motion.device_damping) + "; with that it may be " + text(most) +
                      " N/m at most. Lower stiffness, damping or delay_limit, or raise "
                      "serve.frame_rate");
}

void check_place(const ConfigMap& body, const Vector3& place, const Tank& tank) {
  for (std::size_t i = 0; i < 3; ++i) {
    const bool above = i == 2 && place[i] > tank.lower[i];  // it may fall in from there
    if (above || (place[i] > tank.lower[i] && place[i] < tank.upper[i])) continue;
    throw body.error("rest", std::string("a free body starts between the tank's walls, but ") +
                                 kAxes[i] + " is " + text(place[i]) +
                                 ", where the tank goes from " + text(tank.lower[i]) + " to " +
                                 text(tank.upper[i]));
  }
}

void check_detect(const ConfigMap& map, const DetectSettings& d) {
  for (const Order& order : orders_of(d)) {
    const std::string reason = wrong(order);
    if (reason.empty()) continue;
    const bool high = map.has(order.high_key) || !map.has(order.low_key);
    throw map.error(high ? order.high_key : order.low_key, reason);
  }
}

std::string wrong_order(const DetectSettings& detect) {
  for (const Order& order : orders_of(detect)) {
    if (std::string reason = wrong(order); !reason.empty()) return reason;
  }
  return {};
}

void check_time_step(const ConfigMap& map, const FluidSettings& fluid) {
  const double most = StepPolicy::stable_factor(fluid.solver);
  if (fluid.time_step_factor <= most) return;
  if (!map.has("sound_speed")) return;
  throw map.error("time_step_factor",
                  "must be in " + text(StepPolicy::kLeastFactor) + ".." + text(most) +
                      " with a sound_speed of the scene's own, got '" +
                      text(fluid.time_step_factor) +
                      "': with longer steps still water begins to boil. Leave sound_speed out, and "
                      "it becomes as slow as such steps need");
}

void check_solver(const ConfigMap& map, const FluidSettings& fluid) {
  if (!fluid.air_pockets || fluid.solver == PressureKind::grid_projected) return;
  throw map.error(
      "air_pockets",
      "needs 'solver: grid_projected', got weakly_compressible, in which all air has the "
      "atmosphere's pressure. Leave out one of the two keys");
}

void check_sound(const ConfigMap& fluid, const Scene& scene) {
  constexpr double kOfWater = 1500.0;  // [m/s]
  const double wanted = suitable_sound_speed(scene, 0.0, StepPolicy::sound_factor(scene.fluid));
  if (fluid.has("pull") && wanted > kOfWater) {
    const double fastest = std::max(longest_wave(scene), fastest_fall(scene));
    throw fluid.error("pull", "is too strong for where the water is: it would get as fast as " +
                                  text(std::round(fastest)) +
                                  " m/s, for which sound would have to be as fast as " +
                                  text(std::round(wanted)) +
                                  " m/s, and in water it is no faster than " + text(kOfWater) +
                                  " m/s; bring pull_centre nearer, or pull less");
  }
  const double least = slowest_sound(scene);
  const bool unused = scene.fluid.solver != PressureKind::weakly_compressible;
  if (unused || !fluid.has("sound_speed") || scene.fluid.sound_speed >= least) return;
  throw fluid.error(
      "sound_speed",
      "must be at least " + text(least) + " m/s in this scene, got '" +
          text(scene.fluid.sound_speed) +
          "': slower, and the water's weight or its own fall would make it more than a "
          "sixteenth denser. Twice as much is what a scene gets that leaves it out");
}

void check_resolution(const ConfigMap& fluid, const Scene& scene) {
  if (fluid.has("spacing") == fluid.has("particles")) {
    throw fluid.error(fluid.has("spacing") ? "spacing" : "particles",
                      "give exactly one of 'spacing' and 'particles'");
  }
  const std::string key = fluid.has("spacing") ? "spacing" : "particles";
  const double volume = water_volume(scene);
  if (volume <= 0.0) throw fluid.error(key, "no water is left above the slope");
  const double spacing = particle_spacing(scene);
  const double number = std::round(volume / (spacing * spacing * spacing));
  if (number < kParticlesMin || number > kParticlesMax) {
    throw fluid.error(key, "makes " + text(number) + " particles, allowed are " +
                               std::to_string(kParticlesMin) + " to " +
                               std::to_string(kParticlesMax));
  }
  for (const auto& block : scene.water) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (block.upper[i] - block.lower[i] >= spacing) continue;
      throw fluid.error(key, "makes particles " + text(spacing) + " m apart, but a block of " +
                                 "water is only " + text(block.upper[i] - block.lower[i]) +
                                 " m thick along " + kAxes[i]);
    }
  }
}

}  // namespace splash::sim
