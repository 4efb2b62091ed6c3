// SPDX-License-Identifier: MIT
// Each solver runs each scene, in steps as long as it can.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program/config.hpp"
#include "sim-server/scene/scene_reader.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A pool of grid-projected water that has `more`.
std::string pool(const std::string& more = "") {
  return "fluid:\n"
         "  particles: 1000\n"
         "  solver: grid_projected\n"
         "tank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
         "water:\n"
         "  - {lower: [0, 0, 0], upper: [1, 1, 0.5]}\n" +
         more;
}

TEST(SolverRules, AGridCarriesFreeBodiesSlopesAndWaveMakers) {
  EXPECT_EQ(parse_scene(pool(), "pool.yaml").fluid.solver, PressureKind::grid_projected);
  for (const char* more :
       {"bodies:\n"
        "  - {name: ball, shape: {kind: sphere, size: [0.2, 0.2, 0.2]},"
        " rest: {position: [0.5, 0.5, 0.8]}, motion: {kind: free, density: 500}}\n",
        "slope: {foot: 0.5, gradient: 0.2}\n", "wave_maker: {stroke: 0.1}\n"}) {
    EXPECT_NO_THROW(static_cast<void>(parse_scene(pool(more), "pool.yaml"))) << more;
  }
}

}  // namespace
}  // namespace splash::sim
