// SPDX-License-Identifier: MIT
// Both real programs on one machine: the pool in several sizes, with each solver and the default
// step and the longest one, as fast as it can, and the synth that plays its events on 36 tiles into
// a device that throws the sound away. Prints the real-time factor, beside that without a receiver.
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/text.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/median.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/source_folder.hpp"

namespace {

using namespace splash;
using namespace splash::tests;
namespace fs = std::filesystem;

struct Options {
  std::vector<int> particles = {15000, 60000};
  std::vector<std::string> solvers = {"grid_projected", "weakly_compressible"};
  std::vector<double> factors = {1.0, 2.0};  ///< of the default step; load makes steps as long
  int runs = 3;
  double seconds = 4.0;  ///< simulated, of a run [s]
};

/// A run's real-time factor, and what came to the synth.
struct Run {
  double factor = 0.0;
  int particles = 0;
  long events = 0;
};

/// The pool with so many particles, that solver and that step, as a file in `folder`.
fs::path pool(const fs::path& folder, int particles, const std::string& solver, double factor) {
  const fs::path scenes = source_folder() / "configs" / "scenes";
  for (const char* motion : {"pool_left.csv", "pool_right.csv"}) {
    fs::copy_file(scenes / motion, folder / motion, fs::copy_options::overwrite_existing);
  }
  YAML::Node scene = YAML::LoadFile(scenes / "pool.yaml");
  scene["fluid"]["particles"] = particles;
  scene["fluid"]["solver"] = solver;
  scene["fluid"]["time_step_factor"] = factor;
  fs::path file = folder / "pool.yaml";
  std::ofstream(file) << scene << '\n';
  return file;
}

/// Throws std::runtime_error with what the simulator said if it does not end well.
Run run(const fs::path& scene, double seconds, const std::optional<std::string>& target) {
  const fs::path report = scene.parent_path() / "run.json";
  Arguments arguments = {
      "--scene",       scene.string(), "--duration",  std::to_string(seconds),  "--report",
      report.string(), "--listen",     "127.0.0.1:0", "--faster-than-real-time"};
  if (target) arguments.insert(arguments.end(), {"--target", *target});
  const Ended ended = run_program("sim-server", arguments, 3600.0);
  if (ended.code != 0) throw std::runtime_error(ended.text);
  std::ifstream in(report);
  const nlohmann::json json = nlohmann::json::parse(in);
  Run found = {json.at("real_time_factor"), json.at("particles"), 0};
  for (const auto& [kind, count] : json.at("events").items()) found.events += count.get<long>();
  return found;
}

bool measure(bench::Bench& bench, const Options& options) {
  bench.say(program::format(
      "Median real-time factors of %d runs of %g s of the pool, in turn; without start and "
      "settling.",
      options.runs, options.seconds));
  Synth synth({"--rig", rig_path("tiles36.yaml"), "--device", "null"});
  const std::string target = protocol::to_string(synth.endpoint());
  auto table = bench.table("both.csv", {"particles", "solver", "time_step_factor", "with the synth",
                                        "without", "events a second"});
  const auto add = [&](int particles, const std::string& solver, double factor) {
    const fs::path scene = pool(bench.out(), particles, solver, factor);
    std::vector<double> with;
    std::vector<double> without;
    Run first;  // all are of the same water
    for (int k = 0; k < options.runs; ++k) {
      const Run played = run(scene, options.seconds, target);
      if (k == 0) first = played;
      with.push_back(played.factor);
      without.push_back(run(scene, options.seconds, {}).factor);
    }
    table.add({std::to_string(first.particles), solver, bench::number(factor),
               bench::number(median(with)), bench::number(median(without)),
               bench::number(static_cast<double>(first.events) / options.seconds)});
  };
  for (const int particles : options.particles) {
    for (const std::string& solver : options.solvers) {
      for (const double factor : options.factors) add(particles, solver, factor);
    }
  }
  bench.tell(table);
  return synth.process().running();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  bench::Bench bench("both", "performance.md", "Both programs on one machine",
                     "How fast the simulator runs beside the synth that plays it.");
  CLI::App& app = bench.options();
  app.add_option("--particles", options.particles, "Of the pool (repeatable)")
      ->check(CLI::Range(1000, 1000000))
      ->capture_default_str();
  app.add_option("--solver", options.solvers, "Repeatable")
      ->check(CLI::IsMember({"grid_projected", "weakly_compressible"}))
      ->capture_default_str();
  app.add_option("--time-step-factor", options.factors, "Repeatable")
      ->check(CLI::Range(0.05, 2.0))
      ->capture_default_str();
  app.add_option("--runs", options.runs, "Of each")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "Of each run, simulated")
      ->check(CLI::Range(0.1, 1.0e4))
      ->capture_default_str();
  return bench.run(argc, argv, [&] { return measure(bench, options); });
}
