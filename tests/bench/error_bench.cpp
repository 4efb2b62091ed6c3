// SPDX-License-Identifier: MIT
// Run time against error: validation cases with each solver, with half the time step and with the
// reference kernels, beside two other programs. Prints each run and writes CSV and PNG.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "tests/bench/error_chart.hpp"
#include "tests/bench/error_sweep.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace splash;
using namespace splash::bench;

struct Options {
  std::vector<std::string> cases;  ///< empty: all
  std::size_t resolutions = 2;
  bool all = false;
  Clock clock = Clock::wall;
  int device = -1;
};

SweepPlan plan_of(const Options& options) {
  SweepPlan plan;
  plan.resolutions = options.all ? 100 : options.resolutions;
  plan.qualities = options.all ? all_qualities() : quick_qualities();
  for (const SweepCase& item : sweep_cases()) {
    const bool named =
        std::find(options.cases.begin(), options.cases.end(), item.name) != options.cases.end();
    if (named || options.cases.empty()) plan.cases.push_back(&item);
  }
  return plan;
}

bool run(Bench& bench, const Options& options) {
  const sim::DeviceFacts facts = sim::Device(options.device).facts();
  bench.set_device(describe(facts));
  const ChartSettings chart = {options.clock, facts.compute_units, facts.name};
  // After every run, so that a sweep that is broken off leaves what it found.
  const auto points =
      sweep(plan_of(options), options.device, [&](const std::vector<SweepPoint>& so_far) {
        write_error_chart(bench.out(), chart, so_far);
      });
  bench.tell(explanation(chart));
  bench.show("error.png", "Run time against error");
  bench.tell(markdown(error_table(chart, points)));
  bench.tell(about_peers());
  bench.tell(markdown(peer_table()));
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Bench bench("error", "accuracy.md", "Run time against error",
              "What the water's errors are for the time that it takes.");
  std::vector<std::string> cases;
  for (const SweepCase& item : sweep_cases()) cases.push_back(item.name);
  CLI::App& app = bench.options();
  app.add_option("--case", options.cases, "Only this case (repeatable)")
      ->check(CLI::IsMember(cases));
  app.add_option("--resolutions", options.resolutions, "Only so many, coarse ones first")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  app.add_flag("--all", options.all,
               "All combinations, longer steps and all resolutions: hours instead of minutes");
  const std::map<std::string, Clock> clocks = {{"wall", Clock::wall},
                                               {"processor", Clock::processor}};
  app.add_option("--clock", options.clock,
                 "What the chart is drawn over: wall, or processor where others are at work, too")
      ->transform(CLI::CheckedTransformer(clocks));
  app.add_option("--device", options.device, "OpenCL device as sim-server --list-devices counts");
  return bench.run(argc, argv, [&] { return run(bench, options); });
}
