// SPDX-License-Identifier: MIT
#include "tests/validation/run.hpp"

#include <sys/resource.h>

#include "protocol/time_tag.hpp"
#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation.hpp"

namespace splash::validation {

namespace {

std::filesystem::path folder() {
  return std::filesystem::path(SPLASH_SOURCE_DIR) / "tests" / "validation";
}

/// User time of all threads so far [s].
double processor_time() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

}  // namespace

sim::Scene scene_named(const std::string& name) {
  return sim::read_scene(folder() / "scenes" / (name + ".yaml"));
}

Series reference_named(const std::string& name) {
  return Series::read(folder() / "reference" / (name + ".csv"));
}

Run run_scene(sim::Device& device, const std::string& name, const Setting& setting, double seconds,
              const std::function<void(double)>& progress) {
  Run run;
  run.scene = scene_named(name);
  run.scene.fluid.spacing = setting.spacing;
  run.scene.fluid.smoothing = setting.smoothing;
  run.scene.fluid.solver = setting.solver;
  const double wall = protocol::monotonic_now();
  const double processor = processor_time();
  sim::Simulation simulation(device, run.scene, {});
  sim::Gauges gauges(run.scene);
  run.gauges = Series(gauges.columns());
  const auto sample = [&] {
    const double now = simulation.seconds();
    if (gauges.is_due(now)) {
      run.gauges.add(gauges.read(now, simulation.fluid(), simulation.bodies()));
    }
  };
  sample();
  while (simulation.seconds() < seconds) {
    static_cast<void>(simulation.advance());
    sample();
    if (progress) progress(simulation.seconds() / seconds);
  }
  run.particles = simulation.particles();
  run.steps = simulation.totals().steps;
  run.simulated = simulation.seconds();
  run.wall = protocol::monotonic_now() - wall;
  run.processor = processor_time() - processor;
  return run;
}

}  // namespace splash::validation
