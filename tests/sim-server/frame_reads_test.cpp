// SPDX-License-Identifier: MIT
// Nothing is read before the last kernel of a frame: a driver may let a read into pageable memory
// wait for all that was enqueued before it.
#include <gtest/gtest.h>

#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/opencl_ledger.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::sim {
namespace {

class FrameOfThePool : public ::testing::TestWithParam<bool> {};

TEST_P(FrameOfThePool, ReadsNothingBeforeTheLastKernel) {
  Device device(-1, false, GetParam() ? gpu_profile() : cpu_profile(2));
  Scene scene = read_scene(tests::scene_file("pool"));
  scene.fluid.solver = PressureKind::weakly_compressible;
  scene.fluid.particles = 3000;
  scene.fluid.settle = SettleKind::never;
  scene.detect.bubble_speed = 0.3;  // what falls in place is fast enough
  Simulation pool(device, scene, {});
  for (int k = 0; k < 400 && pool.totals().bubbles_alive == 0; ++k) {
    static_cast<void>(pool.advance());
  }
  ASSERT_GT(pool.totals().bubbles_alive, 0);
  bench::begin_ledger();
  static_cast<void>(pool.advance());
  device.queue().finish();
  const bench::Commands ran = bench::noted_commands();
  static_cast<void>(bench::end_ledger());
  EXPECT_GE(ran.reads, 5) << "stats, health, contacts, spawns and bubbles";
  EXPECT_EQ(ran.late_kernels, 0);
}

INSTANTIATE_TEST_SUITE_P(Profiles, FrameOfThePool, ::testing::Bool(),
                         [](const auto& chosen) { return chosen.param ? "gpu" : "cpu"; });

}  // namespace
}  // namespace splash::sim
