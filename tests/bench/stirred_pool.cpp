// SPDX-License-Identifier: MIT
#include "tests/bench/stirred_pool.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/support/source_folder.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

constexpr double kSettled = 8.0;   ///< until then all but the stirrer's corner sleeps [s]
constexpr double kMeasured = 4.0;  ///< whole turns of the stirrer [s]
constexpr double kTurn = 2.0;      ///< the paddle goes there and back [s]

/// That far [m], so that it keeps a tenth of the particles awake: finer water is stirred less far.
double way_of(int particles) {
  return particles > 30'000 ? 0.034 : 0.022;
}

/// A paddle that goes to and fro in the corner, slowly.
Scene stirred(int particles) {
  Scene scene = read_scene(tests::source_folder() / "configs" / "scenes" / "pool.yaml");
  scene.fluid.particles = particles;
  // On the grid all water sleeps or none.
  scene.fluid.solver = PressureKind::weakly_compressible;
  BodySettings paddle;
  paddle.name = "paddle";
  paddle.shape = {ShapeKind::box, {0.10, 0.10, 0.10}, 0.0, 0.0};
  paddle.motion.kind = MotionKind::script;
  paddle.motion.repeat = true;
  const Vector3 here = {0.15, 0.15, 0.12};
  const Vector3 there = {0.15 + way_of(particles), 0.15, 0.12};
  for (const auto& [time, place] : {std::pair{0.0, here}, {kTurn / 2.0, there}, {kTurn, here}}) {
    Keyframe key;
    key.time = time;
    key.position = place;
    paddle.motion.keyframes.push_back(key);
  }
  paddle.rest = paddle.motion.keyframes.front();
  scene.bodies = {paddle};
  return scene;
}

/// One of the two runs.
struct Half {
  Half(Device& device, Scene scene, bool sleeps)
      : simulation(device,
                   [&] {
                     scene.skip.sleep = sleeps;
                     return scene;
                   }(),
                   {}) {}

  /// A quarter of a second by the processors' clock, then one by the kernels' own: to note each
  /// launch costs some of the time, too.
  void measure() {
    const std::int64_t before = simulation.totals().steps;
    const double processor = processor_time();
    frames += run(asleep);
    seconds += processor_time() - processor;
    steps += simulation.totals().steps - before;
    begin_ledger();
    const std::int64_t noted_before = simulation.totals().steps;
    double ignored = 0.0;
    static_cast<void>(run(ignored));
    noted_steps += simulation.totals().steps - noted_before;
    for (const auto& [name, launches] : end_ledger()) stages[name] += launches.seconds;
  }

  /// Frames that it took.
  int run(double& sum_asleep) {
    int ran = 0;
    const double until = simulation.seconds() + kTurn / 8.0;
    while (simulation.seconds() < until) {
      sum_asleep += static_cast<double>(simulation.advance().stats.asleep);
      ++ran;
    }
    return ran;
  }

  Simulation simulation;
  std::map<std::string, double> stages;
  double seconds = 0.0;
  double asleep = 0.0;
  int frames = 0;
  std::int64_t steps = 0;
  std::int64_t noted_steps = 0;  ///< with the ledger open
};

}  // namespace

StirredPool measure_stirred_pool(Device& device, int particles) {
  const Scene scene = stirred(particles);
  Half sleeping(device, scene, true);
  Half waking(device, scene, false);
  for (Half* half : {&sleeping, &waking}) {
    while (half->simulation.seconds() < kSettled) static_cast<void>(half->simulation.advance());
  }
  while (sleeping.simulation.seconds() < kSettled + kMeasured) {
    sleeping.measure();
    waking.measure();
  }
  StirredPool pool;
  pool.particles = sleeping.simulation.particles();
  pool.awake = 1.0 - sleeping.asleep / sleeping.frames / pool.particles;
  pool.asleep_step = sleeping.seconds / static_cast<double>(sleeping.steps);
  pool.awake_step = waking.seconds / static_cast<double>(waking.steps);
  const auto per_step = [](double seconds, const Half& half) {
    return seconds / static_cast<double>(half.noted_steps);
  };
  for (const auto& [name, seconds] : sleeping.stages) {
    pool.stages[name] = {per_step(seconds, sleeping), per_step(waking.stages[name], waking)};
  }
  return pool;
}

void print_stages(const StirredPool& pool) {
  std::vector<std::pair<std::string, std::pair<double, double>>> sorted(pool.stages.begin(),
                                                                        pool.stages.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.second.first > b.second.first; });
  std::printf("    on the device, ms per step              asleep   awake\n");
  double asleep = 0.0;
  double awake = 0.0;
  for (const auto& [name, times] : sorted) {
    asleep += times.first;
    awake += times.second;
    if (times.first < 1e-6) continue;
    std::printf("    %-38s %7.4f %7.4f\n", name.c_str(), 1e3 * times.first, 1e3 * times.second);
  }
  std::printf("    %-38s %7.4f %7.4f  %.1f %% saved\n", "together", 1e3 * asleep, 1e3 * awake,
              100.0 * (1.0 - asleep / awake));
}

}  // namespace splash::bench
