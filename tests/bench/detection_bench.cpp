// SPDX-License-Identifier: MIT
// What the detectors tell of scripted motions and recordings, against what is true of them:
// report.md and cases.csv, a row for each sweep.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include "sim-server/scene/solver_choice.hpp"
#include "tests/bench/progress.hpp"
#include "tests/bench/report.hpp"
#include "tests/detection/table.hpp"
#include "tests/support/text_of.hpp"

namespace {

using namespace splash;
using namespace splash::detection;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> sweeps;
  std::vector<std::string> cases;
  fs::path scenes;
  fs::path readme;
  bool quick = false;
  bool list = false;
  bool truth = false;
  int device = -1;
  std::optional<sim::PressureKind> solver;
  Material material;
  fs::path hand;
  std::vector<std::string> hand_markers;
  std::vector<double> hand_size = {0.18, 0.09, 0.04};
};

void complete(Options& options) {
  Material& material = options.material;
  const Walk own = own_walk();
  if (material.walk.file.empty()) material.walk.file = own.file;
  if (material.walk.left.empty()) material.walk.left = own.left;
  if (material.walk.right.empty()) material.walk.right = own.right;
  if (material.walk.file == own.file) material.walk.contacts = own.contacts;
  if (options.hand.empty()) {
    material.hands = {{own.file, own.right, {0.25, 0.1, 0.07}}};
  } else {
    const std::vector<double>& size = options.hand_size;
    material.hands = {{options.hand, options.hand_markers, {size[0], size[1], size[2]}}};
  }
}

std::vector<Case> chosen(const Options& options) {
  std::vector<Case> cases = all_cases(options.material);
  std::erase_if(cases, [&](const Case& item) {
    return !bench::is_wanted(options.sweeps, item.sweep) ||
           !bench::is_wanted(options.cases, item.name) || (options.quick && !item.quick);
  });
  if (cases.empty()) throw std::runtime_error("no such case: --list shows them");
  return cases;
}

/// Each as a scene file, so that it can be run and looked at alone.
void keep_scenes(const fs::path& folder, const std::vector<Case>& cases) {
  fs::create_directories(folder);
  for (const Case& item : cases) {
    std::string name = item.sweep + "_" + item.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ' ' || c == '/'; }, '_');
    std::ofstream file(folder / (name + ".yaml"));
    file << "# " << item.sweep << ": " << item.name << ", " << item.seconds << " s";
    if (!item.tracker.empty()) file << ", --tracker " << item.tracker.string();
    file << '\n' << item.scene;
  }
}

void show_truth(const Case& item) {
  for (const Entry& entry : truth_of(item)) {
    std::printf("    body %zu at %.3f to %.3f s, %.2f m/s down, %.0f mm clear before: %s\n",
                entry.body, entry.time, entry.until, entry.down, 1.0e3 * entry.clear,
                entry.wanted ? "wanted" : "allowed");
  }
}

void tell(const bench::Progress& progress, const Outcome& outcome) {
  const Score& s = outcome.score;
  std::printf(
      "%s: told %d of %d, false %d; cavities %d, stray %d; %d bubbles  (%.1f s of processor)\n",
      progress.end().c_str(), s.hit, s.wanted, s.untrue, s.cavities, s.stray, s.bubbles,
      outcome.processor);
  for (const std::string& fault : s.faults) std::printf("    %s\n", fault.c_str());
  std::fflush(stdout);
}

void update(const fs::path& path, const std::vector<Outcome>& outcomes, bool all) {
  const std::string updated = with_rows(tests::text_of(path), outcomes, all);
  std::ofstream file(path);
  file << updated;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

void run(bench::Bench& bench, Options options) {
  complete(options);
  options.material.folder = bench.out() / "files";
  fs::create_directories(options.material.folder);
  const std::vector<Case> cases = chosen(options);
  if (!options.scenes.empty()) keep_scenes(options.scenes, cases);
  if (options.list) {
    for (const Case& item : cases) {
      std::printf("%-10s %s\n", item.sweep.c_str(), item.name.c_str());
      if (options.truth) show_truth(item);
    }
    return;
  }
  sim::Device device(options.device);
  bench.set_device(describe(device.facts()));
  std::vector<Outcome> outcomes;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    bench::Progress progress(std::to_string(k + 1) + "/" + std::to_string(cases.size()) + "  " +
                             cases[k].sweep + ": " + cases[k].name);
    outcomes.push_back(
        run_case(device, cases[k], options.solver, [&](double share) { progress(share); }));
    tell(progress, outcomes.back());
    // After every run, so that a run that is broken off leaves what it found.
    write_report(bench.out(), device.facts().name, outcomes);
  }
  const bool all = cases.size() == all_cases(options.material).size();
  if (!options.readme.empty()) update(options.readme, outcomes, all);
  std::printf("\n%s\nreport: %s\n", summary(outcomes).c_str(), (bench.out() / "report.md").c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Walk& walk = options.material.walk;
  bench::Bench bench(
      "detection",
      "Holds impacts and cavities against the motions' own truth: report.md, cases.csv.");
  CLI::App& app = bench.options();
  app.add_option("--sweep", options.sweeps, "Only this sweep (repeatable)")->type_name("NAME");
  app.add_option("--case", options.cases, "Only this case (repeatable)")->type_name("NAME");
  app.add_flag("--quick", options.quick, "A few that stand for all");
  app.add_flag("--list", options.list, "Names sweeps and cases, runs nothing");
  app.add_flag("--truth", options.truth, "With --list: what each must tell, and may");
  app.add_option("--scenes", options.scenes, "Folder to keep each case in, as a scene file");
  app.add_option(
         "--readme", options.readme,
         "Markdown file whose table gets the rows of this run, and no others if it is of all cases")
      ->check(CLI::ExistingFile);
  app.add_option("--walk", walk.file, "TRC file of two feet, in place of the tests' own")
      ->check(CLI::ExistingFile);
  app.add_option("--left", walk.left, "Its left foot's markers, heel and toe first")
      ->delimiter(',');
  app.add_option("--right", walk.right, "Its right foot's markers")->delimiter(',');
  CLI::Option* hand = app.add_option("--hand", options.hand, "TRC file of a body that plunges");
  hand->check(CLI::ExistingFile);
  app.add_option("--hand-markers", options.hand_markers, "Three or more of its markers")
      ->delimiter(',')
      ->needs(hand);
  app.add_option("--hand-size", options.hand_size, "Edges of its box [m]")
      ->delimiter(',')
      ->expected(3);
  bench.add_device_option(options.device);
  bench.add_choice("--solver", options.solver,
                   {sim::PressureKind::weakly_compressible, sim::PressureKind::grid_projected},
                   "Instead of what suits each case");
  return bench.run(argc, argv, [&] {
    run(bench, options);
    return true;
  });
}
