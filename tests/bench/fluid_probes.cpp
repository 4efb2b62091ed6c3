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
#include "sim-server/fluid/params/parts.hpp"
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
// Scalar instructions that do not wait for each other: shifts, which no vector saves.
kernel void shift(global int* out, int rounds) {
  uint a = get_global_id(0), b = a + 1, c = a + 2, d = a + 3, e = a + 4, f = a + 5;
  for (int round = 0; round < rounds; ++round) {
    a += b >> 1, b ^= c << 3, c += d >> 5, d ^= e << 7, e += f >> 9, f ^= a << 11;
  }
  out[get_global_id(0)] = a + b + c + d + e + f;
}
// As a counting sort does: each work-item has histograms of its own.
kernel void count_up(global const int* cells, global int* count, int points, int size) {
  const int item = get_global_id(0);
  for (int i = item * points; i < (item + 1) * points; ++i) ++count[item * size + cells[i]];
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

constexpr int kRounds = 2048;
/// Of a round in each lane: of twelve numbers, three instructions that count as two.
constexpr double kOfRound = 12.0 * 3.0 * 2.0;

/// Of a launch of kRounds [s].
double computing(Device& device, const cl::Program& program, std::size_t items) {
  Kernel compute(program, "compute", device.profile().group);
  Buffer<float> out(device, items);
  return fastest(device, [&] {
    compute.run(device.queue(), items, {{"out", out}, {"s", 0.999F}, {"rounds", kRounds}});
  });
}

/// A number that looks drawn by lot.
int mixed(std::size_t k) {
  return static_cast<int>(static_cast<std::uint32_t>(k) * 2654435761U >> 9U);
}

double scalar(Device& device, const cl::Program& program) {
  constexpr int kShifts = 8192;
  const std::size_t items = std::size_t{16} * device.facts().compute_units;
  Buffer<int> out(device, items);
  Kernel shift(program, "shift", 1);
  const double seconds = fastest(device, [&] {
    shift.run(device.queue(), items, {{"out", out}, {"rounds", kShifts}});
  });
  return 12.0 * static_cast<double>(items) * kShifts / seconds;
}

double counts(Device& device, const cl::Program& program) {
  constexpr int kPoints = 8192, kCells = 4096;
  const std::size_t items = std::size_t{16} * device.facts().compute_units;
  std::vector<int> cells(items * kPoints);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = mixed(i) % kCells;
  Buffer<int> of(device, std::span<const int>(cells)), count(device, items * kCells);
  Kernel count_up(program, "count_up", 1);
  const double seconds = fastest(device, [&] {
    count_up.run(device.queue(), items,
                 {{"cells", of}, {"count", count}, {"points", kPoints}, {"size", kCells}});
  });
  return static_cast<double>(cells.size()) / seconds;
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

/// Of vectors of particles near a body, none of which it stops (boundary/keep_out.h).
const char* const kHold = R"(
kernel void hold_out(constant FluidParams* p, constant BodyShape* shapes, global const float* none,
                     global const BodyStep* bodies, int rounds, global const float* in,
                     global float* out) {
  const Bodies near = {shapes, none, bodies, 0, 1};
  lanes x[3] = {LOAD(in, 0), LOAD(in, 0), LOAD(in, 0)}, v[3] = {0.0f, 0.0f, 0.0f};
  for (int round = 0; round < rounds; ++round) {
    const lanes from[3] = {x[0], x[1], x[2]};
    x[0] += 1e-7f;
    keep_lanes_out(p, &near, from, x, v);
  }
  STORE(x[0] + x[1] + x[2] + v[0] + v[1] + v[2], out, 0);
}
)";

/// By one work-item: particles near a body follow each other, and a core gets many at once.
double held(Device& device) {
  if (device.lanes() == 1) return 0.0;
  constexpr int kTimes = 1024;
  std::vector<KernelSource> sources = kernels::fluid();
  sources.push_back({"tests/bench/hold_out", kHold});
  Kernel hold_out(build_program(device, sources, kernel_defines({})), "hold_out", 1);
  FluidParams p = {};
  p.spacing = 0.03F;
  BodyShape box = {};
  box.half_x = box.half_y = box.half_z = 0.1F;
  box.rocker = 0.01F;
  BodyStep step = {};
  step.qw = 1.0F;
  step.lower_x = step.lower_y = step.lower_z = -1.0F;
  step.upper_x = step.upper_y = step.upper_z = 1.0F;
  const Buffer<FluidParams> params(device, std::span<const FluidParams>(&p, 1));
  const Buffer<BodyShape> shapes(device, std::span<const BodyShape>(&box, 1));
  const Buffer<BodyStep> steps(device, std::span<const BodyStep>(&step, 1));
  const Buffer<float> none(device, 1);
  const auto lanes = static_cast<std::size_t>(device.lanes());
  const Buffer<float> in(device, std::vector<float>(lanes, 0.15F)), out(device, lanes);
  const double seconds = fastest(device, [&] {
    hold_out.run(device.queue(), 1,
                 {{"p", params},
                  {"shapes", shapes},
                  {"none", none},
                  {"bodies", steps},
                  {"rounds", kTimes},
                  {"in", in},
                  {"out", out}});
  });
  return static_cast<double>(lanes) * kTimes / seconds;
}

/// Of a launch of so many work-groups that do nothing [s].
double idle(Device& device, const cl::Program& program, std::size_t groups) {
  const std::size_t group = device.profile().group;
  Kernel nothing(program, "nothing", group);
  return fastest(device, [&] { nothing.run(device.queue(), groups * group, {{"n", 0}}); });
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

Limits limits_of(Device& device) {
  const cl::Program program = probes(device);
  Limits limits;
  // Three arrays of 128 MiB: beyond caches.
  limits.bandwidth = bandwidth_of(device, std::size_t{384} << 20U);
  const std::size_t items = 4 * busy_items(device);
  const double computes = computing(device, program, items);
  limits.arithmetic = kOfRound * static_cast<double>(items * width(device)) * kRounds / computes;
  limits.scalar = scalar(device, program);
  limits.counts = counts(device, program);
  limits.runs = runs(device, program);
  limits.held = held(device);
  constexpr std::size_t kFew = 16, kMany = 4096;
  limits.begin = idle(device, program, kFew);
  const double more = idle(device, program, kMany) - limits.begin;
  limits.groups = more > 0.0 ? static_cast<double>(kMany - kFew) / more : 0.0;
  Kernel nothing(program, "nothing");
  constexpr int kLaunches = 1000;
  const auto empty = [&] {
    for (int k = 0; k < kLaunches; ++k) nothing.run(device.queue(), 64, {{"n", k}});
    device.queue().finish();
  };
  empty();
  limits.launch = wall_time(empty, 5) / kLaunches;
  return limits;
}

}  // namespace splash::bench
