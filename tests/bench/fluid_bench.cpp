// SPDX-License-Identifier: MIT
// What a step costs on this machine: the two main kernels beside the same sums written by hand in
// C++ (in the same run, on the same particles), and the whole step from 2,000 to a million
// particles. Prints tables; with a folder's name, also leaves fluid.csv there.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "protocol/time_tag.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/kernel_sources.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "tests/bench/fluid_yardstick.hpp"

namespace {

using namespace splash;
using namespace splash::sim;
using splash::bench::Particles;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// A cube of about `count` particles at the spacing of the paper's pool.
Scene cube(int count) {
  Scene scene;
  scene.fluid.spacing = 0.0355;
  const double edge = std::round(std::cbrt(count)) * scene.fluid.spacing;
  scene.tank.lower = {0.0, 0.0, 0.0};
  scene.tank.upper = {edge, edge, 2.0 * edge};
  scene.water = {{{0.0, 0.0, 0.0}, {edge, edge, edge}}};
  return scene;
}

/// Some steps after the lattice, so that no order but that of the sort is left.
struct Block {
  Block(Device& device, int count)
      : scene(cube(count)),
        params(open(make_params(scene, initial_particles(scene)))),
        fluid(device, params, initial_particles(scene), {}, {}),
        step{.dt = largest_time_step(params, 1.0, 10.0, 1.0)} {
    fluid.set_bodies({});
    for (int k = 0; k < 20; ++k) move();
    device.queue().finish();
  }

  /// The sums alone: no walls.
  static FluidParams open(FluidParams params) {
    params.wall_count = 0;
    return params;
  }

  void move() {
    fluid.prepare(step);
    fluid.advance(step);
  }

  Scene scene;
  FluidParams params;
  Fluid fluid;
  Step step;
};

Particles copy_of(Device& device, Block& block) {
  Particles p;
  const auto stride = static_cast<std::size_t>(block.fluid.particles().stride);
  p.params = block.params;
  p.stride = static_cast<int>(stride);
  p.position = block.fluid.particles().position.read(device, 3 * stride);
  p.velocity = block.fluid.particles().velocity.read(device, 3 * stride);
  p.pressure = block.fluid.pressure_term().read(device, stride);
  for (auto* part : {&p.position, &p.velocity, &p.pressure}) part->resize(part->size() + 32);
  const std::size_t cells = SPLASH_SLICES * static_cast<std::size_t>(p.params.cells_x) *
                            static_cast<std::size_t>(p.params.cells_y) *
                            static_cast<std::size_t>(p.params.cells_z);
  p.cell_start.resize(cells + 1);
  device.queue().enqueueReadBuffer(block.fluid.grid().cell_start(), CL_TRUE, 0,
                                   4 * p.cell_start.size(), p.cell_start.data());
  return p;
}

/// Times of a kernel on the device, from its own clock [s].
double kernel_time(Device& device, cl::Kernel& kernel, std::size_t items, int runs) {
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) {
    cl::Event event;
    device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(4),
                                        nullptr, &event);
    event.wait();
    times.push_back(1e-9 *
                    static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                        event.getProfilingInfo<CL_PROFILING_COMMAND_START>()));
  }
  return median(times);
}

double wall_time(const std::function<void()>& work, int runs) {
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) {
    const double start = protocol::monotonic_now();
    work();
    times.push_back(protocol::monotonic_now() - start);
  }
  return median(times);
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
      : program(build_program(device, fluid_sources(), {}, false)),
        density(program, "compute_density"),
        acceleration(program, "compute_acceleration"),
        awake(device, std::vector<int>(cells(block.params), 1)),
        none(device, 1),
        nobody(device, 1) {
    Fluid& f = block.fluid;
    const auto points = static_cast<std::size_t>(f.particles().stride) + kReadAhead;
    rho = Buffer<float>(device, points);
    water = Buffer<float>(device, points);
    term = Buffer<float>(device, points);
    push = Buffer<float>(device, 3 * points);
    moving = Buffer<int>(device, points);
    set(density, f.params_buffer().memory(), f.grid().cell_start(), awake.memory(),
        f.grid().source(), rho.memory(), water.memory(), f.particles().position.memory(),
        f.body_grid().cell_start(), f.boundary().position.memory(), none.memory(), 0,
        nobody.memory(), 0, 0, 0.0F, rho.memory(), water.memory(), term.memory());
    set(acceleration, f.params_buffer().memory(), f.grid().cell_start(), awake.memory(),
        f.particles().position.memory(), f.particles().velocity.memory(),
        f.pressure_term().memory(), f.density().memory(), f.water_density().memory(),
        f.body_grid().cell_start(), f.boundary().position.memory(), f.boundary().velocity.memory(),
        none.memory(), 0, nobody.memory(), 0, 0, 0.0F, push.memory(), moving.memory());
  }

  static std::size_t cells(const FluidParams& p) {
    return static_cast<std::size_t>(p.cells_x) * static_cast<std::size_t>(p.cells_y) *
           static_cast<std::size_t>(p.cells_z);
  }

  template <class... Args>
  static void set(cl::Kernel& kernel, const Args&... args) {
    cl_uint index = 0;
    (kernel.setArg(index++, args), ...);
  }

  cl::Program program;
  cl::Kernel density;
  cl::Kernel acceleration;
  Buffer<int> awake;
  Buffer<float> none;
  Buffer<BodyStep> nobody;
  Buffer<float> rho, water, term, push;
  Buffer<int> moving;
};

void beside_the_yardstick(Device& device, std::FILE* csv) {
  const int threads = static_cast<int>(
      std::min<std::size_t>(device.facts().compute_units, std::thread::hardware_concurrency()));
  std::printf("\nThe two main kernels beside C++ by hand, %d threads; median of 41, interleaved\n",
              threads);
  std::printf(
      "particles   density  by hand  ratio    forces  by hand  ratio   both   difference\n");
  for (const int count : {7'000, 15'625, 60'000, 250'000}) {
    Block block(device, count);
    block.fluid.prepare(block.step);
    device.queue().finish();
    MainKernels kernels(device, block);
    const Particles p = copy_of(device, block);
    const auto stride = static_cast<std::size_t>(p.stride);
    const auto particles = static_cast<std::size_t>(p.params.count);
    const auto lanes = static_cast<std::size_t>(device.lanes());
    const std::size_t packet = lanes == 1 ? 4 : 4 * SPLASH_STRIPS;
    const std::size_t items = ((particles + lanes - 1) / lanes + packet - 1) / packet * packet;
    std::vector<float> density(stride);
    std::vector<float> push(3 * stride);
    std::vector<double> ours_d, ours_f, hand_d, hand_f;
    for (int round = 0; round < 41; ++round) {
      ours_d.push_back(kernel_time(device, kernels.density, items, 1));
      hand_d.push_back(wall_time([&] { bench::density_by_hand(p, threads, density); }, 1));
      ours_f.push_back(kernel_time(device, kernels.acceleration, items, 1));
      hand_f.push_back(wall_time([&] { bench::acceleration_by_hand(p, threads, push); }, 1));
    }
    const double d = median(ours_d), hd = median(hand_d), f = median(ours_f), hf = median(hand_f);
    // Gravity is the kernel's alone.
    std::vector<float> theirs = kernels.push.read(device, 3 * stride);
    for (std::size_t i = 0; i < particles; ++i) theirs[2 * stride + i] -= p.params.gravity_z;
    const double off =
        std::max(farthest(density, kernels.rho.read(device, stride), stride, particles),
                 farthest(push, theirs, stride, particles));
    std::printf("%9zu  %6.3f ms  %6.3f  %5.2f  %6.3f ms  %6.3f  %5.2f  %5.2f      %.1e\n",
                particles, 1e3 * d, 1e3 * hd, hd / d, 1e3 * f, 1e3 * hf, hf / f,
                (hd + hf) / (d + f), off);
    if (csv != nullptr) {
      std::fprintf(csv, "kernels,%zu,%g,%g,%g,%g\n", particles, 1e3 * d, 1e3 * hd, 1e3 * f,
                   1e3 * hf);
    }
    if (!(off < 1e-4)) throw std::runtime_error("the yardstick and the kernels disagree");
  }
}

void against_size(Device& device, std::FILE* csv) {
  std::printf("\nThe whole step, without walls and bodies, in batches of 10; median of 7\n");
  std::printf("particles   ms/step  steps/s  M particle updates/s  MiB\n");
  for (const int count :
       {2'000, 4'000, 8'000, 15'625, 30'000, 60'000, 125'000, 250'000, 500'000, 1'000'000}) {
    Block block(device, count);
    const double step = wall_time(
                            [&] {
                              for (int k = 0; k < 10; ++k) block.move();
                              device.queue().finish();
                            },
                            count > 200'000 ? 3 : 7) /
                        10.0;
    const double particles = block.params.count;
    // Three vectors and an id twice, three densities, two of them twice, forces, flags.
    const double memory = particles * 4.0 * (2.0 * 7.0 + 5.0 + 3.0 + 2.0) / 1048576.0;
    std::printf("%9.0f  %8.3f  %7.0f  %20.2f  %3.0f\n", particles, 1e3 * step, 1.0 / step,
                1e-6 * particles / step, memory);
    std::fflush(stdout);
    if (csv != nullptr) std::fprintf(csv, "step,%.0f,%g\n", particles, 1e3 * step);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Device device(-1, true);
    std::printf("device: %s\n", describe(device.facts()).c_str());
    std::FILE* csv = nullptr;
    if (argc > 1) {
      std::filesystem::create_directories(argv[1]);
      const std::string path = std::string(argv[1]) + "/fluid.csv";
      csv = std::fopen(path.c_str(), "w");
      if (csv == nullptr) throw std::runtime_error("cannot write " + path);
      std::fprintf(csv, "what,particles,density_ms,by_hand_ms,forces_ms,by_hand_ms\n");
    }
    beside_the_yardstick(device, csv);
    against_size(device, csv);
    if (csv != nullptr && std::fclose(csv) != 0) throw std::runtime_error("the CSV is not whole");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench-fluid: %s\n", error.what());
    return 1;
  }
}
