// SPDX-License-Identifier: MIT
// What a step asks of a GPU: many work-items for each kernel, few launches, little memory. No
// kernel may be a few work-items that walk through all water, which a CPU forgives and a GPU does
// not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/fluid/params/parts.hpp"
#include "tests/bench/opencl_ledger.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

using bench::Launches;

/// Kernels with fewer work-items than a 64th of the particles, and why that is right.
const std::map<std::string, const char*> kFew = {
    {"judge_solve", "one work-group adds up what all work-groups found, one sum for 64 particles"},
    {"answer_bodies", "six equations for each body"},
    {"move_bodies", "contacts are solved one after another"},
    // Only while a free body is near a wall or another body:
    {"measure_rims", "64 for each body, each goes through a part of the water"},
    {"press_films", "64 for each body, each goes through a part of its skin"},
    {"sum_films", "one adds up what the others found"},
    // In proportion to the points on the bodies, which are fewer than particles:
    {"place_bodies", "one for each point"},
    {"gather_body_volumes", "one for each point"},
    {"count_points", "one for each point"},
    {"gather_cells", "one for each point"},
    {"rank_points", "one for each point"},
};

/// Two bodies in a pool of some ten thousand particles.
Water pool() {
  Water water = two_bodies();
  const std::vector<BodySettings> bodies = water.scene.bodies;
  water.scene = tank_scene(0.02, {0.8, 0.6, 0.6}, 0.2);
  water.scene.bodies = bodies;
  water.particles = random_places(11'777, {0, 0, 0}, {0.8, 0.6, 0.2}, 31);
  return water;
}

class LaunchShape : public ::testing::Test {
 protected:
  /// Launches of so many steps, with the health of each looked at.
  std::map<std::string, Launches> steps(Water& water, int count, bool free) {
    water.start(device_);
    if (free) {
      for (BodySettings& body : water.scene.bodies) {
        body.motion.kind = MotionKind::free;
        body.motion.density = 300.0;
      }
      water.fluid->release(free_bodies(water.scene.bodies),
                           film_skins(water.scene.bodies, water.scene.fluid.spacing));
    }
    water.fluid->begin_watch(static_cast<std::size_t>(count));
    bench::begin_ledger();
    for (int k = 0; k < count; ++k) water.step(1.0e-4);
    device_.queue().finish();
    return bench::end_ledger();
  }

  static void expect_many_items(const std::map<std::string, Launches>& kernels, int particles) {
    for (const auto& [name, launches] : kernels) {
      if (kFew.contains(name)) continue;
      EXPECT_GE(launches.least, static_cast<std::size_t>(particles) / 64) << name;
    }
  }

  static double launches_per_step(const std::map<std::string, Launches>& kernels, int steps) {
    std::int64_t all = 0;
    for (const auto& [name, launches] : kernels) all += launches.count;
    return static_cast<double>(all) / steps;
  }

  Device device_{-1, false, gpu_profile()};
};

TEST_F(LaunchShape, OfAStepIsWide) {
  Water water = pool();
  const auto kernels = steps(water, 3, false);
  expect_many_items(kernels, water.params.count);
  EXPECT_LE(launches_per_step(kernels, 3), 16.0);
}

TEST_F(LaunchShape, OfAStepWithFreeBodiesIsWide) {
  Water water = pool();
  const auto kernels = steps(water, 2, true);
  EXPECT_TRUE(kernels.contains("weigh_water"));
  expect_many_items(kernels, water.params.count);
  EXPECT_LE(launches_per_step(kernels, 2), 16.0 + 9.0 + 3.0);
}

// The statistics is taken once a frame.
TEST_F(LaunchShape, OfTheStatisticsIsWide) {
  Water water = pool();
  water.start(device_);
  bench::begin_ledger();
  static_cast<void>(water.fluid->stats());
  const auto kernels = bench::end_ledger();
  EXPECT_EQ(kernels.size(), 1U);
  expect_many_items(kernels, water.params.count);
}

// Which cells stay awake is found once a frame: a team of work-items goes along each row of them.
TEST_F(LaunchShape, OfALookAtWhatMaySleepIsWide) {
  Water water = pool();
  water.start(device_);
  water.fluid->let_sleep({0.02, 160});
  water.fluid->set_bodies(water.bodies->at(water.time));
  Step step = water.step_at(1.0e-4);
  step.opens_frame = true;
  bench::begin_ledger();
  water.fluid->prepare(step);
  device_.queue().finish();
  const auto kernels = bench::end_ledger();
  const auto rows = static_cast<std::size_t>(water.params.cells_y * water.params.cells_z);
  for (const char* name : {"keep_awake", "spread_activity"}) {
    ASSERT_TRUE(kernels.contains(name)) << name;
    EXPECT_GE(kernels.at(name).least, device_.profile().team * rows) << name;
  }
}

// Of a sort: five numbers for each point and cell, whichever there are more of.
TEST_F(LaunchShape, OfASortIsSmall) {
  const cl::Program program = build_program(device_, kernels::fluid(), {});
  for (const auto& [size, points] :
       std::vector<std::pair<double, std::size_t>>{{0.3, 100'000}, {3.0, 1000}, {3.0, 100'000}}) {
    const Scene scene = tank_scene(0.02, {size, size, size}, 0.1);
    const FluidParams params = make_params(scene, random_places(100, {0, 0, 0}, {1, 1, 1}, 3));
    const auto cells = static_cast<std::size_t>(SPLASH_SLICES) *
                       static_cast<std::size_t>(params.cells_x * params.cells_y * params.cells_z);
    const std::size_t before = bench::buffer_bytes();
    const NeighbourGrid grid(device_, program, params, points, device_.profile().sort_chunks);
    EXPECT_LE(bench::buffer_bytes() - before, 20 * (points + cells)) << cells << " cells";
  }
}

}  // namespace
}  // namespace splash::sim
