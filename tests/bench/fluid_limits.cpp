// SPDX-License-Identifier: MIT
// What a step asks of the device, kernel by kernel, beside what the device can do at most: bytes as
// if every array that a kernel touches went through memory once, operations of its formula counted
// from where the particles are. A kernel takes no less than the larger of both and its launches.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "protocol/time_tag.hpp"
#include "sim-server/device/buffer.hpp"
#include "sim-server/device/program.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/bench/fluid_cost.hpp"
#include "tests/bench/fluid_work.hpp"
#include "tests/bench/opencl_ledger.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

/// `wide`: a type of many floats, since a CPU's compiler need not find them by itself. Eight sums
/// that do not wait for each other.
const char* const kProbes = R"(
#if LANES == 1
typedef float wide;
#define WIDTH 1
#else
typedef float16 wide;
#define WIDTH 16
#endif
kernel void triad(global const wide* a, global const wide* b, global wide* c, float s, int n) {
  const int i = get_global_id(0);
  if (i < n) c[i] = a[i] + s * b[i];
}
kernel void multiply_add(global float* out, float s, int rounds) {
  const wide f = s, g = 1e-5f;
  wide a = s, b = a + 1, c = a + 2, d = a + 3, e = a + 4, h = a + 5, i = a + 6, j = a + 7;
  for (int round = 0; round < rounds; ++round) {
    a = a * f + g;
    b = b * f + g;
    c = c * f + g;
    d = d * f + g;
    e = e * f + g;
    h = h * f + g;
    i = i * f + g;
    j = j * f + g;
  }
  a += b + c + d + e + h + i + j;
#if LANES == 1
  out[get_global_id(0)] = a;
#else
  out[get_global_id(0)] = a.s0 + a.sf;
#endif
}
kernel void nothing(int n) { (void)n; }
)";

/// Fastest of some runs, without the launch [s].
double fastest(Device& device, const std::function<void()>& launch) {
  double best = 1.0e9;
  for (int k = 0; k < 12; ++k) {
    begin_ledger();
    launch();
    device.queue().finish();
    double here = 0.0;
    for (const auto& [name, launches] : end_ledger()) here += launches.seconds;
    best = std::min(best, here);
  }
  return best;
}

/// Of this device, by kernels that do nothing else.
Limits limits_of(Device& device) {
  const KernelSource source = {"tests/bench/probes", kProbes};
  const cl::Program program = build_program(device, {source}, {}, false);
  const std::size_t width = device.lanes() == 1 ? 1 : 16;
  Limits limits;
  // Three arrays of 128 MiB, or what the device has room for: beyond its caches.
  const std::size_t bytes = std::min<std::size_t>(
      {std::size_t{128} << 20U, device.facts().allocation / 2, device.facts().memory / 8});
  const std::size_t count = bytes / (sizeof(float) * width);
  {
    Buffer<float> a(device, count * width), b(device, count * width), c(device, count * width);
    Kernel triad(program, "triad");
    const double seconds = fastest(device, [&] {
      triad.run(device.queue(), count, a.memory(), b.memory(), c.memory(), 0.5F,
                static_cast<int>(count));
    });
    limits.bandwidth = 3.0 * static_cast<double>(count * width * sizeof(float)) / seconds;
  }
  Kernel multiply_add(program, "multiply_add", device.profile().group);
  const std::size_t items = std::size_t{width == 1 ? 4096U : 64U} * device.facts().compute_units;
  const int rounds = width == 1 ? 4096 : 65536;
  Buffer<float> out(device, items);
  const double seconds = fastest(
      device, [&] { multiply_add.run(device.queue(), items, out.memory(), 0.999F, rounds); });
  limits.arithmetic = 2.0 * 8.0 * static_cast<double>(items * width) * rounds / seconds;
  Kernel nothing(program, "nothing");
  constexpr int kLaunches = 1000;
  const auto empty = [&] {
    for (int k = 0; k < kLaunches; ++k) nothing.run(device.queue(), 64, k);
    device.queue().finish();
  };
  empty();
  limits.launch = wall_time(empty, 5) / kLaunches;
  return limits;
}

double least(const Work& work, const Limits& limits, double launches) {
  return launches * limits.launch +
         std::max(work.bytes / limits.bandwidth, work.operations / limits.arithmetic);
}

/// Kernels of a step: calls, and seconds for each step.
struct Measured {
  std::map<std::string, Launches> kernels;
  double step = 0.0;  ///< [s]
};

constexpr int kSteps = 20;

Measured measure(Device& device, Block& block) {
  Measured found;
  begin_ledger();
  const double begin = protocol::monotonic_now();
  for (int k = 0; k < kSteps; ++k) block.move();
  device.queue().finish();
  found.step = (protocol::monotonic_now() - begin) / kSteps;
  found.kernels = end_ledger();
  return found;
}

void print(int particles, const Measured& found, const std::map<std::string, Work>& work,
           const Limits& here, const Limits& there, std::FILE* csv) {
  std::printf(
      "\n%d particles      launches     MB  M operations       ms  at least    GB/s  of all"
      "   G/s  of all%s\n",
      particles, there.bandwidth > 0.0 ? "    there" : "");
  double floor = 0.0, elsewhere = 0.0;
  for (const auto& [name, launches] : found.kernels) {
    const double seconds = launches.seconds / kSteps;
    const double count = static_cast<double>(launches.count) / kSteps;
    const Work asked = work.at(name);
    const double lowest = least(asked, here, count);
    floor += lowest;
    std::printf("  %-22s %6.2f  %7.2f  %12.2f  %7.3f  %8.3f  %6.1f  %3.0f %%  %6.1f  %3.0f %%",
                name.c_str(), count, 1e-6 * asked.bytes, 1e-6 * asked.operations, 1e3 * seconds,
                1e3 * lowest, 1e-9 * asked.bytes / seconds,
                100.0 * asked.bytes / seconds / here.bandwidth, 1e-9 * asked.operations / seconds,
                100.0 * asked.operations / seconds / here.arithmetic);
    if (there.bandwidth > 0.0) {
      elsewhere += least(asked, there, count);
      std::printf("  %7.3f", 1e3 * least(asked, there, count));
    }
    std::printf("\n");
    if (csv != nullptr) {
      std::fprintf(csv, "limit:%s,%d,%g,%g,%g,%g\n", name.c_str(), particles, 1e3 * seconds,
                   1e3 * lowest, asked.bytes, asked.operations);
    }
  }
  std::printf("  the step takes %.3f ms, at least %.3f ms", 1e3 * found.step, 1e3 * floor);
  if (there.bandwidth > 0.0) std::printf(", there at least %.3f ms", 1e3 * elsewhere);
  std::printf("\n");
}

}  // namespace

void against_limits(Device& device, int most_particles, const Until& until, const Limits& there,
                    std::FILE* csv) {
  const Limits here = limits_of(device);
  std::printf(
      "\nThe device copies %.1f GB/s (triad), computes %.1f G operations/s (fused), and "
      "begins a launch in %.1f us\n",
      1e-9 * here.bandwidth, 1e-9 * here.arithmetic, 1e6 * here.launch);
  if (csv != nullptr) {
    std::fprintf(csv, "limits,,%g,%g,%g\n", here.bandwidth, here.arithmetic, here.launch);
  }
  double last = 0.0;
  for (const int count : {15'625, 250'000, 1'000'000, 4'000'000}) {
    if (count > most_particles || !until.allows(16.0 * last)) break;
    const double begin = protocol::monotonic_now();
    Block block(device, count);
    const Measured found = measure(device, block);
    const Places places = places_of(device, block);
    print(places.params.count, found, work_of(places, device.profile()), here, there, csv);
    std::fflush(stdout);
    last = protocol::monotonic_now() - begin;
  }
}

}  // namespace splash::bench
