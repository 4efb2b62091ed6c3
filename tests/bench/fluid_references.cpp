// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "sim-server/fluid/params/parts.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/bench/fluid_cost.hpp"
#include "tests/bench/fluid_yardstick.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

std::size_t cells_of(const FluidParams& p) {
  return static_cast<std::size_t>(p.cells_x) * static_cast<std::size_t>(p.cells_y) *
         static_cast<std::size_t>(p.cells_z);
}

Particles copy_of(Device& device, Block& block) {
  Particles p;
  const auto stride = static_cast<std::size_t>(block.fluid.particles().stride);
  p.params = block.params;
  p.stride = static_cast<int>(stride);
  p.position = block.fluid.particles().position.read(device, 3 * stride);
  p.velocity = block.fluid.particles().velocity.read(device, 3 * stride);
  p.pressure = block.fluid.pressure_term().read(device, stride);
  for (auto* part : {&p.position, &p.velocity, &p.pressure}) part->resize(part->size() + 32);
  p.cell_start =
      block.fluid.grid().cell_start().read(device, SPLASH_SLICES * cells_of(p.params) + 1);
  return p;
}

/// Of a kernel on the device, from its own clock [s].
double kernel_time(Device& device, cl::Kernel& kernel, std::size_t items) {
  cl::Event event;
  device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items),
                                      cl::NDRange(device.profile().group), nullptr, &event);
  event.wait();
  return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                    event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}

/// Largest difference, over the largest value.
double farthest(const std::vector<float>& a, const std::vector<float>& b, std::size_t stride,
                std::size_t count) {
  double most = 0.0;
  double size = 0.0;
  for (std::size_t first = 0; first + count <= std::min(a.size(), b.size()); first += stride) {
    for (std::size_t i = first; i < first + count; ++i) {
      most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
      size = std::max(size, std::abs(static_cast<double>(b[i])));
    }
  }
  return most / size;
}

/// The product's kernels with arguments of our own, to be timed one by one.
struct MainKernels {
  MainKernels(Device& device, Block& block)
      : program(build_program(device, kernels::fluid(), {})),
        density(program, "compute_density"),
        acceleration(program, "compute_acceleration"),
        activity(device, std::vector<int>(cells_of(block.params), 2)),
        resting(device, static_cast<std::size_t>(block.params.count)),
        none(device, 1),
        nobody(device, 1) {
    Fluid& f = block.fluid;
    const auto points = static_cast<std::size_t>(f.particles().stride) + kReadAhead;
    rho = Buffer<float>(device, points);
    water = Buffer<float>(device, points);
    peak = Buffer<float>(device, points);
    term = Buffer<float>(device, points);
    push = Buffer<float>(device, 3 * points);
    moving = Buffer<int>(device, points);
    // Without bodies, for a step of no length, everywhere, without a piston.
    set(density, f.params_buffer().memory(), f.grid().cell_start().memory(), activity.memory(),
        f.grid().source().memory(), rho.memory(), water.memory(), peak.memory(),
        f.particles().position.memory(), f.boundary().grid().cell_start().memory(),
        f.boundary().points().position.memory(), none.memory(), 0, f.boundary().shapes().memory(),
        f.boundary().meshes().memory(), nobody.memory(), 0, 0, 0.0F, 1, 0.0F,
        f.body_images().memory(), rho.memory(), water.memory(), peak.memory(), term.memory(),
        push.memory(), moving.memory(), resting.memory());
    set(acceleration, f.params_buffer().memory(), f.grid().cell_start().memory(), activity.memory(),
        resting.memory(), f.particles().position.memory(), f.particles().velocity.memory(),
        f.pressure_term().memory(), f.body_images().memory(),
        f.boundary().grid().cell_start().memory(), f.boundary().points().position.memory(),
        f.boundary().points().velocity.memory(), none.memory(), 0, nobody.memory(), 0, 0, 0.0F,
        push.memory(), moving.memory());
  }

  template <class... Args>
  static void set(cl::Kernel& kernel, const Args&... args) {
    cl_uint index = 0;
    (kernel.setArg(index++, args), ...);
  }

  cl::Program program;
  cl::Kernel density;
  cl::Kernel acceleration;
  Buffer<int> activity;  ///< of each cell, what goes on in it (sleep/sleep.h)
  Buffer<int> resting;
  Buffer<float> none;
  Buffer<BodyStep> nobody;
  Buffer<float> rho, water, peak, term, push;
  Buffer<int> moving;
};

}  // namespace

void beside_the_yardstick(Bench& bench, sim::Device& device, int most_particles) {
  const int threads = static_cast<int>(
      std::min<std::size_t>(device.facts().compute_units, std::thread::hardware_concurrency()));
  bench.say(
      "The two main kernels of the state equation beside C++ by hand (explicit vectors, OpenMP), " +
      std::to_string(threads) + " threads; interleaved, the fastest tenth:");
  auto table =
      bench.table("kernels.csv", {"particles", "density [ms]", "by hand [ms]", "forces [ms]",
                                  "by hand [ms]", "by hand / ours", "difference, of the largest"});
  for (const int count : {2'000, 7'000, 15'625, 60'000, 250'000, 1'000'000}) {
    if (count > most_particles) break;
    Block block(device, count);
    block.fluid.prepare(block.step);
    device.queue().finish();
    MainKernels kernels(device, block);
    const Particles p = copy_of(device, block);
    const auto stride = static_cast<std::size_t>(p.stride);
    const auto particles = static_cast<std::size_t>(p.params.count);
    const auto lanes = static_cast<std::size_t>(device.lanes());
    const std::size_t group = device.profile().group;
    const std::size_t items = ((particles + lanes - 1) / lanes + group - 1) / group * group;
    std::vector<float> density(stride);
    std::vector<float> push(3 * stride);
    std::vector<double> ours_d, ours_f, hand_d, hand_f;
    const int rounds = count > 100'000 ? 11 : 41;
    for (int round = 0; round < rounds; ++round) {
      ours_d.push_back(kernel_time(device, kernels.density, items));
      hand_d.push_back(wall_time([&] { density_by_hand(p, threads, density); }, 1));
      ours_f.push_back(kernel_time(device, kernels.acceleration, items));
      hand_f.push_back(wall_time([&] { acceleration_by_hand(p, threads, push); }, 1));
    }
    const double d = undisturbed(ours_d), hd = undisturbed(hand_d);
    const double f = undisturbed(ours_f), hf = undisturbed(hand_f);
    // Gravity is the kernel's alone.
    std::vector<float> theirs = kernels.push.read(device, 3 * stride);
    for (std::size_t i = 0; i < particles; ++i) theirs[2 * stride + i] -= p.params.gravity_z;
    const double off =
        std::max(farthest(density, kernels.rho.read(device, stride), stride, particles),
                 farthest(push, theirs, stride, particles));
    table.add({std::to_string(particles), number(1e3 * d), number(1e3 * hd), number(1e3 * f),
               number(1e3 * hf), number((hd + hf) / (d + f)), number(off, 1)});
    if (!(off < 1e-4)) throw std::runtime_error("the yardstick and the kernels disagree");
  }
  bench.tell(table);
}

}  // namespace splash::bench
