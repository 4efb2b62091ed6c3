// SPDX-License-Identifier: MIT
// Sheets, domains, forces, fluids and bubbles; and tanks that made other solvers explode.
#include <utility>

#include "sim-server/scene/resolution.hpp"
#include "tests/stress/trial_parts.hpp"

namespace splash::stress {
namespace {

using sim::Scene;
using sim::Simulation;
using sim::Vector3;

void add_sheets(std::vector<Trial>& all) {
  all.push_back({.group = 7,
                 .name = "a sheet one particle thick",
                 .seconds = 1.0,
                 .speed = kFall,
                 .slams = true,
                 .scene = [](double s) {
                   Scene scene = basin(s);
                   scene.water = {{{0.0, 0.0, 0.3}, {kWide, kWide, 0.3 + s}}};
                   return scene;
                 }});
  all.push_back({.group = 7,
                 .name = "all in pairs at one place",
                 .seconds = 0.6,
                 .speed = 4.0,
                 .harmed = true,
                 .scene = basin,
                 .drive = [] {
                   return [done = false](Simulation& simulation) mutable {
                     if (std::exchange(done, true)) return;
                     sim::Snapshot state = simulation.fluid().snapshot();
                     const auto n = static_cast<std::size_t>(simulation.fluid().params().capacity);
                     for (std::size_t i = 0; i + 1 < state.id.size(); i += 8) {
                       for (std::size_t axis = 0; axis < 3; ++axis) {
                         state.position[axis * n + i + 1] = state.position[axis * n + i];
                       }
                     }
                     simulation.fluid().restore(state);
                   };
                 }});
}

void add_domains(std::vector<Trial>& all) {
  // Only the shallower one is judged as still water.
  for (const int layers : {50, 200}) {
    all.push_back({.group = 8,
                   .name = "a column of " + std::to_string(layers) + " layers",
                   .seconds = 2.0,
                   .still = layers == 50,
                   .scene = [=](double s) {
                     Scene scene = basin(s);
                     scene.tank.upper = {4 * s, 4 * s, (layers + 10) * s};
                     scene.water = {{{0.0, 0.0, 0.0}, {4 * s, 4 * s, layers * s}}};
                     return scene;
                   }});
  }
  all.push_back({.group = 8,
                 .name = "a tank much longer than its water",
                 .seconds = 1.0,
                 .speed = kFall,
                 .scene = [](double s) {
                   Scene scene = basin(s);
                   scene.tank.upper[0] = 8.0;
                   return scene;
                 }});
  all.push_back({.group = 8,
                 .name = "95 m from the origin",
                 .seconds = 2.0,
                 .still = true,
                 .scene = [](double s) {
                   Scene scene = basin(s);
                   for (Vector3* x : {&scene.tank.lower, &scene.tank.upper, &scene.water[0].lower,
                                      &scene.water[0].upper}) {
                     (*x)[0] += 95.0;
                     (*x)[1] -= 95.0;
                   }
                   return scene;
                 }});
  all.push_back(
      {.group = 8, .name = "odd sizes", .seconds = 2.0, .still = true, .scene = [](double s) {
         Scene scene = basin(s);
         scene.tank.upper = {0.4137, 0.3519, 0.611};
         scene.water = {{{0.0, 0.0, 0.0}, {0.4137, 0.3519, 0.2023}}};
         return scene;
       }});
}

Trial pulled(const std::string& name, const Vector3& gravity, double speed) {
  return {.group = 9, .name = name, .seconds = 0.8, .speed = speed, .scene = [=](double s) {
            Scene scene = basin(s);
            scene.fluid.gravity = gravity;
            return scene;
          }};
}

/// Gravity turns by 45 degrees at 0.2 s, in the parameters that the kernels read.
Drive tilting() {
  return [done = false](Simulation& s) mutable {
    if (s.seconds() < 0.2 || std::exchange(done, true)) return;
    sim::FluidParams params = s.fluid().params();
    params.gravity_x = 6.9F;
    params.gravity_z = -6.9F;
    s.fluid().device().queue().enqueueWriteBuffer(s.fluid().params_buffer().memory(), CL_TRUE, 0,
                                                  sizeof params, &params);
  };
}

void add_forces(std::vector<Trial>& all) {
  all.push_back({.group = 9,
                 .name = "a jet of 20 m/s on a wall",
                 .seconds = 0.15,
                 .speed = 20.0,
                 .scene = [](double s) {
                   Scene scene = basin(s);
                   scene.fluid.sound_speed = 200.0;
                   scene.tank.upper = {0.8, kWide, 1.0};
                   scene.water = {{{0.2, 0.1, 0.1}, {0.5, 0.3, 0.3}}};
                   scene.flow.kind = sim::FlowKind::uniform;
                   scene.flow.velocity = {20.0, 0.0, 0.0};
                   return scene;
                 }});
  all.push_back({.group = 9,
                 .name = "a drop from 10 m",
                 .seconds = 1.6,
                 .speed = 14.0,
                 .scene = [](double s) {
                   Scene scene = basin(s);
                   scene.fluid.sound_speed = 140.0;
                   scene.tank.upper[2] = 10.5;
                   scene.water = {{{0.0, 0.0, 0.0}, {kWide, kWide, kDeep}},
                                  {{0.1, 0.1, 10.0}, {0.3, 0.3, 10.2}}};
                   return scene;
                 }});
  all.push_back(pulled("no gravity", {0.0, 0.0, 0.0}, 1.0));
  all.push_back(pulled("gravity upwards", {0.0, 0.0, 9.81}, 8.0));
  all.push_back(pulled("ten times gravity", {0.0, 0.0, -98.1}, 5.0));
  Trial tilt = pulled("gravity tilts at once", {0.0, 0.0, -9.81}, kFall);
  tilt.drive = tilting;
  all.push_back(tilt);
}

void add_fluids(std::vector<Trial>& all) {
  for (const double nu : {0.0, 1.0e-2, 1.0}) {
    all.push_back({.group = 10,
                   .name = "viscosity " + std::to_string(nu).substr(0, 4),
                   .seconds = nu > 0.1 ? 0.1 : 0.6,
                   .speed = kFall,
                   .scene = [=](double s) {
                     Scene scene = basin(s);
                     scene.fluid.viscosity = nu;
                     scene.tank.upper[0] = 0.8;
                     return scene;
                   }});
  }
  all.push_back({.group = 10,
                 .name = "no friction at all",
                 .seconds = 0.6,
                 .speed = kFall,
                 .scene = [](double s) {
                   Scene scene = basin(s);
                   scene.fluid.viscosity = scene.fluid.artificial = 0.0;
                   scene.tank.upper[0] = 0.8;
                   return scene;
                 }});
  all.push_back({.group = 10,
                 .name = "the slowest sound",
                 .seconds = 0.8,
                 .speed = kFall,
                 .scene = [](double s) {
                   Scene scene = basin(s);
                   scene.tank.upper[0] = 0.8;
                   scene.fluid.sound_speed = sim::slowest_sound(scene);
                   return scene;
                 }});
}

/// A ball goes in and out of the basin for ever, and its bubbles last a millisecond.
Trial churning() {
  return {.group = 11,
          .name = "bubbles that die at once, for ten minutes",
          .seconds = 600.0,
          .speed = kFall,
          .turnover = true,
          .finest = 0.05,
          .scene = [](double s) {
            sim::BodySettings stirrer = moved(
                ball({}), {{0.0, {0.2, 0.2, 0.4}}, {0.3, {0.2, 0.2, 0.1}}, {0.6, {0.2, 0.2, 0.4}}});
            stirrer.motion.repeat = true;
            Scene scene = with(basin(s), {stirrer});
            scene.detect.bubble_speed = 0.01;
            scene.detect.bubble_gradient = 0.0;
            scene.detect.bubble_life = 1.0e-3;
            return scene;
          }};
}

Scene foaming(double s) {
  Scene scene = with(basin(s), {moved(ball({}), {{0.0, {0.2, 0.2, 0.4}}, {0.3, {0.2, 0.2, 0.1}}})});
  scene.detect.bubble_speed = 0.01;
  scene.detect.bubble_gradient = 0.0;
  return scene;
}

void add_bubbles(std::vector<Trial>& all) {
  all.push_back({.group = 11,
                 .name = "all of it bubbles",
                 .seconds = 0.8,
                 .speed = kFall,
                 .scene = [](double s) {
                   Scene scene = foaming(s);
                   scene.detect.bubble_per_particle = true;
                   scene.detect.cavity_by_count = true;
                   scene.detect.cavity_bubbles_min = 2;
                   return scene;
                 }});
  all.push_back({.group = 11,
                 .name = "bubbles that die at once",
                 .seconds = 0.8,
                 .speed = kFall,
                 .scene = [](double s) {
                   Scene scene = foaming(s);
                   scene.detect.bubble_life = 1.0e-3;
                   return scene;
                 }});
  all.push_back(churning());
  all.push_back({.group = 12,
                 .name = "a flood of events",
                 .seconds = 0.6,
                 .speed = kFall,
                 .scene = [](double s) {
                   Scene scene = foaming(s);
                   scene.detect.bubble_energy = scene.detect.bubble_drag = 1.0;
                   scene.detect.bubble_onset = 0.0;
                   return scene;
                 }});
}

void add_reported_tanks(std::vector<Trial>& all) {
  for (const double length : {0.31, 0.47, 0.63, 0.95, 1.27}) {
    all.push_back({.name = "a tank " + std::to_string(length).substr(0, 4) + " m long",
                   .seconds = 2.0,
                   .still = true,
                   .scene = [=](double s) {
                     Scene scene = basin(s);
                     scene.tank.upper[0] = length;
                     scene.water[0].upper[0] = length;
                     return scene;
                   }});
  }
}

}  // namespace

void add_water_trials(std::vector<Trial>& all) {
  add_sheets(all);
  add_domains(all);
  add_forces(all);
  add_fluids(all);
  add_bubbles(all);
  add_reported_tanks(all);
}

}  // namespace splash::stress
