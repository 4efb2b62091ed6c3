// SPDX-License-Identifier: MIT
// Test S5, the short way: a built-in scene for 20,000 steps. A million of each: ./splash bench
// stability -- --part endurance.
#include "tests/stress/endurance.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace splash::stress {
namespace {

TEST(Endurance, TwentyThousandStepsLoseNothingAndKeepTheirMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep what is freed: memory grows with them";
#endif
  const tests::TemporaryFolder out;
  Endurance wanted;
  wanted.scenes = {"bucket"};
  wanted.steps = 20'000;
  wanted.coarser = 2.0;
  sim::Device device;
  EXPECT_EQ(endure(device, wanted, out.path()), 0) << "see its lines above";
}

}  // namespace
}  // namespace splash::stress
