// SPDX-License-Identifier: MIT
// What a scene does not need and what leaving it out saves: the plunge and SPHERIC 2 with each skip
// on or off, and a settled pool of which a tenth moves, asleep and awake.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/bench/opencl_ledger.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/detections.hpp"
#include "tests/support/scene_text.hpp"
#include "tests/validation/series.hpp"

namespace {

using namespace splash;
using namespace splash::bench;
using namespace splash::sim;

/// A scene to be held against itself.
struct SkipScene {
  std::string name;
  sim::Scene scene;  ///< with gauges
  double seconds = 0.0;
};

/// A way to run it.
struct SkipVariant {
  std::string name;
  sim::SkipSettings skip;
  double time_step_factor = 1.0;
};

struct SkipRun {
  validation::Series gauges;
  sim::Detections found;
  sim::RunTotals totals;
  double processor = 0.0;  ///< of the frames, user time of all cores [s]
};

/// How far two runs are apart; heights and pressures by the gauges' names.
struct SkipDifference {
  double height_most = 0.0;    ///< [m]
  double height_rms = 0.0;     ///< [m]
  double pressure_rms = 0.0;   ///< [Pa]
  double pressure_size = 0.0;  ///< rms of the pressures themselves [Pa]
  bool same_events = false;    ///< each of them, bit by bit
};

constexpr double kShorter = 0.999;

GaugeSettings probe(const char* name, GaugeKind kind, const Vector3& place) {
  GaugeSettings settings;
  settings.name = name;
  settings.kind = kind;
  settings.place = place;  // of pressures
  settings.x = place[0];   // of heights
  settings.y = place[1];
  return settings;
}

/// As shipped, with gauges.
SkipScene plunge() {
  Scene scene = read_scene(tests::scene_file("plunge"));
  scene.gauges.rate = 50.0;
  scene.gauges.probes = {probe("near", GaugeKind::height, {0.15, 0.05, 0.0}),
                         probe("corner", GaugeKind::height, {0.25, -0.25, 0.0}),
                         probe("floor", GaugeKind::pressure, {0.0, 0.0, 0.0}),
                         probe("side", GaugeKind::pressure, {0.3, 0.1, 0.1})};
  return {"plunge", scene, 4.0};
}

/// With particles 4 cm apart.
SkipScene spheric2() {
  Scene scene = read_scene(tests::source_folder() / "tests/validation/scenes/spheric2.yaml");
  scene.fluid.spacing = 0.04;
  return {"spheric2", scene, 6.0};
}

/// Sums over what two gauges say at the same times.
struct Apart {
  double most = 0.0;
  double squares = 0.0;
  double size = 0.0;
  double count = 0.0;

  void add(const validation::Series& a, const validation::Series& b, const std::string& name) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      const double value = a[name][k];
      const double off = value - validation::interpolate(b["time"], b[name], a["time"][k]);
      most = std::max(most, std::abs(off));
      squares += off * off;
      size += value * value;
      ++count;
    }
  }
};

/// All on; each off; all off; and all off with steps shorter by a thousandth, which is the noise:
/// what two runs of the same water differ by.
std::vector<SkipVariant> skip_variants() {
  SkipSettings none;
  none.sleep = none.idle = none.contacts = none.bubbles = none.cavities = none.kernels = false;
  std::vector<SkipVariant> all = {{"all skips on", {}}};
  const std::vector<std::pair<std::string, bool SkipSettings::*>> switches = {
      {"sleep off", &SkipSettings::sleep},       {"idle off", &SkipSettings::idle},
      {"contacts off", &SkipSettings::contacts}, {"bubbles off", &SkipSettings::bubbles},
      {"cavities off", &SkipSettings::cavities}, {"kernels off", &SkipSettings::kernels}};
  for (const auto& [name, member] : switches) {
    SkipSettings skip;
    skip.*member = false;
    all.push_back({name, skip});
  }
  all.push_back({"all off", none});
  all.push_back({"noise", none, kShorter});
  return all;
}

SkipRun run_with(Device& device, const SkipScene& item, const SkipVariant& variant) {
  SkipRun run;
  Scene scene = item.scene;
  scene.skip = variant.skip;
  scene.fluid.time_step_factor *= variant.time_step_factor;
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  run.gauges = validation::Series(gauges.columns());
  while (simulation.seconds() < item.seconds) {
    if (gauges.is_due(simulation.seconds())) {
      run.gauges.add(gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies()));
    }
    const double before = processor_time();
    const FrameResult frame = simulation.advance();
    run.processor += processor_time() - before;
    tests::append_found(run.found, frame.found);
  }
  run.totals = simulation.totals();
  return run;
}

SkipDifference difference(const SkipRun& a, const SkipRun& b) {
  Apart heights;
  Apart pressures;
  for (const std::string& name : a.gauges.names()) {
    if (name.ends_with("_height")) heights.add(a.gauges, b.gauges, name);
    if (name.ends_with("_pressure")) pressures.add(a.gauges, b.gauges, name);
  }
  return {heights.most, std::sqrt(heights.squares / heights.count),
          std::sqrt(pressures.squares / pressures.count),
          std::sqrt(pressures.size / pressures.count),
          tests::numbers_of(a.found) == tests::numbers_of(b.found)};
}

// The paper's pool, settled, with a stirrer in one corner that keeps about a tenth of its water
// awake: what sleep saves in steady state.

struct StirredPool {
  int particles = 0;
  double awake = 0.0;        ///< share of the particles that moved, mean over the frames [1]
  double asleep_step = 0.0;  ///< processor time of a step with sleep [s]
  double awake_step = 0.0;   ///< and without [s]
  /// By kernel, per step [s], with sleep and without.
  std::map<std::string, std::pair<double, double>> stages;
};

constexpr double kSettled = 8.0;   ///< until then all but the stirrer's corner sleeps [s]
constexpr double kMeasured = 4.0;  ///< whole turns of the stirrer [s]
constexpr double kTurn = 2.0;      ///< the paddle goes there and back [s]

/// That far [m], so that it keeps a tenth of the particles awake: finer water is stirred less far.
double way_of(int particles) {
  return particles > 30'000 ? 0.034 : 0.022;
}

/// A paddle that goes to and fro in the corner, slowly.
Scene stirred(int particles) {
  Scene scene = read_scene(tests::scene_file("pool"));
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
  Half(Device& device, const Scene& scene) : simulation(device, scene, {}) {}

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

/// Both run the same seconds of the same scene by turns, after the settling.
StirredPool measure_stirred_pool(Device& device, int particles) {
  Scene scene = stirred(particles);
  Half sleeping(device, scene);
  scene.skip.sleep = false;
  Half waking(device, scene);
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

/// Where the time goes.
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

struct Options {
  std::vector<std::string> parts;
  std::vector<int> sizes = {15'000, 60'000};
  int device = -1;
};

Row row(const SkipScene& scene, const SkipVariant& variant, const SkipRun& run,
        const SkipRun& all_off) {
  const SkipDifference d = difference(run, all_off);
  const sim::SkipTotals& skipped = run.totals.skipped;
  const auto percent = [&](double frames) {
    return number(100.0 * frames / static_cast<double>(run.totals.frames));
  };
  return {scene.name,
          variant.name,
          number(run.processor),
          number(1e3 * d.height_most),
          number(1e3 * d.height_rms),
          number(100.0 * d.pressure_rms / d.pressure_size),
          std::to_string(run.found.impacts.size()),
          std::to_string(run.found.bubbles.size()),
          std::to_string(run.found.cavities.size()),
          d.same_events ? "yes" : "no",
          percent(skipped.asleep_sum),
          percent(static_cast<double>(skipped.idle)),
          percent(static_cast<double>(skipped.contacts)),
          percent(static_cast<double>(skipped.bubbles)),
          percent(static_cast<double>(skipped.cavities))};
}

void compare(Bench& bench, sim::Device& device) {
  bench.say(
      "Each skip on or off, against all off; the noise is all off with steps shorter by a "
      "thousandth. Pressures by the rms of their own; the last five columns are shares of "
      "particles asleep and of frames without the work. \"Same\": each event, bit by bit.");
  auto table = bench.table("skips.csv",
                           {"scene", "skips", "processors [s]", "heights, most [mm]", "rms [mm]",
                            "pressures [%]", "impacts", "bubbles", "cavities", "same", "asleep [%]",
                            "idle [%]", "no contacts [%]", "no bubbles [%]", "no cavities [%]"});
  for (const SkipScene& scene : {plunge(), spheric2()}) {
    std::vector<SkipVariant> variants = skip_variants();
    const auto off = std::find_if(variants.begin(), variants.end(),
                                  [](const SkipVariant& v) { return v.name == "all off"; });
    const SkipRun all_off = run_with(device, scene, *off);
    for (const SkipVariant& variant : variants) {
      table.add(row(scene, variant, run_with(device, scene, variant), all_off));
    }
  }
  bench.tell(table);
}

void measure_sleep(Bench& bench, sim::Device& device, const std::vector<int>& sizes) {
  bench.say(
      "A settled pool (state equation) with a paddle in one corner that keeps about a tenth of it "
      "moving; the same frames with sleep on and off, processor time per step:");
  auto table = bench.table(
      "sleep.csv", {"particles", "awake [%]", "with sleep [ms]", "without [ms]", "saved [%]"});
  for (const int particles : sizes) {
    const StirredPool pool = measure_stirred_pool(device, particles);
    table.add({std::to_string(pool.particles), number(100.0 * pool.awake),
               number(1e3 * pool.asleep_step), number(1e3 * pool.awake_step),
               number(100.0 * (1.0 - pool.asleep_step / pool.awake_step))});
    print_stages(pool);
  }
  bench.tell(table);
}

bool run(Bench& bench, const Options& options) {
  sim::Device device(options.device, true);
  bench.set_device(describe(device.facts()));
  if (is_wanted(options.parts, "equality")) compare(bench, device);
  if (is_wanted(options.parts, "sleep")) measure_sleep(bench, device, options.sizes);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Bench bench("skips", "performance.md", "What skipping saves",
              "What skipping saves, and that it changes nothing.");
  CLI::App& app = bench.options();
  app.add_option("--part", options.parts, "Only these: equality, sleep (repeatable)")
      ->check(CLI::IsMember({"equality", "sleep"}));
  app.add_option("--particles", options.sizes, "In the pool that a paddle moves (repeatable)");
  bench.add_device_option(options.device);
  return bench.run(argc, argv, [&] { return run(bench, options); });
}
