// SPDX-License-Identifier: MIT
// How fast the built-in scenes run on this machine, beside the paper's rates: water, bodies and
// detectors, without waiting for the clock and without a receiver. Prints a table; with a file
// name, also writes it as CSV.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "protocol/time_tag.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation.hpp"

namespace {

using namespace splash;
using namespace splash::sim;

constexpr double kSeconds = 5.0;  ///< of each run, simulated
constexpr int kRuns = 3;

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
};

/// One run: {steps per second, simulated seconds per second}.
std::pair<double, double> run_once(Device& device, const Scene& scene, Result& result) {
  Simulation simulation(device, scene, {});
  const double start = protocol::monotonic_now();
  while (simulation.seconds() < kSeconds) static_cast<void>(simulation.advance());
  const double wall = protocol::monotonic_now() - start;
  const RunTotals& totals = simulation.totals();
  result.particles = simulation.particles();
  result.mean_error = totals.mean_excess_sum / static_cast<double>(totals.frames);
  result.max_error = totals.max_excess;
  return {static_cast<double>(totals.steps) / wall, simulation.seconds() / wall};
}

Result measure(Device& device, const Scene& scene) {
  Result result;
  std::vector<std::pair<double, double>> runs;
  for (int k = 0; k < kRuns; ++k) runs.push_back(run_once(device, scene, result));
  std::sort(runs.begin(), runs.end());
  result.steps_per_second = runs[kRuns / 2].first;
  result.real_time_factor = runs[kRuns / 2].second;
  return result;
}

void bench(const std::filesystem::path& csv) {
  Device device;
  std::printf("device: %s\n", describe(device.facts()).c_str());
  std::printf("median of %d runs of %.0f s, water, bodies and detectors, nobody listening\n\n",
              kRuns, kSeconds);
  std::printf("scene     particles  steps/s  paper's  real time x  M updates/s  density error\n");
  std::ofstream file(csv);
  if (file) file << "scene,particles,steps_per_second,real_time_factor,mean_density_error\n";
  const std::vector<Case> cases = {
      {"basin", 240.0}, {"pool", 152.0}, {"beach", 147.0}, {"bucket", 0.0}, {"rest", 0.0}};
  for (const Case& item : cases) {
    const auto path = std::filesystem::path(SPLASH_SOURCE_DIR) / "configs" / "scenes";
    const Result r = measure(device, read_scene(path / (item.scene + ".yaml")));
    const std::string paper =
        item.paper_rate > 0.0 ? std::to_string(std::lround(item.paper_rate)) : "-";
    std::printf("%-9s %9d  %7.0f  %7s  %11.2f  %11.2f  mean %.2f %%, max %.1f %%\n",
                item.scene.c_str(), r.particles, r.steps_per_second, paper.c_str(),
                r.real_time_factor, 1e-6 * r.steps_per_second * r.particles, 100.0 * r.mean_error,
                100.0 * r.max_error);
    std::fflush(stdout);
    if (file) {
      file << item.scene << ',' << r.particles << ',' << r.steps_per_second << ','
           << r.real_time_factor << ',' << r.mean_error << '\n';
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    bench(argc > 1 ? argv[1] : "");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench-scenes: " << error.what() << '\n';
    return 70;
  }
}
