// SPDX-License-Identifier: MIT
// Two steps, or more, of a small fluid with walls, slope, piston and bodies, a third of it in a
// mould, and two in which it may sleep: every kernel once, small enough for an OpenCL interpreter.
// Arguments: particles per vector (1, 8 or 16), whether the water is divergence-free (1), whether
// it moves the bodies (1), and how many steps.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/start/mould.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace {

std::vector<bool> every_third(std::size_t count) {
  std::vector<bool> flags(count);
  for (std::size_t i = 0; i < count; i += 3) flags[i] = true;
  return flags;
}

int two_steps(int lanes, bool divergence_free, bool free, int steps) {
  using namespace splash::sim;
  Device device(-1, false, lanes);
  Water water = two_bodies();
  water.particles = random_places(230, {0, 0, 0}, {0.4, 0.4, 0.14}, 51);
  for (int i = 0; i < 21; ++i) water.particles.push_back({0.2, 0.1 + 0.01 * i, 0.3});
  if (divergence_free) water.scene.fluid.solver = PressureKind::divergence_free;
  water.scene.slope = {true, 0.2, 0.3};
  water.scene.wave_maker = {true, 0.1, 2.0};
  water.piston = {0.01, 0.2};
  water.start(device);
  if (free) {
    for (BodySettings& body : water.scene.bodies) {
      body.motion.kind = MotionKind::free;
      body.motion.density = 300.0;
    }
    water.fluid->let_go(free_bodies(water.scene.bodies),
                        film_skins(water.scene.bodies, water.scene.fluid.spacing));
  }
  water.fluid->begin_watch(static_cast<std::size_t>(steps) + 2);
  Mould mould(*water.fluid, every_third(water.particles.size()));
  for (int k = 0; k < steps; ++k) {
    water.step(1.0e-3);
    mould.put_back();
  }
  water.fluid->let_sleep({.speed = 0.05, .frames = 1});
  Step sleepy = water.step_at(1.0e-3);
  sleepy.opens_frame = true;
  for (int k = 0; k < 2; ++k) {
    water.fluid->still();
    water.fluid->prepare(sleepy);
    water.fluid->advance(sleepy);
  }
  const Survey survey = water.fluid->survey();
  std::printf("%s: %d particles, %d body points, fastest %.3f m/s, %d faulty\n",
              device.facts().platform.c_str(), water.params.count,
              water.fluid->boundary().point_count(), survey.speed, survey.not_finite);
  return survey.not_finite == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return two_steps(argc > 1 ? std::atoi(argv[1]) : 0, argc > 2 && std::atoi(argv[2]) == 1,
                     argc > 3 && std::atoi(argv[3]) == 1, argc > 4 ? std::atoi(argv[4]) : 2);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
