// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "protocol/time_tag.hpp"
#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/bench/fluid_cost.hpp"
#include "tests/bench/opencl_ledger.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

/// `wide`: a type of many floats, since a CPU's compiler need not find them by itself. Numbers that
/// do not wait for each other.
const char* const kProbes = R"(
#if LANES == 1
typedef float wide;
#define LAST(a) (a)
#else
typedef float16 wide;
#define LAST(a) ((a).s0 + (a).sf)
#endif
kernel void triad(global const wide* a, global const wide* b, global wide* c, float s, int n) {
  const int i = get_global_id(0);
  if (i < n) c[i] = a[i] + s * b[i];
}
// Sums, products and fused ones in equal parts, as in the formula of a pair.
#define NEXT(x) x = (x + g) * f, x = x * f + g
kernel void compute(global float* out, float s, int rounds) {
  const wide f = s, g = 1e-5f;
  wide a = s, b = a + 1, c = a + 2, d = a + 3, e = a + 4, h = a + 5, i = a + 6, j = a + 7;
  wide k = a + 8, l = a + 9, m = a + 10, n = a + 11;
  for (int round = 0; round < rounds; ++round) {
    NEXT(a), NEXT(b), NEXT(c), NEXT(d), NEXT(e), NEXT(h);
    NEXT(i), NEXT(j), NEXT(k), NEXT(l), NEXT(m), NEXT(n);
  }
  a += b + c + d + e + h + i + j + k + l + m + n;
  out[get_global_id(0)] = LAST(a);
}
// As near.h goes through the runs around a group: where each begins and ends is looked up, and its
// length, of one to three vectors, is not foreseen.
kernel void visit(global const int* start, global const wide* points, global float* out,
                  int runs, int begin) {
  const int item = get_global_id(0);
  wide sum = 0.0f;
  uint at = begin + 977u * item;
  for (int k = 0; k < runs; ++k) {
    at = 1664525u * at + 1013904223u;
    const int run = at >> 24;
    const int last = start[run + 1];
    for (int i = start[run]; i < last; ++i) sum += points[i];
  }
  out[item] = LAST(sum);
}
kernel void nothing(int n) { (void)n; }
)";

/// Fastest of a thousand runs, or of those of a second, without what the host takes [s].
double fastest(Device& device, const std::function<void()>& launch) {
  double best = 1.0e9;
  const double end = protocol::monotonic_now() + 1.0;
  for (int k = 0; k < 1000 && (k < 3 || protocol::monotonic_now() < end); ++k) {
    begin_ledger();
    launch();
    device.queue().finish();
    double here = 0.0;
    for (const auto& [name, launches] : end_ledger()) here += launches.seconds;
    best = std::min(best, here);
  }
  return best;
}

cl::Program probes(Device& device) {
  return build_program(device, {{"tests/bench/probes", kProbes}}, {});
}

std::size_t width(const Device& device) {
  return device.lanes() == 1 ? 1 : 16;
}

/// Busy work-items: some for each core of a CPU, since one may join in late, many for each of a
/// GPU's units.
std::size_t busy_items(const Device& device) {
  return device.facts().compute_units * std::size_t{device.lanes() == 1 ? 4096U : 16U};
}

double arithmetic(Device& device, const cl::Program& program) {
  constexpr int kRounds = 2048;
  // Of a round in each lane: of twelve numbers, three instructions that count as two.
  constexpr double kOfRound = 12.0 * 3.0 * 2.0;
  const std::size_t items = 4 * busy_items(device);
  Kernel compute(program, "compute", device.profile().group);
  Buffer<float> out(device, items);
  const double seconds = fastest(device, [&] {
    compute.run(device.queue(), items, {{"out", out}, {"s", 0.999F}, {"rounds", kRounds}});
  });
  return kOfRound * static_cast<double>(items * width(device)) * kRounds / seconds;
}

/// A number that looks drawn by lot.
int mixed(std::size_t k) {
  return static_cast<int>(static_cast<std::uint32_t>(k) * 2654435761U >> 9U);
}

double runs(Device& device, const cl::Program& program) {
  constexpr int kRuns = 256, kVisits = 4096;
  std::vector<int> start(kRuns + 1, 0);
  for (std::size_t k = 1; k < start.size(); ++k) {
    start[k] = start[k - 1] + 1 + mixed(k) % 3;
  }
  const std::size_t items = busy_items(device);
  const int rounds = device.lanes() == 1 ? kVisits / 64 : kVisits;
  Buffer<int> starts(device, std::span<const int>(start));
  Buffer<std::byte> points(device, std::size_t{4 * kRuns} * width(device) * sizeof(float));
  Buffer<float> out(device, items);
  Kernel visit(program, "visit", device.profile().lanes == 1 ? device.profile().group : 1);
  cl_uint begin = 0;  // other runs each time: what predicts branches remembers thousands
  const double seconds = fastest(device, [&] {
    begin = begin * 1664525U + 12345U;
    visit.run(device.queue(), items,
              {{"start", starts},
               {"points", points},
               {"out", out},
               {"runs", rounds},
               {"begin", std::bit_cast<int>(begin)}});
  });
  return static_cast<double>(items) * rounds / seconds;
}

}  // namespace

double bandwidth_of(Device& device, std::size_t bytes) {
  const std::size_t most = std::min(device.facts().allocation / 2, device.facts().memory / 8);
  const std::size_t count = std::min(bytes / 3, most) / (sizeof(float) * width(device));
  Kernel triad(probes(device), "triad");
  using Array = Buffer<std::byte>;  // of a type of the kernel's own
  const std::size_t size = count * width(device) * sizeof(float);
  const Array arrays[] = {Array(device, size), Array(device, size), Array(device, size)};
  // Each is written in turn: in a step, too, a core reads what another one may have written.
  const double seconds = fastest(device, [&] {
    for (int k = 0; k < 3; ++k) {
      triad.run(device.queue(), count,
                {{"a", arrays[k]},
                 {"b", arrays[(k + 1) % 3]},
                 {"c", arrays[(k + 2) % 3]},
                 {"s", 0.5F},
                 {"n", static_cast<int>(count)}});
    }
  });
  return 9.0 * static_cast<double>(size) / seconds;
}

std::pair<double, double> empty_launch(Device& device) {
  Kernel nothing(probes(device), "nothing");
  constexpr int kLaunches = 2000, kRuns = 5;
  const auto run = [&] {
    for (int k = 0; k < kLaunches; ++k) nothing.run(device.queue(), 64, {{"n", k}});
    device.queue().finish();
  };
  run();
  const double before = processor_time();
  const double wall = wall_time(run, kRuns);
  return {wall / kLaunches, (processor_time() - before) / (kRuns * kLaunches)};
}

Limits limits_of(Device& device) {
  const cl::Program program = probes(device);
  return {.bandwidth = bandwidth_of(device, std::size_t{384} << 20U),  // beyond caches
          .arithmetic = arithmetic(device, program),
          .runs = runs(device, program),
          .launch = empty_launch(device).first};
}

}  // namespace splash::bench
