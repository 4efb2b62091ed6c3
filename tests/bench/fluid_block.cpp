// SPDX-License-Identifier: MIT
#include "tests/bench/fluid_block.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "protocol/time_tag.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/initial_fluid.hpp"

namespace splash::bench {
namespace {

sim::Scene cube(int count) {
  sim::Scene scene;
  scene.fluid.spacing = 0.0355;
  const double edge = std::round(std::cbrt(count)) * scene.fluid.spacing;
  scene.tank.lower = {0.0, 0.0, 0.0};
  scene.tank.upper = {edge, edge, 2.0 * edge};
  scene.water = {{{0.0, 0.0, 0.0}, {edge, edge, edge}}};
  return scene;
}

/// The sums alone: no walls.
sim::FluidParams open(sim::FluidParams params) {
  params.wall_count = 0;
  return params;
}

}  // namespace

double undisturbed(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 10];
}

double wall_time(const std::function<void()>& work, int runs) {
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) {
    const double start = protocol::monotonic_now();
    work();
    times.push_back(protocol::monotonic_now() - start);
  }
  return median(times);
}

double processor_time() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

Block::Block(sim::Device& device, int count)
    : scene(cube(count)),
      params(open(make_params(scene, initial_particles(scene)))),
      fluid(device, params, initial_particles(scene), {}, {}),
      step{.dt = sim::largest_time_step(params, 1.0, 10.0, 1.0)} {
  fluid.set_bodies({});
  for (int k = 0; k < 20; ++k) move();
  device.queue().finish();
}

void Block::move() {
  fluid.prepare(step);
  fluid.advance(step);
}

}  // namespace splash::bench
