// SPDX-License-Identifier: MIT
// Two steps, or more, of a small fluid with walls, slope, piston and bodies, a third of its
// particles pinned, in a tank that turns if no body is free, and two in which it may sleep: every
// kernel once, small enough for an OpenCL interpreter. Arguments: particles per vector (1, 8 or
// 16), the solver (0: weakly compressible, 1: grid projected), whether the
// water moves the bodies (1), and how many steps.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <vector>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/fluid/free_bodies/body_pushes.hpp"
#include "sim-server/fluid/pressure/tank_turn.hpp"
#include "sim-server/start/settle.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace {

using namespace splash::sim;

constexpr std::array kSolvers = {PressureKind::weakly_compressible, PressureKind::grid_projected};

std::vector<bool> every_third(std::size_t count) {
  std::vector<bool> flags(count);
  for (std::size_t i = 0; i < count; i += 3) flags[i] = true;
  return flags;
}

int two_steps(int lanes, PressureKind solver, bool free, int steps) {
  // As on two cores: a simulated device has one.
  Device device(-1, false, lanes == 1 ? gpu_profile() : cpu_profile(2, lanes));
  Water water = two_bodies();
  water.particles = random_places(230, {0, 0, 0}, {0.4, 0.4, 0.14}, 51);
  for (int i = 0; i < 21; ++i) water.particles.push_back({0.2, 0.1 + 0.01 * i, 0.3});
  water.scene.fluid.solver = solver;
  // An interpreter takes a minute for the cells of two spacings of 20 mm.
  if (solver == PressureKind::grid_projected) water.scene.fluid.spacing = 0.03;
  water.scene.fluid.air_pockets = solver == PressureKind::grid_projected && lanes > 1;
  water.scene.slope = {true, 0.2, 0.3};
  water.scene.wave_maker = {true, 0.1, 2.0};
  water.piston = {0.01, 0.2};
  water.start(device);
  std::optional<BodyPushes> pushes;
  if (free) {
    for (BodySettings& body : water.scene.bodies) {
      body.motion.kind = MotionKind::free;
      body.motion.density = 300.0;
    }
    MotionSettings& hung = water.scene.bodies.back().motion;
    hung.kind = MotionKind::osc;
    hung.coupling = CouplingKind::spring;
    hung.stiffness = 50.0;
    hung.damping = 1.0;
    std::vector<FreeBody> felt = free_bodies(water.scene.bodies);
    const auto skins = film_skins(water.scene.bodies, water.scene.fluid.spacing);
    water.fluid->release(felt, skins);
    for (FreeBody& body : felt) body.mass = 0.0F;
    pushes.emplace(*water.fluid, felt, skins);
    water.fluid->feel(true);
    water.fluid->free_bodies()->hang(
        device, std::vector<Anchor>(felt.size(), {0.2F, 0.2F, 0.2F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F,
                                                  0.0F, 0.0F, 0.0F, 0.0F, 0.0F}));
  }
  water.fluid->begin_watch(static_cast<std::size_t>(steps) + 2);
  PinnedParticles pinned(*water.fluid, every_third(water.particles.size()));
  TankTurning turning(device);
  turning.set(device, turn_of({{0.0, 0.0, -9.81}, {0.5, 0.0, 1.0}, {2.0, 0.0, 0.0}},
                              {0.2, 0.2, 0.0}, 1.0e-3));
  for (int k = 0; k < steps; ++k) {
    if (pushes) {
      // How pushes on a body depend on speeds takes six solves: one body in every other step, and
      // none where 256 work-items solve, which are too many for an interpreter.
      std::vector<bool> asks(water.scene.bodies.size(), false);
      asks[static_cast<std::size_t>(k / 2) % asks.size()] =
          k % 2 == 0 && (lanes != 1 || solver != PressureKind::grid_projected);
      pushes->begin(*water.fluid, asks);
    } else {
      turning.push(*water.fluid);
    }
    water.step(1.0e-3, [&](Fluid& fluid) {
      if (pushes) pushes->add(fluid, water.step_at(1.0e-3));
    });
    pinned.restore();
  }
  water.fluid->let_sleep({.speed = 0.05, .frames = 1});
  Step sleepy = water.step_at(1.0e-3);
  sleepy.opens_frame = true;
  for (int k = 0; k < 2; ++k) {
    water.fluid->zero_velocities();
    water.fluid->prepare(sleepy);
    water.fluid->advance(sleepy);
  }
  if (solver == PressureKind::grid_projected)
    water.fluid->prepare(water.step_at(0.0));  // as gauges
  const FluidStats stats = water.fluid->stats();
  std::printf("%s: %d particles, %d body points, fastest %.3f m/s, %d faulty\n",
              device.facts().platform.c_str(), water.params.count,
              water.fluid->boundary().point_count(), stats.speed, stats.not_finite);
  return stats.not_finite == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int solver = argc > 2 ? std::atoi(argv[2]) : 0;
    return two_steps(argc > 1 ? std::atoi(argv[1]) : 0,
                     kSolvers.at(static_cast<std::size_t>(solver)),
                     argc > 3 && std::atoi(argv[3]) == 1, argc > 4 ? std::atoi(argv[4]) : 2);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
