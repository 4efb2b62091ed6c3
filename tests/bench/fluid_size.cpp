// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "program/text.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/bench/fluid_cost.hpp"
#include "tests/bench/opencl_ledger.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

constexpr int kSteps = 10;  ///< of a batch
constexpr double kPoolSeconds = 2.0;

struct StageTimes {
  std::map<std::string, Launches> kernels;
  std::int64_t steps = 0;
  double wall = 0.0;  ///< [s]
};

constexpr int kSizes[] = {2'000,   4'000,   8'000,     15'625,    30'000,    60'000,    125'000,
                          250'000, 500'000, 1'000'000, 2'000'000, 4'000'000, 8'000'000, 16'000'000};

/// Of a step with so many particles.
struct Cost {
  double particles = 0.0;
  double step = 0.0;     ///< [s]
  double busy = 0.0;     ///< of processors [s]
  double memory = 0.0;   ///< of all buffers [B]
  double seconds = 0.0;  ///< that measuring took [s]
};

Cost cost_of(Device& device, int count) {
  Cost cost;
  const double begin = protocol::monotonic_now();
  const std::size_t others = buffer_bytes();
  Block block(device, count);
  cost.memory = static_cast<double>(buffer_bytes() - others);
  const int batches = count > 200'000 ? 3 : 7;
  const double processor = processor_time();
  cost.step = wall_time(
                  [&] {
                    for (int k = 0; k < kSteps; ++k) block.move();
                    device.queue().finish();
                  },
                  batches) /
              kSteps;
  cost.busy = (processor_time() - processor) / (kSteps * batches);
  cost.particles = block.params.count;
  cost.seconds = protocol::monotonic_now() - begin;
  return cost;
}

void add(Table& table, const char* what, const StageTimes& times) {
  std::vector<std::pair<std::string, Launches>> sorted(times.kernels.begin(), times.kernels.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
  Launches all;
  for (const auto& [name, stage] : sorted) {
    all.seconds += stage.seconds;
    all.count += stage.count;
  }
  const auto steps = static_cast<double>(times.steps);
  const auto row = [&](const std::string& name, double launches, double seconds) {
    table.add({what, name, number(launches / steps), number(1e3 * seconds / steps),
               number(100.0 * seconds / all.seconds)});
  };
  for (const auto& [name, stage] : sorted) {
    row(name, static_cast<double>(stage.count), stage.seconds);
  }
  row("all", static_cast<double>(all.count), all.seconds);
  row("between them", static_cast<double>(all.count), times.wall - all.seconds);
}

StageTimes of_cube(Device& device, int count) {
  Block block(device, count);
  StageTimes times;
  times.steps = 100;
  begin_ledger();
  const double start = protocol::monotonic_now();
  for (int k = 0; k < times.steps; ++k) block.move();
  device.queue().finish();
  times.wall = protocol::monotonic_now() - start;
  times.kernels = end_ledger();
  return times;
}

StageTimes of_pool(Device& device) {
  Simulation pool(device, read_scene(tests::scene_file("pool")), {});
  StageTimes times;
  begin_ledger();
  const double start = protocol::monotonic_now();
  while (pool.seconds() < kPoolSeconds) static_cast<void>(pool.advance());
  times.wall = protocol::monotonic_now() - start;
  times.kernels = end_ledger();
  times.steps = pool.totals().steps;
  return times;
}

}  // namespace

bool Until::allows(double seconds) const {
  return end == 0.0 || protocol::monotonic_now() + seconds < end;
}

void against_size(Bench& bench, Device& device, int most_particles, const Until& until) {
  bench.say("The whole step with the state equation, without walls and bodies, in batches of " +
            std::to_string(kSteps) + "; median of 7, of large sizes of 3:");
  auto table = bench.table("size.csv", {"particles", "ms per step", "of processors", "steps/s",
                                        "million updates/s", "MiB", "bytes per particle"});
  Cost last;
  for (const int count : kSizes) {
    if (count > most_particles) break;
    const double ratio = count / std::max(last.particles, 1.0);
    if (!until.allows(1.2 * ratio * last.seconds)) {
      std::printf("%d would take longer than there is time\n", count);
      break;
    }
    if (ratio * last.memory > 0.8 * static_cast<double>(device.facts().memory)) {
      std::printf("%d would take %.0f MiB of %zu\n", count, ratio * last.memory / 1048576.0,
                  device.facts().memory >> 20U);
      break;
    }
    last = cost_of(device, count);
    table.add({number(last.particles, 8), number(1e3 * last.step), number(1e3 * last.busy),
               number(1.0 / last.step), number(1e-6 * last.particles / last.step),
               number(last.memory / 1048576.0), number(last.memory / last.particles)});
  }
  bench.tell(table);
}

void stage_by_stage(Bench& bench, Device& device) {
  const auto [wall, processor] = empty_launch(device);
  bench.say(program::format(
      "A launch that does nothing takes %.1f us, %.1f us of processors. Kernel by kernel:",
      1e6 * wall, 1e6 * processor));
  auto table = bench.table("stages.csv",
                           {"water", "kernel", "launches per step", "ms per step", "of all [%]"});
  add(table, "cube of 15,625", of_cube(device, 15'625));
  add(table, "pool", of_pool(device));
  bench.tell(table);
}

}  // namespace splash::bench
