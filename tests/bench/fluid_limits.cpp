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
#include "tests/bench/opencl_ledger.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

struct Work {
  double bytes = 0.0;
  double operations = 0.0;
};

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

/// Where the particles are, as the kernels see them.
struct Places {
  FluidParams params = {};
  std::vector<float> position;  ///< x, y, z parts
  std::vector<int> cell_start;
  int used = 0;  ///< cells up to the last that has a particle
};

Places places_of(Device& device, Block& block) {
  block.fluid.prepare(block.step);
  const auto stride = static_cast<std::size_t>(block.fluid.particles().stride);
  Places p;
  p.params = block.params;
  p.position = block.fluid.particles().position.read(device, 3 * stride);
  p.cell_start.resize(SPLASH_SLICES * static_cast<std::size_t>(p.params.cells_x) *
                          static_cast<std::size_t>(p.params.cells_y) *
                          static_cast<std::size_t>(p.params.cells_z) +
                      1);
  device.queue().enqueueReadBuffer(block.fluid.grid().cell_start(), CL_TRUE, 0,
                                   4 * p.cell_start.size(), p.cell_start.data());
  const auto full = std::find(p.cell_start.begin(), p.cell_start.end(), p.params.count);
  p.used = static_cast<int>(full - p.cell_start.begin());
  return p;
}

/// What the search around all particles meets (kernels/near.h).
struct Met {
  double tested = 0.0;   ///< points held against a group's box, a vector at a time
  double visited = 0.0;  ///< pairs whose formula is computed
};

struct Box {
  float lower[3], upper[3];  ///< [m]
};

class Search {
 public:
  Search(const Places& places, int lanes) : p_(places), lanes_(lanes) {}

  Met all() {
    const int slices = SPLASH_SLICES * p_.params.cells_x;
    const int rows = p_.params.cells_y * p_.params.cells_z;
    for (int row = 0; row < rows; ++row) {
      const int end = start(row * slices + slices);
      for (int first = start(row * slices); first < end;) {
        // A turn of the work-item that has it: up to its last particle, or the row's.
        const int last = std::min((first / lanes_ + 1) * lanes_, end);
        meet(row, first, last);
        first = last;
      }
    }
    return met_;
  }

 private:
  [[nodiscard]] int start(int cell) const { return p_.cell_start[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] float at(int axis, int i) const {
    const std::size_t stride = p_.position.size() / 3;
    return p_.position[static_cast<std::size_t>(axis) * stride + static_cast<std::size_t>(i)];
  }
  [[nodiscard]] int slice(int i) const {
    const FluidParams& s = p_.params;
    const float cell =
        std::clamp((at(0, i) - s.origin_x) * s.inverse_cell, 1.0F, static_cast<float>(s.cells_x));
    return std::min(static_cast<int>(cell * SPLASH_SLICES), (s.cells_x - 1) * SPLASH_SLICES - 1);
  }
  [[nodiscard]] Box box(int first, int last) const {
    Box box{};
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = box.upper[axis] = at(axis, first);
      for (int i = first; i < last; ++i) {
        box.lower[axis] = std::min(box.lower[axis], at(axis, i));
        box.upper[axis] = std::max(box.upper[axis], at(axis, i));
      }
    }
    return box;
  }
  [[nodiscard]] bool is_near(const Box& box, int j) const {
    float apart2 = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float apart =
          std::max({box.lower[axis] - at(axis, j), at(axis, j) - box.upper[axis], 0.0F});
      apart2 += apart * apart;
    }
    return apart2 < p_.params.support * p_.params.support;
  }

  void meet(int row, int first, int last) {
    const int slices = SPLASH_SLICES * p_.params.cells_x;
    const int from = slice(first) - SPLASH_SLICES;
    const int to = slice(last - 1) + SPLASH_SLICES + 1;
    const Box around = box(first, last);
    for (int k = 0; k < 9; ++k) {
      const int base = (row + (k / 3 - 1) * p_.params.cells_y + k % 3 - 1) * slices;
      const int begin = start(base + from);
      const int end = start(base + to);
      if (lanes_ == 1) {
        met_.visited += end - begin;
        continue;
      }
      const int vectors = (end - begin + lanes_ - 1) / lanes_;
      met_.tested += vectors * lanes_;
      for (int j = begin; j < end; ++j) met_.visited += is_near(around, j) ? lanes_ : 0;
    }
  }

  const Places& p_;
  int lanes_;
  Met met_;
};

// Operations of the formulas, as the kernels write them (density.cl, acceleration.cl, near.h).
constexpr double kOfTest = 18.0, kOfDensity = 20.0, kOfForce = 46.0;

/// Of all kernels that a step of a cube runs, with either sort (cell_count.cl, cell_rank.cl).
std::map<std::string, Work> work_of(const Places& p, const Profile& profile) {
  const Met met = Search(p, profile.lanes).all();
  const double n = p.params.count;
  const auto all = static_cast<double>(p.cell_start.size());
  const double used = p.used;
  const double counts = used * std::max(profile.sort_chunks, 1);
  const double tests = kOfTest * met.tested;
  return {{"compute_density", {36.0 * n + 4.0 * used, tests + kOfDensity * met.visited}},
          {"compute_acceleration", {44.0 * n + 4.0 * used, tests + kOfForce * met.visited}},
          {"integrate", {64.0 * n, 40.0 * n}},
          {"count_cells", {16.0 * n + 12.0 * counts, 10.0 * n}},
          {"sum_blocks", {4.0 * counts, counts}},
          {"place_cells", {8.0 * counts + 4.0 * used, counts}},
          {"sort_points", {64.0 * n + 8.0 * counts, 0.0}},
          {"count_points", {28.0 * n, 10.0 * n}},
          {"sum_cells", {4.0 * all, all}},
          {"start_cells", {12.0 * all, all}},
          {"gather_cells", {16.0 * n, 0.0}},
          {"rank_points", {76.0 * n, 4.0 * n}}};
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
