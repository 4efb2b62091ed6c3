// SPDX-License-Identifier: MIT
// Rest, time steps, trackers, speeds, squeezes; and bodies that made other solvers explode.
#include <array>
#include <cmath>
#include <limits>

#include "tests/stress/trial_parts.hpp"

namespace splash::stress {
namespace {

using sim::BodySettings;
using sim::Keyframe;
using sim::Scene;
using sim::Simulation;
using sim::Vector3;

Trial rest(const std::string& name, double seconds, std::vector<BodySettings> bodies) {
  return {.group = 1, .name = name, .seconds = seconds, .still = true, .scene = [bodies](double s) {
            return with(basin(s), bodies);
          }};
}

void add_rests(std::vector<Trial>& all) {
  constexpr double kLong = 20.0;  // [s]
  all.push_back(rest("rest", kLong, {}));
  all.push_back(rest("rest, half in", kLong, {ball({0.2, 0.2, kDeep})}));
  all.push_back(rest("rest, sunk", kLong, {ball({0.2, 0.2, 0.1})}));
  all.push_back(rest("rest for ten minutes", 600.0, {}));
  all.back().finest = 0.05;
}

void add_break(std::vector<Trial>& all) {
  all.push_back(
      {.group = 2, .name = "dam break", .seconds = 1.0, .speed = kFall, .scene = [](double s) {
         Scene scene = basin(s);
         scene.tank.upper[0] = 0.8;
         return scene;
       }});
}

Trial track(const std::string& name, const std::function<Drive()>& drive) {
  return {.group = 3,
          .name = name,
          .seconds = 0.8,
          .speed = 5.0,
          .harmed = true,
          .scene =
              [](double s) {
                return with(basin(s), {tracked(ball({0.2, 0.2, 0.35}))});
              },
          .drive = drive};
}

/// Poses at 100 Hz that jump by `way` spacings every fifth time, down and up.
Drive jumping(double way) {
  return [way, next = 0.0, count = 0](Simulation& s) mutable {
    if (s.seconds() < next) return;
    next += 0.01;
    const bool down = (++count / 5) % 2 == 1;
    const double jump = way * static_cast<double>(s.fluid().params().spacing);
    const double z = std::max(0.24 - (down ? jump : 0.0), 0.07);
    static_cast<void>(s.live_body(0)->push({0.2, 0.2, z}, {0, 0, 0, 1}, {s.seconds(), {}}));
  };
}

/// A sine into the water whose tracker is blind for 110 ms of every 300.
Drive with_gaps() {
  return [](Simulation& s) {
    const double t = s.seconds();
    if (std::fmod(t, 0.3) < 0.11) return;
    static_cast<void>(
        s.live_body(0)->push({0.2, 0.2, 0.25 + 0.12 * std::cos(8.0 * t)}, {0, 0, 0, 1}, {t, {}}));
  };
}

Drive nonsense() {
  return [k = 0](Simulation& s) mutable {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const double t = s.seconds();
    sim::PosedMotion& body = *s.live_body(0);
    const std::array<std::pair<Keyframe, double>, 7> poses = {
        {{{t, {kNaN, 0.2, 0.2}, {0, 0, 0, 1}}, t},
         {{t, {0.2, 0.2, 0.2}, {0, 0, 0, 0}}, t},
         {{t, {0.2, 0.2, 0.2}, {1e-310, 0, 0, 1e-310}}, t},
         {{t, {0.2, 0.2, 0.2}, {0, 0, 0, 1}}, t - 1.0},
         {{t, {0.2, 0.2, 1e9}, {0, 0, 0, 1}}, t},
         {{t, {0.2, 0.2, 0.2}, {0, kNaN, 0, 1}}, kNaN},
         {{t, {0.2, 0.2, 0.2 + 0.05 * std::sin(9.0 * t)}, {0, 0, 0, 1}}, t}}};
    const auto& [pose, time] = poses[static_cast<std::size_t>(k++) % poses.size()];
    static_cast<void>(body.push(pose.position, pose.rotation, {time, {}}));
    static_cast<void>(
        body.push(pose.position, pose.rotation, {time, {}}));  // and the same stamp again
  };
}

void add_trackers(std::vector<Trial>& all) {
  for (const double way : {0.5, 5.0, 50.0}) {
    all.push_back(track("jumps of " + std::to_string(static_cast<int>(way * 10)) + " tenths dp",
                        [way] { return jumping(way); }));
  }
  all.push_back(track("gaps of 110 ms", with_gaps));
  all.push_back(track("poses that are none", nonsense));
}

void add_speeds(std::vector<Trial>& all) {
  for (const double speed : {0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
    const double way = 0.35;
    all.push_back({.group = 4,
                   .name = "plunge at " + std::to_string(speed).substr(0, 4) + " m/s",
                   .seconds = std::min(way / speed, 1.5) + 0.4,
                   .speed = speed,
                   .scene = [=](double s) {
                     return with(basin(s), {moved(ball({}), {{0.0, {0.2, 0.2, 0.44}},
                                                             {way / speed, {0.2, 0.2, 0.09}}})});
                   }});
  }
}

void add_squeezes(std::vector<Trial>& all) {
  const Vector3 plate = {0.2, 0.2, 0.06};
  all.push_back({.group = 5,
                 .name = "pressed to the floor",
                 .seconds = 1.0,
                 .speed = kPinched,
                 .scene = [=](double s) {
                   return with(basin(s),
                               {moved(box("plate", plate, {}),
                                      {{0.0, {0.2, 0.2, 0.3}}, {0.5, {0.2, 0.2, 0.035}}})});
                 }});
  all.push_back({.group = 5,
                 .name = "two bodies close",
                 .seconds = 1.0,
                 .speed = kPinched,
                 .scene = [=](double s) {
                   const Vector3 wall = {0.06, 0.2, 0.16};
                   return with(basin(s),
                               {moved(box("left", wall, {}),
                                      {{0.0, {0.08, 0.2, 0.12}}, {0.5, {0.165, 0.2, 0.12}}}),
                                moved(box("right", wall, {}),
                                      {{0.0, {0.32, 0.2, 0.12}}, {0.5, {0.235, 0.2, 0.12}}})});
                 }});
  all.push_back({.group = 5,
                 .name = "into a corner",
                 .seconds = 1.0,
                 .speed = kPinched,
                 .scene = [=](double s) {
                   return with(
                       basin(s),
                       {moved(ball({}), {{0.0, {0.2, 0.2, 0.3}}, {0.5, {0.06, 0.06, 0.06}}})});
                 }});
  all.push_back({.group = 5,
                 .name = "a piston to the brim",
                 .seconds = 1.2,
                 .speed = 4.0,
                 .scene = [](double s) {
                   Scene scene = basin(s);
                   scene.wave_maker = {true, 0.25, 2.0};
                   return scene;
                 }});
}

void add_reported_bodies(std::vector<Trial>& all) {
  all.push_back({.name = "a body appears in the water",
                 .seconds = 0.6,
                 .speed = 5.0,
                 .harmed = true,
                 .scene =
                     [](double s) {
                       return with(basin(s), {tracked(ball({0.2, 0.2, 5.0}, 0.16))});
                     },
                 .drive =
                     [] {
                       return [](Simulation& s) {
                         if (s.seconds() < 0.1) return;
                         static_cast<void>(s.live_body(0)->push({0.2, 0.2, 0.1}, {0, 0, 0, 1},
                                                                {s.seconds(), {}}));
                       };
                     }});
  all.push_back(
      {.name = "spikes of a body's speed", .seconds = 0.6, .speed = 20.0, .scene = [](double s) {
         std::vector<std::pair<double, Vector3>> way = {{0.0, {0.2, 0.2, 0.2}}};
         for (int k = 1; k < 6; ++k) {
           way.push_back({0.1 * k, {0.2, 0.2, 0.2}});
           way.push_back({0.1 * k + 0.002, {0.2, 0.2, 0.16}});  // 20 m/s for 2 ms
           way.push_back({0.1 * k + 0.004, {0.2, 0.2, 0.2}});
         }
         return with(basin(s), {moved(ball({}), way)});
       }});
}

}  // namespace

void add_body_trials(std::vector<Trial>& all) {
  add_rests(all);
  add_break(all);
  add_trackers(all);
  add_speeds(all);
  add_squeezes(all);
  add_reported_bodies(all);
}

}  // namespace splash::stress
