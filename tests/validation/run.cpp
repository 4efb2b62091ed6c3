// SPDX-License-Identifier: MIT
#include "tests/validation/run.hpp"
#include "tests/support/source_folder.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <iostream>

#include "protocol/time_tag.hpp"
#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/support/vectors.hpp"

namespace splash::validation {

namespace {

std::filesystem::path folder() {
  return tests::source_folder() / "tests" / "validation";
}

/// No water is as fast as twice this, and then nobody looks for bubbles [m/s].
constexpr double kNever = 1.0e6;

/// So far.
Effort effort_now() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return {protocol::monotonic_now(), static_cast<double>(usage.ru_utime.tv_sec) +
                                         1e-6 * static_cast<double>(usage.ru_utime.tv_usec)};
}

void add_since(const Effort& before, Effort& sum) {
  const Effort now = effort_now();
  sum.wall += now.wall - before.wall;
  sum.processor += now.processor - before.processor;
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
  run.scene.fluid.solver = setting.solver;
  run.scene.fluid.time_step_factor *= setting.time_step_factor;
  if (setting.skip) run.scene.skip = *setting.skip;
  run.scene.serve.frame_rate = std::min(run.scene.serve.frame_rate, setting.most_frames);
  if (!setting.detects) run.scene.detect.bubble_speed = kNever;
  const Effort start = effort_now();
  sim::Simulation simulation(device, run.scene, {});
  sim::Gauges gauges(run.scene);
  simulation.measure_forces();
  run.gauges = Series(gauges.columns());
  const auto sample = [&] {
    const double now = simulation.seconds();
    if (gauges.is_due(now)) {
      run.gauges.add(gauges.read(now, simulation.fluid(), simulation.bodies()));
    }
  };
  sample();
  while (simulation.seconds() < seconds) {
    const Effort before = effort_now();
    const sim::FrameResult frame = simulation.advance();
    // What was put back or begun anew is no figure of the water's.
    if (frame.step_fault) std::cerr << name << ": " << describe(*frame.step_fault) << '\n';
    add_since(before, run.steps_alone);
    sample();
    if (progress) progress(simulation.seconds() / seconds);
  }
  run.particles = simulation.particles();
  const sim::Snapshot water = simulation.fluid().snapshot();
  run.places = tests::vectors_of(water.position, water.id.size());
  run.velocities = tests::vectors_of(water.velocity, water.id.size());
  run.steps = simulation.totals().steps;
  run.simulated = simulation.seconds();
  run.work = simulation.solver_work();
  run.totals = simulation.totals();
  add_since(start, run.all);
  return run;
}

}  // namespace splash::validation
