// SPDX-License-Identifier: MIT
// The stability suite: every trial with each solver at three resolutions, at the default time step
// and at twice that; faults at a hundred places; where it ends, as maps; and endurance.
#include <algorithm>
#include <concepts>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "sim-server/scene/solver_choice.hpp"
#include "tests/bench/report.hpp"
#include "tests/stress/endurance.hpp"
#include "tests/stress/faults.hpp"
#include "tests/stress/stability_map.hpp"
#include "tests/stress/trial.hpp"

namespace {

using namespace splash;
using namespace splash::stress;
using sim::PressureKind;

struct Options {
  std::vector<std::string> parts;
  std::vector<int> groups;
  std::vector<double> spacings = {0.05, 0.035, 0.025};
  std::vector<double> factors = {1.0, 2.0};
  int places = 100;
  Endurance endurance;
  std::vector<PressureKind> solvers = {PressureKind::weakly_compressible,
                                       PressureKind::grid_projected};
  int device = -1;
};

bool wants(const Options& options, const char* part) {
  return options.parts.empty() ||
         std::find(options.parts.begin(), options.parts.end(), part) != options.parts.end();
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "; ") + word;
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

std::string whole(std::integral auto count) {
  return std::to_string(count);
}

std::string passed(int failed, int done) {
  return whole(done - failed) + " of " + whole(done) + " passed.";
}

/// Returns how many did not pass.
int run_trials(bench::Bench& bench, sim::Device& device, const Options& options) {
  using bench::number;
  auto table = bench.table(
      "trials.csv", {"trial", "group", "solver", "spacing [m]", "factor", "particles", "steps",
                     "fastest [m/s]", "mean_excess", "max_excess", "events", "retried", "calmed",
                     "resets", "least_step", "calm [m/s]", "drift [m]", "inside", "broken"});
  int failed = 0;
  int done = 0;
  for (const Trial& trial : all_trials()) {
    const auto& groups = options.groups;
    if (!groups.empty() && std::find(groups.begin(), groups.end(), trial.group) == groups.end()) {
      continue;
    }
    for (const PressureKind solver : options.solvers) {
      for (const double spacing : options.spacings) {
        if (spacing < trial.finest) continue;
        for (const double factor : options.factors) {
          const Verdict v = run_trial(device, trial, {solver, spacing, factor});
          table.add({trial.name, whole(trial.group), short_name_of(solver), number(spacing),
                     number(factor), whole(v.particles), whole(v.steps), number(v.fastest),
                     number(v.mean_excess), number(v.max_excess), whole(v.events), whole(v.retried),
                     whole(v.calmed), whole(v.resets), number(v.least_step), number(v.calm),
                     number(v.drift), number(v.inside), join(v.broken)});
          ++done;
          failed += !v.passes();
          if (!v.passes() && !v.step_fault.empty()) std::printf("      %s\n", v.step_fault.c_str());
        }
      }
    }
  }
  bench.tell("Trials at the spacings and steps asked for, each solver: " + passed(failed, done));
  return failed;
}

int run_injections(bench::Bench& bench, sim::Device& device, const Options& options) {
  auto table = bench.table("faults.csv", {"fault", "water", "places", "seen", "events told",
                                          "ill for at most [s]", "finite"});
  int failed = 0;
  int total = 0;
  for (const PressureKind solver : options.solvers) {
    const Water water = {solver};
    const std::string name = sim::name_of(solver);
    sim::Simulation simulation(device, still_scene(water, 0.35), {});
    for (const Injection& injection : injections()) {
      const auto outcomes = run_faults(simulation, {injection}, options.places, 2026);
      int seen = 0;
      std::size_t told = 0;
      double longest = 0.0;
      bool finite = true;
      for (const Outcome& o : outcomes) {
        seen += o.seen;
        told += o.told;
        longest = std::max(longest, o.ill_for);
        finite = finite && o.finite;
        failed += !o.passes();
      }
      total += static_cast<int>(outcomes.size());
      table.add({injection.name, name, whole(outcomes.size()), whole(seen), whole(told),
                 bench::number(longest), finite ? "yes" : "NO"});
    }
  }
  bench.tell("Faults put into the water, " + whole(injections().size()) + " kinds, " +
             whole(options.places) + " places each, each solver: " + passed(failed, total));
  return failed;
}

bool run(bench::Bench& bench, const Options& options) {
  sim::Device device(options.device);
  bench.set_device(describe(device.facts()));
  int failed = 0;
  if (wants(options, "faults")) failed += run_injections(bench, device, options);
  if (wants(options, "trials")) failed += run_trials(bench, device, options);
  if (wants(options, "maps")) draw_maps(device, bench.out());
  if (wants(options, "endurance")) {
    const int lost = endure(device, options.endurance, bench.out());
    bench.tell("Endurance, " + whole(options.endurance.steps) + " steps of each scene: " +
               (lost == 0 ? "nothing lost, no reset, memory flat." : whole(lost) + " failed."));
    failed += lost;
  }
  std::printf("%s\n", failed == 0 ? "all passed" : (std::to_string(failed) + " failed").c_str());
  return failed == 0;
}

void add_endurance(CLI::App& app, Options& options) {
  app.add_option("--steps", options.endurance.steps, "Of each scene in the endurance run")
      ->check(CLI::Range(100, 100000000));
  app.add_option("--scene", options.endurance.scenes, "Endures (repeatable); else all do");
  app.add_option("--coarser", options.endurance.coarser,
                 "Spacings of the endurance run, in the scene's")
      ->check(CLI::Range(1.0, 4.0));
  app.add_option("--minutes", options.endurance.minutes,
                 "The endurance run ends after these; the next one goes on from there")
      ->check(CLI::Range(0.0, 1.0e5));
}

void add_solvers(CLI::App& app, Options& options) {
  std::map<std::string, PressureKind> solvers;
  for (const PressureKind solver : options.solvers) solvers[sim::name_of(solver)] = solver;
  app.add_option("--solver", options.solvers,
                 "Only with this one: weakly_compressible or grid_projected "
                 "(repeatable); endurance with the first")
      ->transform(CLI::CheckedTransformer(solvers));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  bench::Bench bench("stability", "robustness.md", "What the water survives",
                     "What the water survives: faults, trials, maps of where it ends, endurance.");
  CLI::App& app = bench.options();
  app.add_option("--part", options.parts,
                 "Only this part (repeatable): faults trials maps endurance")
      ->check(CLI::IsMember({"faults", "trials", "maps", "endurance"}));
  app.add_option("--group", options.groups, "Only trials of this group (repeatable)")
      ->check(CLI::Range(0, 13));
  app.add_option("--spacing", options.spacings, "Particle spacings of the trials [m]")
      ->check(CLI::Range(0.01, 0.1))
      ->capture_default_str();
  app.add_option("--factor", options.factors, "Time steps of the trials, in the default")
      ->check(CLI::Range(0.05, 2.0))
      ->capture_default_str();
  app.add_option("--places", options.places, "Of each fault")->check(CLI::Range(1, 100000));
  add_endurance(app, options);
  add_solvers(app, options);
  app.add_option("--device", options.device, "OpenCL device as sim-server --list-devices counts");
  return bench.run(argc, argv, [&] {
    options.endurance.solver = options.solvers.front();
    return run(bench, options);
  });
}
