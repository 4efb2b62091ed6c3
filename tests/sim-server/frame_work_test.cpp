// SPDX-License-Identifier: MIT
// What the benchmark says that a frame of the pool asks of a device, against what runs; and that
// nothing is read before the last kernel of a frame.
#include "tests/bench/frame_work.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/source_folder.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;
using testing::UnorderedElementsAreArray;

/// The pool of the program, by the state equation.
Scene pool_scene() {
  Scene scene = read_scene(tests::source_folder() / "configs" / "scenes" / "pool.yaml");
  scene.fluid.solver = PressureKind::weakly_compressible;
  return scene;
}

/// The same with less water.
Scene small_pool() {
  Scene scene = pool_scene();
  scene.fluid.particles = 3000;
  scene.fluid.settle = SettleKind::never;
  scene.detect.bubble_speed = 0.3;  // what falls in place is fast enough
  return scene;
}

struct Cut {
  const char* name;
  Profile profile;
};

class FrameOfThePool : public ::testing::TestWithParam<Cut> {
 protected:
  /// Frames until there are bubbles to carry, or not.
  static void go_on(Simulation& pool, bool bubbles) {
    for (int k = 0; k < 400 && (pool.totals().bubbles_alive > 0) != bubbles; ++k) {
      static_cast<void>(pool.advance());
    }
    ASSERT_EQ(pool.totals().bubbles_alive > 0, bubbles);
  }

  void expect_what_runs(Simulation& pool) {
    begin_ledger();
    const FrameSeen seen = see_frame(pool);
    device_.queue().finish();
    Commands ran = noted_commands();
    std::map<std::string, double> launched;
    for (const auto& [name, launches] : end_ledger()) {
      launched[name] = static_cast<double>(launches.count);
    }
    std::map<std::string, double> told;
    for (const auto& [name, work] : frame_work(seen, device_.profile())) {
      told[name] = work.launches;
    }
    EXPECT_THAT(told, UnorderedElementsAreArray(launched));
    ran.reads -= seen.own_reads;
    ran.late_kernels = 0;
    const Commands commands = frame_commands(seen);
    EXPECT_EQ(commands.writes, ran.writes);
    EXPECT_EQ(commands.fills, ran.fills);
    EXPECT_EQ(commands.copies, ran.copies);
    EXPECT_EQ(commands.reads, ran.reads);
  }

  Device device_{-1, false, GetParam().profile};
};

TEST_P(FrameOfThePool, NamesTheLaunchesOfAFrameOfThePool) {
  Simulation pool(device_, small_pool(), {});
  go_on(pool, false);
  expect_what_runs(pool);
  go_on(pool, true);
  expect_what_runs(pool);
}

// A driver may let a read into pageable memory wait for all that was enqueued before it.
TEST_P(FrameOfThePool, ReadsNothingBeforeTheLastKernel) {
  Simulation pool(device_, small_pool(), {});
  go_on(pool, true);
  begin_ledger();
  static_cast<void>(pool.advance());
  device_.queue().finish();
  const Commands ran = noted_commands();
  static_cast<void>(end_ledger());
  EXPECT_GE(ran.reads, 5) << "stats, health, contacts, spawns and bubbles";
  EXPECT_EQ(ran.late_kernels, 0);
}

TEST_P(FrameOfThePool, GrowsWithTheWater) {
  Simulation pool(device_, small_pool(), {});
  const FrameSeen seen = see_frame(pool);
  const auto work = frame_work(seen, device_.profile());
  const double n = pool.particles();
  EXPECT_GT(work.at("compute_acceleration").operations, 46.0 * 60.0 * n * seen.steps)
      << "each has some sixty neighbours";
  EXPECT_DOUBLE_EQ(work.at("check_health").bytes, 64.0 * n * seen.steps);
}

// 4.3 TB/s, 60 T operations/s, of which pairs reach a third, and 5 us for each command: an H200.
TEST(FrameWork, OfThePoolIsShortOnAFastGpu) {
  Device device(-1, false, gpu_profile());
  Scene scene = pool_scene();
  scene.fluid.settle = SettleKind::never;
  Simulation pool(device, scene, {});
  const FrameSeen seen = see_frame(pool);
  const Limits fast = {.bandwidth = 4.3e12, .arithmetic = 20e12, .runs = 4.3e12 / 32.0};
  double seconds =
      5e-6 * static_cast<double>(frame_commands(seen).all()) + copied_bytes(seen) / fast.bandwidth;
  for (const auto& [name, work] : frame_work(seen, device.profile())) {
    seconds += expected(work, fast) + 5e-6 * work.launches;
  }
  EXPECT_LT(seconds / seen.steps, 0.2e-3);
  EXPECT_GT(seconds / seen.steps, 0.05e-3);
}

INSTANTIATE_TEST_SUITE_P(Profiles, FrameOfThePool,
                         ::testing::Values(Cut{"cpu", cpu_profile(2)}, Cut{"gpu", gpu_profile()}),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace splash::bench
