// SPDX-License-Identifier: MIT
#include "tests/sim-server/detect/scene_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim-server/scene/scene_reader.hpp"

namespace splash::sim {
namespace {

/// Around the tank's middle, where the bodies go in: twice the plunging disc's [m].
constexpr double kConeRadius = 0.2;

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Height of the water's surface [m]: what the volume of all particles around the tank's middle
/// fills, weighted by a cone so that hardly any stands on an edge. Independent of any colour field,
/// and of how the surface is packed.
double water_level(Simulation& simulation, double floor) {
  Fluid& fluid = simulation.fluid();
  const FluidParams& p = fluid.params();
  const Snapshot snapshot = fluid.snapshot();
  double weights = 0.0;
  for (std::size_t i = 0; i < snapshot.id.size(); ++i) {
    const Vector3 place = snapshot.place(i);
    weights += std::max(1.0 - std::hypot(place[0], place[1]) / kConeRadius, 0.0);
  }
  const double cone = std::numbers::pi * kConeRadius * kConeRadius / 3.0;
  const double volume = static_cast<double>(p.mass / p.rest_density);
  const double height = weights * volume / cone;
  // Less what its own weight compresses it by.
  const double sound = static_cast<double>(p.sound_speed);
  return floor + height +
         static_cast<double>(p.gravity_z) * height * height / (2.0 * sound * sound);
}

}  // namespace

SceneRun run_scene(const std::string& text, double seconds) {
  Device device;
  const Scene scene = parse_scene(text, "test scene");
  Simulation simulation(device, scene, {});
  SceneRun run;
  while (simulation.seconds() < seconds) {
    const std::int64_t steps = simulation.totals().steps;
    const double before = simulation.seconds();
    const FrameResult frame = simulation.advance();
    const double count = static_cast<double>(simulation.totals().steps - steps);
    run.frame = std::max(run.frame, frame.seconds - before);
    run.time_step = std::max(run.time_step, (frame.seconds - before) / count);
    append(run.found.impacts, frame.found.impacts);
    append(run.found.bubbles, frame.found.bubbles);
    append(run.found.cavities, frame.found.cavities);
    const bool over = !run.found.impacts.empty() &&
                      frame.seconds > run.found.impacts.front().time + 2.0 * run.frame;
    if (!scene.bodies.empty() && !over) {
      run.gauges.push_back({frame.seconds, water_level(simulation, scene.tank.lower[2]),
                            simulation.bodies().state(0, frame.seconds).position[2]});
    }
  }
  run.totals = simulation.totals();
  return run;
}

}  // namespace splash::sim
