// SPDX-License-Identifier: MIT
// How fast the built-in scenes run on this machine, beside the paper's rates: water, bodies and
// detectors, without waiting for the clock and without a receiver. Runs of a scene must end in the
// same bits, and none may go wrong.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "program/text.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/scene_text.hpp"

namespace {

using namespace splash;
using namespace splash::sim;

struct Options {
  std::vector<std::string> scenes;
  std::vector<PressureKind> solvers;  ///< empty: the scene's own
  double seconds = 5.0;               ///< of each run, simulated
  int runs = 3;
};

struct Case {
  std::string scene;
  double paper_rate;  ///< steps per second of the paper's section 6, 0: not in it
};

struct Result {
  int particles = 0;
  double steps_per_second = 0.0;  ///< median of the runs
  double real_time_factor = 0.0;
  double mean_error = 0.0;
  double max_error = 0.0;
  std::string broken;  ///< what went wrong; empty: nothing
};

const std::vector<Case>& cases() {
  static const std::vector<Case> kCases = {{"basin", 240.0}, {"pool", 152.0}, {"beach", 147.0},
                                           {"bucket", 0.0},  {"rest", 0.0},   {"plunge", 0.0},
                                           {"walk", 0.0},    {"ducks", 0.0},  {"boat", 0.0}};
  return kCases;
}

/// A recorded walk is an argument of the command line elsewhere.
std::filesystem::path tracker_of(const Scene& scene) {
  for (const BodySettings& body : scene.bodies) {
    if (body.motion.kind == MotionKind::trc && body.motion.file.empty()) {
      return tests::scene_folder() / "walk.trc";
    }
  }
  return {};
}

bool same(const Snapshot& a, const Snapshot& b) {
  return a.id == b.id && a.position == b.position && a.velocity == b.velocity;
}

/// One run: {steps per second, simulated seconds per second}.
std::pair<double, double> run_once(Device& device, const Scene& scene, double seconds,
                                   Result& result, Snapshot& end) {
  Simulation simulation(device, scene, tracker_of(scene));
  const double start = protocol::monotonic_now();
  while (simulation.seconds() < seconds) static_cast<void>(simulation.advance());
  const double wall = protocol::monotonic_now() - start;
  const RunTotals& totals = simulation.totals();
  result.particles = simulation.particles();
  result.mean_error = totals.mean_excess_sum / static_cast<double>(totals.frames);
  result.max_error = totals.max_excess;
  if (totals.calmed + totals.resets > 0) result.broken = "frames were given up";
  const Snapshot here = simulation.fluid().snapshot();
  if (!end.id.empty() && !same(end, here)) result.broken = "the same run ended in other bits";
  end = here;
  return {static_cast<double>(totals.steps) / wall, simulation.seconds() / wall};
}

Result measure(Device& device, const Scene& scene, const Options& options) {
  Result result;
  Snapshot end;
  std::vector<std::pair<double, double>> runs;
  for (int k = 0; k < options.runs; ++k) {
    runs.push_back(run_once(device, scene, options.seconds, result, end));
  }
  std::sort(runs.begin(), runs.end());
  result.steps_per_second = runs[runs.size() / 2].first;
  result.real_time_factor = runs[runs.size() / 2].second;
  return result;
}

/// `own`: the solver of the scene file.
bench::Row row(const Case& item, PressureKind solver, PressureKind own, const Result& r) {
  const auto rounded = [](double value) { return std::to_string(std::lround(value)); };
  return {item.scene,
          name_of(solver),
          solver == own ? "yes" : "no",
          std::to_string(r.particles),
          rounded(r.steps_per_second),
          item.paper_rate > 0.0 ? rounded(item.paper_rate) : "",
          bench::number(r.real_time_factor),
          bench::number(1e-6 * r.steps_per_second * r.particles),
          bench::number(100.0 * r.mean_error),
          bench::number(100.0 * r.max_error),
          r.broken};
}

/// Whether nothing went wrong.
bool run(bench::Bench& bench, const Options& options) {
  Device device;
  bench.set_device(describe(device.facts()));
  bench.say(program::format(
      "Median of %d runs of %g s; water, bodies and detectors; events are sent to no synth.",
      options.runs, options.seconds));
  auto table = bench.table("scenes.csv", {"scene", "solver", "as shipped", "particles", "steps/s",
                                          "paper's", "real-time factor", "million updates/s",
                                          "mean density error [%]", "largest [%]", "wrong"});
  bool sound = true;
  for (const Case& item : cases()) {
    if (!bench::is_wanted(options.scenes, item.scene)) continue;
    Scene scene = read_scene(tests::scene_file(item.scene));
    const PressureKind own = scene.fluid.solver;
    for (const PressureKind solver : options.solvers.empty() ? std::vector{own} : options.solvers) {
      scene.fluid.solver = solver;
      const Result r = measure(device, scene, options);
      sound = sound && r.broken.empty();
      table.add(row(item, solver, own, r));
    }
  }
  bench.tell(table);
  return sound;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  bench::Bench bench("scenes", "performance.md", "The built-in scenes",
                     "How fast the built-in scenes run.");
  std::vector<std::string> names;
  for (const Case& item : cases()) names.push_back(item.scene);
  CLI::App& app = bench.options();
  app.add_option("--scene", options.scenes, "Only this scene (repeatable)")
      ->check(CLI::IsMember(names));
  bench.add_choice("--solver", options.solvers,
                   {PressureKind::weakly_compressible, PressureKind::grid_projected},
                   "This one, whatever the scene has (repeatable)");
  app.add_option("--seconds", options.seconds, "Of each run, simulated")
      ->check(CLI::Range(0.1, 1.0e4))
      ->capture_default_str();
  app.add_option("--runs", options.runs, "Of each scene")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  return bench.run(argc, argv, [&] { return run(bench, options); });
}
