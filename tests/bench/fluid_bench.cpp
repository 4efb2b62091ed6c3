// SPDX-License-Identifier: MIT
// The fluid's cost on this machine: the two main kernels beside the same sums written by hand in
// C++, the whole step from 2,000 to a million particles (16 million if asked for), its stages, and
// what each kernel asks beside what the device can do; and run time against error, of validation
// cases with every quality setting. Prints tables and writes CSV, Markdown, PNG and SVG.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/time_tag.hpp"
#include "tests/bench/fluid_chart.hpp"
#include "tests/bench/fluid_cost.hpp"
#include "tests/bench/fluid_sweep.hpp"
#include "tests/support/source_folder.hpp"

namespace {

using namespace splash;
using namespace splash::bench;

struct Options {
  std::vector<std::string> parts = {"kernels", "size", "stages", "limits", "pool", "error"};
  std::vector<std::string> cases;
  std::filesystem::path out = tests::source_folder() / "out" / "fluid";
  std::size_t resolutions = 2;
  int most_particles = 1'000'000;
  bool all = false;
  Clock clock = Clock::wall;
  int device = -1;
  std::string profile;        ///< of profiles(); empty: as suits the device
  double seconds = 0.0;       ///< that size, limits and pool may take each; 0: as long as they take
  std::vector<double> there;  ///< GB/s, G operations/s and us a launch of a device to foretell

  [[nodiscard]] Until until() const {
    return {seconds > 0.0 ? protocol::monotonic_now() + seconds : 0.0};
  }
  [[nodiscard]] Limits other_device() const {
    if (there.empty()) return {};
    return {.bandwidth = 1e9 * there[0], .arithmetic = 1e9 * there[1], .launch = 1e-6 * there[2]};
  }

  [[nodiscard]] bool wants(const char* part) const {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  }
};

/// Ways to cut work into pieces, to be tried on any device.
std::map<std::string, sim::Profile> profiles(unsigned units) {
  sim::Profile ranks = sim::cpu_profile(units);
  ranks.sort_chunks = 0;
  return {{"cpu", sim::cpu_profile(units)}, {"cpu-ranks", ranks}, {"gpu", sim::gpu_profile()}};
}

sim::Device device_of(const Options& options) {
  if (options.profile.empty()) return sim::Device(options.device, true);
  const unsigned units = sim::Device(options.device).facts().compute_units;
  return {options.device, true, profiles(units).at(options.profile)};
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

void measure_cost(const Options& options) {
  const std::string path = (options.out / "cost.csv").string();
  File csv(std::fopen(path.c_str(), "w"), std::fclose);
  if (!csv) throw std::runtime_error("cannot write " + path);
  std::fprintf(csv.get(), "what,particles,density_ms,by_hand_ms,forces_ms,by_hand_ms\n");
  sim::Device device = device_of(options);
  if (options.wants("kernels")) beside_the_yardstick(device, options.most_particles, csv.get());
  if (options.wants("size")) {
    against_size(device, options.most_particles, options.until(), csv.get(),
                 options.out / "size.svg");
  }
  const Asks asks = {options.wants("limits"), options.wants("pool")};
  if (asks.cube || asks.pool) {
    against_limits(device, asks, options.most_particles, options.until(), options.other_device(),
                   csv.get());
  }
  if (options.wants("stages")) stage_by_stage(device, csv.get());
  if (std::fclose(csv.release()) != 0) throw std::runtime_error(path + " is not whole");
}

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

void measure(const Options& options) {
  std::filesystem::create_directories(options.out);
  const sim::DeviceFacts facts = sim::Device(options.device).facts();
  std::printf("device: %s\n", describe(facts).c_str());
  for (const char* part : {"kernels", "size", "stages", "limits", "pool"}) {
    if (!options.wants(part)) continue;
    measure_cost(options);
    break;
  }
  if (!options.wants("error")) return;
  const ChartSettings chart = {options.clock, facts.compute_units, facts.name};
  // After every run, so that a sweep that is broken off leaves what it found.
  const auto points =
      sweep(plan_of(options), options.device, [&](const std::vector<SweepPoint>& so_far) {
        write_error_chart(options.out, chart, so_far);
      });
  std::printf("%zu runs: %s\n", points.size(), (options.out / "error.png").c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("What the fluid costs, and what its errors are for it.", "bench-fluid");
  std::vector<std::string> cases;
  for (const SweepCase& item : sweep_cases()) cases.push_back(item.name);
  app.add_option("--part", options.parts,
                 "Only these: kernels, size, stages, limits (of a cube), pool (its limits), error "
                 "(repeatable)")
      ->check(CLI::IsMember({"kernels", "size", "stages", "limits", "pool", "error"}));
  app.add_option("--case", options.cases, "Only this case (repeatable)")
      ->check(CLI::IsMember(cases));
  app.add_option("--resolutions", options.resolutions, "Only so many, coarse ones first")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  app.add_option("--most-particles", options.most_particles, "Of kernels, size, limits and pool")
      ->capture_default_str();
  app.add_option(
         "--seconds", options.seconds,
         "That size, limits and pool may take each: larger sizes are left out (default: all)")
      ->check(CLI::NonNegativeNumber);
  app.add_option(
         "--there", options.there,
         "GB/s, G operations/s and us a launch of a GPU: what limits and pool would be there")
      ->expected(3)
      ->check(CLI::PositiveNumber);
  app.add_flag("--all", options.all, "All qualities at all resolutions: hours instead of minutes");
  const std::map<std::string, Clock> clocks = {{"wall", Clock::wall},
                                               {"processor", Clock::processor}};
  app.add_option("--clock", options.clock,
                 "What the chart is drawn over: wall, or processor where others are at work, too")
      ->transform(CLI::CheckedTransformer(clocks));
  app.add_option("--out", options.out, "Folder for tables and pictures")->capture_default_str();
  app.add_option("--device", options.device, "OpenCL device as sim-server --list-devices counts");
  app.add_option(
         "--profile", options.profile,
         "How kernels, size, stages, limits and pool cut work: cpu, cpu-ranks (cpu with the "
         "sort of gpu) or gpu (default: as suits the device)")
      ->check(CLI::IsMember({"cpu", "cpu-ranks", "gpu"}));
  CLI11_PARSE(app, argc, argv);
  try {
    measure(options);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench-fluid: " << error.what() << '\n';
    return 70;
  }
}
