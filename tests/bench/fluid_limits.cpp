// SPDX-License-Identifier: MIT
// What a step asks of the device, kernel by kernel, beside what the device can do: one rule for all
// kernels and devices, in which no number is fitted and none belongs to a kernel.
//   time = max(bytes / bandwidth, operations / arithmetic) + runs / their rate
// What overlaps is within the brackets, the rest waits. A step has what the host takes for its
// launches besides. Each rate is that of a probe that does nothing else; bytes stream at the rate
// of arrays that together are as large as all of a step, each written in turn, since a kernel finds
// in the caches what others left there. Probes and kernels count by their fastest run: other
// programs only slow them.
#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "program/text.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/bench/fluid_cost.hpp"
#include "tests/bench/fluid_work.hpp"
#include "tests/bench/opencl_ledger.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

/// Of a device that is not at hand: a run that is looked up takes a sector of 32 bytes from memory.
Limits with_runs(Limits there) {
  there.runs = there.bandwidth / 32.0;
  return there;
}

/// For each step: times [s].
struct Measured {
  std::map<std::string, double> kernels;
  double step = 0.0;
  double commands = 0.0;  ///< besides kernels
};

/// Of water that begins anew, and for how long it does so, at least three times. Much water takes
/// long enough for one.
constexpr int kSteps = 50;
constexpr int kFrames = 3;
constexpr double kSeconds = 4.0;  ///< [s]
constexpr int kLeast = 3;
constexpr int kMuch = 200'000;      ///< particles
constexpr double kPoolMoves = 0.3;  ///< by then a foot is in the water and bubbles rise [s]

/// Each kernel's fastest turn, per step; the mean of all as a whole.
class Measure {
 public:
  Measure(Device& device, int particles)
      : device_(device), least_(particles > kMuch ? 1 : kLeast) {}

  [[nodiscard]] bool goes_on() const { return times_ < least_ || spent_ < kSeconds; }
  void begin_again() noexcept { ++times_; }

  /// `turn` says how many steps it took.
  template <class Turn>
  void add(const Turn& turn) {
    const double begin = protocol::monotonic_now();
    begin_ledger();
    const double steps = turn();
    device_.queue().finish();
    const double end = protocol::monotonic_now();
    spent_ += end - begin;
    steps_ += steps;
    commands_ += static_cast<double>(noted_commands().all());
    for (const auto& [name, launches] : end_ledger()) {
      const double seconds = launches.seconds / steps;
      const auto [at, is_new] = found_.kernels.emplace(name, seconds);
      if (!is_new) at->second = std::min(at->second, seconds);
    }
  }
  [[nodiscard]] Measured found() const {
    Measured found = found_;
    found.step = spent_ / steps_;
    found.commands = commands_ / steps_;
    return found;
  }

 private:
  Device& device_;
  int least_;
  Measured found_;
  double spent_ = 0.0;  ///< [s]
  double steps_ = 0.0;
  double commands_ = 0.0;
  int times_ = 0;
};

/// What is held against what.
struct Asked {
  const char* what = "";
  int particles = 0;
  std::map<std::string, Work> work;   ///< of a step
  std::map<std::string, Work> there;  ///< of one with the kernels that GPUs get
  double copied = 0.0;                ///< of a step [B]
};

/// With what the host takes for so many commands besides [ms].
double with_commands(double kernels, double commands, const Asked& asked, const Limits& limits) {
  return 1e3 * (kernels + commands * limits.launch + asked.copied / limits.bandwidth);
}

void foretell(const Asked& asked, double commands, const Limits& there) {
  std::printf("  there                launches      MB  M operations        ms\n");
  double sum = 0.0;
  for (const auto& [name, work] : asked.there) {
    const double least = expected(work, there);
    commands += work.launches;
    sum += least;
    std::printf("  %-20s %8.2f %7.2f  %12.2f  %8.4f\n", name.c_str(), work.launches,
                1e-6 * work.bytes, 1e-6 * work.operations, 1e3 * least);
  }
  std::printf("  a step with its %.1f commands is expected to take %.3f ms there\n", commands,
              with_commands(sum, commands, asked, there));
}

void add(Table& table, const Asked& asked, const Measured& found, const Limits& here,
         const Limits& there) {
  std::printf("\n%s, %d particles, bytes at %.1f GB/s\n", asked.what, asked.particles,
              1e-9 * here.bandwidth);
  double sum = 0.0, commands = found.commands;
  for (const auto& [name, seconds] : found.kernels) {
    if (!asked.work.contains(name)) {
      std::printf("%s ran, but not in the frame that was looked at\n", name.c_str());
      continue;
    }
    const Work& work = asked.work.at(name);
    const double least = expected(work, here);
    commands += work.launches;
    sum += least;
    table.add({asked.what, std::to_string(asked.particles), name, number(work.launches),
               number(1e-6 * work.bytes), number(1e-6 * work.operations), number(1e-6 * work.runs),
               number(1e3 * seconds), number(1e3 * least), number(least / seconds, 2)});
  }
  const double least = with_commands(sum, commands, asked, here);
  table.add({asked.what, std::to_string(asked.particles), "the step", number(commands), "", "", "",
             number(1e3 * found.step), number(least), number(1e-3 * least / found.step, 2)});
  if (there.bandwidth > 0.0) foretell(asked, found.commands, there);
}

struct Place {
  Device& device;
  Limits here;
  Limits there;
  Table& table;
};

void of_cube(Place& at, int count) {
  Measure measure(at.device, count);
  Asked asked = {"cube", 0, {}, {}};
  for (; measure.goes_on(); measure.begin_again()) {
    const std::size_t others = buffer_bytes();
    Block block(at.device, count);
    if (asked.work.empty()) {
      at.here.bandwidth = bandwidth_of(at.device, buffer_bytes() - others);
    }
    for (int k = 0; k < (count > kMuch ? kFrames : kSteps); ++k) {
      measure.add([&] {
        block.move();
        return 1.0;
      });
    }
    if (!asked.work.empty()) continue;
    asked.particles = block.params.count;
    const Places places = places_of(block);
    asked.work = work_of(places, at.device.profile());
    asked.there = work_of(places, gpu_profile());
  }
  add(at.table, asked, measure.found(), at.here, at.there);
}

void of_pool(Place& at, int count) {
  Scene scene = read_scene(tests::scene_file("pool"));
  // fluid_work.hpp has the state equation's kernels only.
  scene.fluid.solver = PressureKind::weakly_compressible;
  // Settling a large pool takes hours: its particles lie on their lattice when time begins.
  if (count > 0) {
    scene.fluid.particles = count;
    scene.fluid.settle = SettleKind::never;
  }
  const std::size_t others = buffer_bytes();
  Simulation pool(at.device, scene, {});
  at.here.bandwidth = bandwidth_of(at.device, buffer_bytes() - others);
  const double begins = count > 1'000'000 ? 0.0 : kPoolMoves;
  while (pool.seconds() < begins) static_cast<void>(pool.advance());
  const Snapshot water = pool.fluid().snapshot();
  const double then = pool.seconds();
  Measure measure(at.device, count);
  for (; measure.goes_on(); measure.begin_again()) {
    pool.resume(water, then);
    for (int k = 0; k < (count > kMuch ? 1 : kFrames); ++k) {
      measure.add([&] {
        const std::int64_t before = pool.totals().steps;
        static_cast<void>(pool.advance());
        return static_cast<double>(pool.totals().steps - before);
      });
    }
  }
  pool.resume(water, then);
  static_cast<void>(pool.advance());
  const FrameSeen seen = see_frame(pool);
  Asked asked = {"pool", pool.particles(), {}, {}};
  for (const auto& [name, work] : frame_work(seen, at.device.profile())) {
    asked.work[name] = work.times(1.0 / seen.steps);
  }
  for (const auto& [name, work] : frame_work(seen, gpu_profile())) {
    asked.there[name] = work.times(1.0 / seen.steps);
  }
  asked.copied = copied_bytes(seen) / seen.steps;
  std::printf(
      "\nThe pool: %d steps a frame, %.0f bubbles, %.0f fast particles, %.0f points of skin",
      seen.steps, seen.bubbles, seen.fast, seen.skin);
  add(at.table, asked, measure.found(), at.here, at.there);
}

/// Of sizes that grow, up to what time allows.
void each(Place at, void (*run)(Place&, int), std::initializer_list<int> sizes, int most_particles,
          const Until& until) {
  double last = 0.0;
  for (const int count : sizes) {
    if (count > most_particles || !until.allows(16.0 * last)) break;
    const double begin = protocol::monotonic_now();
    run(at, count);
    last = protocol::monotonic_now() - begin;
  }
}

}  // namespace

void against_limits(Bench& bench, Device& device, bool cube, bool pool, int most_particles,
                    const Until& until, const Limits& there) {
  const Limits here = limits_of(device);
  bench.say(program::format(
      "What a step of the state equation asks of the device. It streams %.1f GB/s from memory "
      "(triad), computes %.1f G operations/s, goes through %.3f G runs/s; a launch takes %.1f us "
      "of the host. The rule is that at the head of tests/bench/fluid_limits.cpp:",
      1e-9 * here.bandwidth, 1e-9 * here.arithmetic, 1e-9 * here.runs, 1e6 * here.launch));
  auto table = bench.table(
      "limits.csv", {"water", "particles", "kernel", "launches", "MB", "M operations", "M runs",
                     "measured [ms]", "expected [ms]", "expected / measured"});
  const Place at = {device, here, with_runs(there), table};
  if (pool) each(at, of_pool, {0, 250'000, 4'000'000}, most_particles, until);
  if (cube) each(at, of_cube, {15'625, 250'000, 1'000'000, 4'000'000}, most_particles, until);
  bench.tell(table);
}

}  // namespace splash::bench
