// SPDX-License-Identifier: MIT
// The fluid's cost on this machine: the two main kernels beside the same sums written by hand in
// C++, the whole step from 2,000 to a million particles (16 million if asked for), its stages, and
// what each kernel asks beside what the device can do. Prints tables and writes CSV and SVG.
#include <map>
#include <string>
#include <vector>

#include "protocol/time_tag.hpp"
#include "tests/bench/fluid_cost.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace splash;
using namespace splash::bench;

struct Options {
  std::vector<std::string> parts;
  int most_particles = 1'000'000;
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

bool run(Bench& bench, const Options& options) {
  sim::Device device = device_of(options);
  bench.set_device(describe(device.facts()));
  const auto wants = [&](const char* part) { return is_wanted(options.parts, part); };
  if (wants("kernels")) beside_the_yardstick(bench, device, options.most_particles);
  if (wants("size")) against_size(bench, device, options.most_particles, options.until());
  if (wants("limits") || wants("pool")) {
    against_limits(bench, device, wants("limits"), wants("pool"), options.most_particles,
                   options.until(), options.other_device());
  }
  if (wants("stages")) stage_by_stage(bench, device);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Bench bench("fluid", "performance.md", "What a step costs", "What the fluid costs.");
  CLI::App& app = bench.options();
  app.add_option("--part", options.parts,
                 "Only these: kernels, size, stages, limits (of a cube), pool (its limits) "
                 "(repeatable)")
      ->check(CLI::IsMember({"kernels", "size", "stages", "limits", "pool"}));
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
  bench.add_device_option(options.device);
  app.add_option(
         "--profile", options.profile,
         "How kernels, size, stages, limits and pool cut work: cpu, cpu-ranks (cpu with the "
         "sort of gpu) or gpu (default: as suits the device)")
      ->check(CLI::IsMember({"cpu", "cpu-ranks", "gpu"}));
  return bench.run(argc, argv, [&] { return run(bench, options); });
}
