// SPDX-License-Identifier: MIT
// Two frames, or more, of the detectors over fast water, bodies and bubbles, a look at the air that
// is folded in and one at the walls' push as gauges take it: every kernel of theirs, small enough
// for an OpenCL interpreter. Arguments: particles per vector (1, 8 or 16), and how many frames.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "sim-server/detect/air_folds.hpp"
#include "sim-server/detect/detector.hpp"
#include "sim-server/gauge/gauges.hpp"
#include "tests/sim-server/detect/detect_rig.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace {

/// The places where air is folded in.
std::size_t folds_in(splash::sim::Water& water, splash::sim::DetectSettings settings) {
  settings.bubble_energy = 0.4;
  settings.bubble_onset = 0.01;
  splash::sim::AirFolds folds(*water.fluid, splash::sim::detect_program(water.fluid->device()));
  folds.enqueue(water.step_at(0.0), settings, 0);
  folds.enqueue_read();
  water.fluid->device().queue().finish();
  return folds.read().size();
}

int two_frames(int lanes, std::uint32_t frames) {
  using namespace splash::sim;
  constexpr double kFrame = 0.005;  // [s]
  // As on two cores: a simulated device has one.
  Device device(-1, false, lanes == 1 ? gpu_profile() : cpu_profile(2, lanes));
  Water water = two_bodies();
  water.particles = random_places(230, {0, 0, 0}, {0.4, 0.4, 0.14}, 51);
  water.start(device);
  water.stir(2.0, 52);
  DetectSettings settings;  // whatever moves makes a bubble, wherever there is one is a cavity
  settings.bubble_speed = 0.1;
  settings.bubble_gradient = 0.0;
  settings.bubble_per_particle = true;
  settings.cavity_by_count = true;
  settings.cavity_colour = 0.0;
  Detector detector(*water.fluid, sample_skins(water.scene.bodies, 0.02), settings, 1, true);
  std::size_t cavities = 0;
  for (std::uint32_t frame = 0; frame <= frames; ++frame) {
    water.step(1.0e-3, [&](Fluid&) { detector.enqueue(water.step_at(1.0e-3), kFrame); });
    detector.enqueue_read();
    device.queue().finish();
    cavities += detector.collect(water.time, kFrame, frame).cavities.size();
  }
  const std::size_t pushed = WallPush(*water.fluid).read(*water.fluid, water.step_at(0.0)).size();
  const std::size_t folds = folds_in(water, settings);
  std::printf("%s: %d particles, %zu bubbles, %zu cavities, %zu folds\n",
              device.facts().platform.c_str(), water.params.count, detector.bubbles_alive(),
              cavities, folds);
  const bool all =
      detector.bubbles_alive() > 0 && detector.cavity_searches() > 0 && pushed > 0 && folds > 0;
  return all ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return two_frames(argc > 1 ? std::atoi(argv[1]) : 0,
                      argc > 2 ? static_cast<std::uint32_t>(std::atoi(argv[2])) : 2);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
