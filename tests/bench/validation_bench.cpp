// SPDX-License-Identifier: MIT
// Runs the validation cases at all their resolutions and leaves a report with pictures.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "program/text.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "tests/bench/progress.hpp"
#include "tests/bench/report.hpp"
#include "tests/validation/report.hpp"

namespace {

using namespace splash;
using namespace splash::validation;

struct Options {
  std::vector<std::string> cases;
  int resolutions = 100;
  int device = -1;
  std::vector<sim::PressureKind> solvers = {sim::PressureKind::weakly_compressible};
  Setting setting;
};

void print(const bench::Progress& progress, const Result& result) {
  std::printf("%s  %d particles, %.1f s (%.1f s of processor)\n", progress.end().c_str(),
              result.particles, result.all.wall, result.all.processor);
  for (const Figure& figure : result.outcome.figures) {
    const char* verdict = "";
    if (figure.has_gate()) verdict = figure.passes() ? "  as wanted" : "  OUTSIDE";
    std::printf("    %-44s %10.4g %s%s\n", figure.name.c_str(), figure.value, figure.unit.c_str(),
                verdict);
  }
  std::fflush(stdout);
}

/// What is not the default.
std::string described(const std::vector<sim::PressureKind>& solvers) {
  if (solvers == Options{}.solvers) return {};
  std::string text;
  for (const sim::PressureKind solver : solvers) {
    text += (text.empty() ? "; solver: " : ", ") + name_of(solver);
  }
  return text;
}

void run(bench::Bench& bench, const Options& options) {
  std::vector<const Case*> wanted;
  for (const std::string& name : options.cases) wanted.push_back(&case_named(name));
  if (wanted.empty()) {
    for (const Case& item : all_cases()) wanted.push_back(&item);
  }
  sim::Device device(options.device);
  bench.set_device(describe(device.facts()) + described(options.solvers));
  std::vector<Result> results;
  for (const Case* item : wanted) {
    const auto count =
        std::min(static_cast<std::size_t>(std::max(options.resolutions, 1)), item->spacings.size());
    for (const sim::PressureKind solver : options.solvers) {
      for (std::size_t k = 0; k < count; ++k) {
        bench::Progress progress(program::format("%-18s %-20s %s/dp = %-4.0f", item->name.c_str(),
                                                 name_of(solver).c_str(), item->size_name.c_str(),
                                                 item->size / item->spacings[k]));
        Setting setting = options.setting;
        setting.solver = solver;
        setting.spacing = item->spacings[k];
        const auto series = bench.out() / "series" / name_of(solver);
        std::filesystem::create_directories(series);
        results.push_back(
            run_case(device, *item, setting, series, [&](double share) { progress(share); }));
        print(progress, results.back());
        // After every run, so that a run that is broken off leaves what it found.
        write_report(bench.out(), device.facts().name + described(options.solvers), results);
      }
    }
  }
  bench.tell(
      "Bold: outside the range that is wanted. dp is the particle spacing; no parameter but it "
      "differs from the shipped defaults. Run times have settling and gauges in them.");
  bench.tell(tables(results));
  std::printf("report: %s\n", (bench.out() / "report.md").c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  bench::Bench bench("validation", "accuracy.md", "The water against references",
                     "Holds the water against references: report.md, figures.csv and pictures.");
  CLI::App& app = bench.options();
  app.add_option("--case", options.cases, "Only this case (repeatable)")->type_name("NAME");
  app.add_option("--resolutions", options.resolutions, "Only so many, coarse ones first")
      ->check(CLI::Range(1, 100));
  bench.add_device_option(options.device);
  bench.add_choice("--solver", options.solvers,
                   {sim::PressureKind::weakly_compressible, sim::PressureKind::grid_projected},
                   "Instead of the default: weakly_compressible or grid_projected "
                   "(repeatable: side by side)");
  app.add_option("--time-step-factor", options.setting.time_step_factor,
                 "Steps so much longer than the default ones")
      ->check(CLI::Range(0.05, 4.0));
  return bench.run(argc, argv, [&] {
    run(bench, options);
    return true;
  });
}
