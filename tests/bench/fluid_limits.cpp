// SPDX-License-Identifier: MIT
// What a step asks of the device, kernel by kernel, beside what the device can do: one rule for all
// kernels and devices, in which no number is fitted and none belongs to a kernel.
//   time = launches x begin + counts / their rate + runs / their rate
//          + max(bytes / bandwidth, operations / arithmetic + scalar instructions / their rate)
// What overlaps is within the brackets, the rest waits. A step has what the host takes for its
// launches besides. Each rate is that of a probe that does nothing else; bytes stream at the rate
// of arrays that together are as large as all of a step, each written in turn, since a kernel finds
// in the caches what others left there. Probes and kernels count by their fastest run: other
// programs only slow them.
#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/time_tag.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/bench/fluid_cost.hpp"
#include "tests/bench/fluid_work.hpp"
#include "tests/bench/opencl_ledger.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

/// Of what a device that is not at hand is not said to do, nothing is told but this: a run that is
/// looked up takes a sector of 32 bytes from memory. Its kernels have no scalar part and no counts.
Limits with_runs(Limits there) {
  there.runs = there.bandwidth / 32.0;
  return there;
}

double share(double work, double rate) {
  return work > 0.0 ? work / rate : 0.0;
}

double expected(const Work& work, const Limits& limits, double launches) {
  const double computing =
      share(work.operations, limits.arithmetic) + share(work.scalar, limits.scalar);
  return launches * limits.begin + std::max(share(work.bytes, limits.bandwidth), computing) +
         share(work.counts, limits.counts) + share(work.runs, limits.runs);
}

/// Kernels of a step: calls, and seconds for each step.
struct Measured {
  std::map<std::string, Launches> kernels;
  double step = 0.0;  ///< [s]
};

constexpr int kSteps = 50;

/// Each kernel's fastest step; the mean of all steps as a whole.
Measured measure(Device& device, Block& block) {
  Measured found;
  const double begin = protocol::monotonic_now();
  for (int k = 0; k < kSteps; ++k) {
    begin_ledger();
    block.move();
    device.queue().finish();
    for (const auto& [name, launches] : end_ledger()) {
      const auto [at, is_new] = found.kernels.emplace(name, launches);
      if (!is_new) at->second.seconds = std::min(at->second.seconds, launches.seconds);
    }
  }
  found.step = (protocol::monotonic_now() - begin) / kSteps;
  return found;
}

void print(int particles, const Measured& found, const std::map<std::string, Work>& work,
           const Limits& here, const Limits& there, std::FILE* csv) {
  const bool foretell = there.bandwidth > 0.0;
  std::printf(
      "\n%d particles, bytes at %.1f GB/s\n"
      "                          MB  M operations  M scalar  M counts  M runs        ms  expected"
      "  of it%s\n",
      particles, 1e-9 * here.bandwidth, foretell ? "     there" : "");
  double sum = 0.0, elsewhere = 0.0, launches = 0.0;
  for (const auto& [name, measured] : found.kernels) {
    const Work& asked = work.at(name);
    const auto count = static_cast<double>(measured.count);
    const double lowest = expected(asked, here, count);
    launches += count;
    sum += lowest;
    std::printf("  %-20s %7.2f  %12.2f  %8.2f  %8.2f  %6.2f  %8.3f  %8.3f  %5.2f", name.c_str(),
                1e-6 * asked.bytes, 1e-6 * asked.operations, 1e-6 * asked.scalar,
                1e-6 * asked.counts, 1e-6 * asked.runs, 1e3 * measured.seconds, 1e3 * lowest,
                lowest / measured.seconds);
    if (foretell) {
      elsewhere += expected(asked, there, count);
      std::printf("  %8.4f", 1e3 * expected(asked, there, count));
    }
    std::printf("\n");
    if (csv != nullptr) {
      std::fprintf(csv, "limit:%s,%d,%g,%g,%g,%g\n", name.c_str(), particles,
                   1e3 * measured.seconds, 1e3 * lowest, asked.bytes, asked.operations);
    }
  }
  std::printf("  the step takes %.3f ms, expected with its launches %.3f ms", 1e3 * found.step,
              1e3 * (sum + launches * here.launch));
  if (foretell) std::printf(", there %.3f ms", 1e3 * (elsewhere + launches * there.launch));
  std::printf("\n");
}

}  // namespace

void against_limits(Device& device, int most_particles, const Until& until, const Limits& there,
                    std::FILE* csv) {
  if (there.bandwidth > 0.0 && device.lanes() > 1) {
    throw std::runtime_error("--there foretells a GPU, with its kernels: add --profile gpu");
  }
  Limits here = limits_of(device);
  std::printf(
      "\nThe device streams %.1f GB/s from memory (triad), computes %.1f G operations/s (fused), "
      "%.1f G scalar\n"
      "instructions/s, %.2f G counts/s, %.2f G runs/s; a launch takes %.1f us of the host, %.1f us "
      "of the device\n",
      1e-9 * here.bandwidth, 1e-9 * here.arithmetic, 1e-9 * here.scalar, 1e-9 * here.counts,
      1e-9 * here.runs, 1e6 * here.launch, 1e6 * here.begin);
  if (csv != nullptr) {
    std::fprintf(csv, "limits,,%g,%g,%g\n", here.bandwidth, here.arithmetic, here.launch);
  }
  double last = 0.0;
  for (const int count : {15'625, 250'000, 1'000'000, 4'000'000}) {
    if (count > most_particles || !until.allows(16.0 * last)) break;
    const double begin = protocol::monotonic_now();
    const std::size_t others = buffer_bytes();
    Block block(device, count);
    here.bandwidth = bandwidth_of(device, buffer_bytes() - others);
    const Measured found = measure(device, block);
    const Places places = places_of(device, block);
    print(places.params.count, found, work_of(places, device.profile()), here, with_runs(there),
          csv);
    std::fflush(stdout);
    last = protocol::monotonic_now() - begin;
  }
}

}  // namespace splash::bench
