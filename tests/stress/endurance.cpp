// SPDX-License-Identifier: MIT
#include "tests/stress/endurance.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

#include "protocol/time_tag.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation.hpp"

namespace splash::stress {
namespace {

constexpr double kLinePeriod = 10.0;  ///< between two lines of progress [s]
constexpr double kGrowth = 1.0;       ///< of memory that is allowed per hour [MiB/h]
constexpr double kPages = 0.5;        ///< and whatever the time: the allocator's grain [MiB]

/// Resident memory [MiB].
double resident() {
  std::ifstream statm("/proc/self/statm");
  std::int64_t size = 0;
  std::int64_t pages = 0;
  statm >> size >> pages;
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

int descriptors() {
  const auto all = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<int>(std::distance(begin(all), end(all)));
}

struct Endured {
  std::int64_t steps = 0;
  double simulated = 0.0;  ///< [s]
  double wall = 0.0;       ///< [s]
  double growth = 0.0;     ///< of memory since a tenth of the steps [MiB]
  double hours = 0.0;      ///< in which it grew
  int opened = 0;          ///< descriptors more than then
  int lost = 0;            ///< particles
  sim::RunTotals totals;
  [[nodiscard]] bool passes() const {
    return totals.resets + totals.calmed == 0 && lost == 0 && opened <= 0 &&
           growth <= kPages + kGrowth * hours;
  }
};

int lost_of(sim::Simulation& simulation) {
  std::vector<int> ids = simulation.fluid().snapshot().id;
  std::sort(ids.begin(), ids.end());
  const auto last = std::unique(ids.begin(), ids.end());
  return simulation.particles() - static_cast<int>(last - ids.begin());
}

Endured run(sim::Device& device, const std::string& name, std::int64_t steps) {
  sim::Simulation simulation(device,
                             sim::read_scene(std::filesystem::path(SPLASH_SOURCE_DIR) / "configs" /
                                             "scenes" / (name + ".yaml")),
                             {});
  Endured result;
  const double start = protocol::monotonic_now();
  double line = start;
  double memory = resident();
  double warm = start;
  int files = descriptors();
  bool settled = false;
  std::int64_t idle = 0;
  // A scene that sleeps takes no steps: frames are counted in their place.
  while (simulation.totals().steps + idle < steps) {
    const std::int64_t before = simulation.totals().steps;
    static_cast<void>(simulation.advance());
    idle += simulation.totals().steps == before;
    const std::int64_t done = simulation.totals().steps + idle;
    const double now = protocol::monotonic_now();
    if (!settled && 10 * done >= steps) {
      settled = true;
      memory = resident();
      files = descriptors();
      warm = now;
    }
    if (now < line) continue;
    line = now + kLinePeriod;
    std::printf("\r%-8s %9lld of %lld steps  %.1f MiB", name.c_str(), static_cast<long long>(done),
                static_cast<long long>(steps), resident());
    std::fflush(stdout);
  }
  result.steps = simulation.totals().steps;
  result.simulated = simulation.seconds();
  result.wall = protocol::monotonic_now() - start;
  result.growth = resident() - memory;
  result.hours = (protocol::monotonic_now() - warm) / 3600.0;
  result.opened = descriptors() - files;
  result.lost = lost_of(simulation);
  result.totals = simulation.totals();
  return result;
}

}  // namespace

int endure(sim::Device& device, std::int64_t steps, const std::filesystem::path& out) {
  std::ofstream csv(out / "endurance.csv");
  csv << "scene,steps,simulated,wall,retried,calmed,resets,lost,memory_growth_mib,opened\n";
  int failed = 0;
  for (const std::string name : {"pool", "basin", "beach", "bucket", "plunge", "rest"}) {
    const Endured r = run(device, name, steps);
    failed += !r.passes();
    csv << name << ',' << r.steps << ',' << r.simulated << ',' << r.wall << ',' << r.totals.retried
        << ',' << r.totals.calmed << ',' << r.totals.resets << ',' << r.lost << ',' << r.growth
        << ',' << r.opened << '\n'
        << std::flush;
    std::printf(
        "\r%-8s %lld steps, %.0f s simulated: again %llu, given up %llu, resets %llu, lost "
        "%d, memory %+.2f MiB, files %+d  %s\n",
        name.c_str(), static_cast<long long>(r.steps), r.simulated,
        static_cast<unsigned long long>(r.totals.retried),
        static_cast<unsigned long long>(r.totals.calmed),
        static_cast<unsigned long long>(r.totals.resets), r.lost, r.growth, r.opened,
        r.passes() ? "passed" : "FAILED");
    std::fflush(stdout);
  }
  return failed;
}

}  // namespace splash::stress
