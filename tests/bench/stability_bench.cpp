// SPDX-License-Identifier: MIT
// The stability suite: every trial with both solvers at three resolutions, at the default time step
// and at twice that; faults at a hundred places; where it ends, as maps; and endurance.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>

#include "protocol/time_tag.hpp"
#include "tests/stress/endurance.hpp"
#include "tests/stress/faults.hpp"
#include "tests/stress/stability_map.hpp"
#include "tests/stress/trial.hpp"
#include "tests/support/source_folder.hpp"

namespace {

using namespace splash;
using namespace splash::stress;
using sim::PressureKind;

struct Options {
  std::filesystem::path out = tests::source_folder() / "out" / "stability";
  std::vector<std::string> parts;
  std::vector<int> groups;
  std::vector<double> spacings = {0.05, 0.035, 0.025};
  std::vector<double> factors = {1.0, 2.0};
  int places = 100;
  Endurance endurance;
  bool divergence_free = false;
  int device = -1;
};

constexpr PressureKind kSolvers[] = {PressureKind::weakly_compressible,
                                     PressureKind::divergence_free};

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

/// Returns how many did not pass.
int run_trials(sim::Device& device, const Options& options) {
  std::ofstream csv(options.out / "trials.csv");
  csv << "group,trial,solver,spacing,factor,particles,steps,fastest,mean_excess,max_excess,events,"
         "retried,calmed,resets,least_step,calm,drift,inside,broken\n";
  int failed = 0;
  int done = 0;
  for (const Trial& trial : all_trials()) {
    const auto& groups = options.groups;
    if (!groups.empty() && std::find(groups.begin(), groups.end(), trial.group) == groups.end()) {
      continue;
    }
    for (const PressureKind solver : kSolvers) {
      for (const double spacing : options.spacings) {
        if (spacing < trial.finest) continue;
        for (const double factor : options.factors) {
          const Verdict v = run_trial(device, trial, {solver, spacing, factor});
          csv << trial.group << ',' << std::quoted(trial.name) << ',' << name_of(solver) << ','
              << spacing << ',' << factor << ',' << v.particles << ',' << v.steps << ','
              << v.fastest << ',' << v.mean_excess << ',' << v.max_excess << ',' << v.events << ','
              << v.retried << ',' << v.calmed << ',' << v.resets << ',' << v.least_step << ','
              << v.calm << ',' << v.drift << ',' << v.inside << ',' << join(v.broken) << '\n'
              << std::flush;
          ++done;
          failed += !v.passes();
          std::printf("%4d  %2d %-34s %-4s %5.3f m x%.1f  %6.2f m/s %5.1f %%  again %2llu  %s\n",
                      done, trial.group, trial.name.c_str(), name_of(solver), spacing, factor,
                      v.fastest, 100.0 * v.mean_excess, static_cast<unsigned long long>(v.retried),
                      v.passes() ? "passed" : join(v.broken).c_str());
          if (!v.passes() && !v.step_fault.empty()) std::printf("      %s\n", v.step_fault.c_str());
          std::fflush(stdout);
        }
      }
    }
  }
  std::printf("trials: %d of %d passed: %s\n", done - failed, done,
              (options.out / "trials.csv").c_str());
  return failed;
}

int run_injections(sim::Device& device, const Options& options) {
  std::ofstream csv(options.out / "faults.csv");
  csv << "water,fault,places,seen,told,longest,finite\n";
  int failed = 0;
  int total = 0;
  for (const Water& water : all_waters()) {
    const std::string name = name_of(water);
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
      csv << name << ',' << injection.name << ',' << outcomes.size() << ',' << seen << ',' << told
          << ',' << longest << ',' << finite << '\n'
          << std::flush;
      std::printf("%-26s %-36s seen %d of %zu, told %zu, ill for %.3f s at most\n", name.c_str(),
                  injection.name.c_str(), seen, outcomes.size(), told, longest);
      std::fflush(stdout);
    }
  }
  std::printf("faults: %d of %d passed\n", total - failed, total);
  return failed;
}

int bench(const Options& options) {
  std::filesystem::create_directories(options.out);
  sim::Device device(options.device);
  std::printf("device: %s\n", describe(device.facts()).c_str());
  int failed = 0;
  if (wants(options, "faults")) failed += run_injections(device, options);
  if (wants(options, "trials")) failed += run_trials(device, options);
  if (wants(options, "maps")) draw_maps(device, options.out);
  if (wants(options, "endurance")) failed += endure(device, options.endurance, options.out);
  std::printf("%s\n", failed == 0 ? "all passed" : (std::to_string(failed) + " failed").c_str());
  return failed == 0 ? 0 : 1;
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
  app.add_flag("--divergence-free", options.divergence_free, "The endurance run's solver");
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("What the water survives: faults, trials, maps of where it ends, endurance.",
               "bench-stability");
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
  app.add_option("--out", options.out, "Folder for CSV and pictures")->capture_default_str();
  app.add_option("--device", options.device, "OpenCL device as sim-server --list-devices counts");
  CLI11_PARSE(app, argc, argv);
  if (options.divergence_free) options.endurance.solver = PressureKind::divergence_free;
  try {
    return bench(options);
  } catch (const std::exception& error) {
    std::cerr << "bench-stability: " << error.what() << '\n';
    return 70;
  }
}
