// SPDX-License-Identifier: MIT
// Kernels built without what the scene lacks say the same as whole ones: bit by bit where the
// compiler contracts both alike, as PoCL's does, elsewhere but for rounding.
#include "sim-server/fluid/params/parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

constexpr double kStep = 1.0e-3;  ///< [s]
/// What rounding may make of three such steps [m], [m/s].
constexpr float kPlaceRounds = 1.0e-5F;
constexpr float kSpeedRounds = 1.0e-2F;

bool contracts_alike(const Device& device) {
  return device.facts().platform == "Portable Computing Language";
}

/// `values`, of x, y and z for each particle, in the order of their names.
std::vector<float> by_name(const std::vector<float>& values, const std::vector<int>& names) {
  const std::size_t stride = values.size() / 3;
  std::vector<float> sorted(3 * names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sorted[3 * static_cast<std::size_t>(names[i]) + axis] = values[axis * stride + i];
    }
  }
  return sorted;
}

void expect_alike(const Snapshot& a, const Snapshot& b) {
  EXPECT_THAT(by_name(a.position, a.id),
              testing::Pointwise(testing::FloatNear(kPlaceRounds), by_name(b.position, b.id)));
  EXPECT_THAT(by_name(a.velocity, a.id),
              testing::Pointwise(testing::FloatNear(kSpeedRounds), by_name(b.velocity, b.id)));
}

Snapshot after_some_steps(Water& water, Device& device, const KernelBuild& build) {
  water.start(device, build);
  water.stir(0.3, 7);
  for (int k = 0; k < 3; ++k) water.step(kStep);
  return water.fluid->snapshot();
}

class Parts : public ::testing::TestWithParam<PressureKind> {
 protected:
  static void expect_no_difference(Device& device, Water lean, Water whole) {
    SCOPED_TRACE(lean.name);
    for (Water* water : {&lean, &whole}) water->scene.fluid.solver = GetParam();
    const Snapshot without = after_some_steps(lean, device, {.whole = false});
    const Snapshot with = after_some_steps(whole, device, {.whole = true});
    EXPECT_EQ(whole.fluid->parts().left_out(), 0);
    EXPECT_GT(lean.fluid->parts().left_out(), 0);
    expect_alike(without, with);
    if (!contracts_alike(device)) return;
    EXPECT_EQ(without.id, with.id);
    EXPECT_EQ(without.position, with.position);
    EXPECT_EQ(without.velocity, with.velocity);
    EXPECT_EQ(without.peak_density, with.peak_density);
  }
};

TEST_P(Parts, WhatASceneLacksIsNotMissed) {
  for (const int lanes : {1, 16}) {
    Device device(-1, false, lanes);
    std::vector<Water> lean = situations();
    std::vector<Water> whole = situations();
    for (std::size_t k = 0; k < lean.size(); ++k) {
      expect_no_difference(device, std::move(lean[k]), std::move(whole[k]));
    }
  }
}

TEST_P(Parts, NorIsFrictionWhereThereIsNone) {
  Device device;
  const auto smooth = [] {
    Water water = resting_lattice();
    water.scene.fluid.viscosity = water.scene.fluid.artificial = 0.0;
    return water;
  };
  expect_no_difference(device, smooth(), smooth());
  Water rubbing = resting_lattice();
  rubbing.scene.fluid.solver = GetParam();
  rubbing.start(device);
  EXPECT_TRUE(rubbing.fluid->parts().friction);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Parts, kBothSolvers, solver_name);

TEST(KernelParts, AreWhatTheSceneHas) {
  FluidParams params = {};
  params.slope = params.piston = -1;
  const std::vector<BodyShape> none;
  std::vector<BodyShape> one(1);
  EXPECT_EQ(parts_needed(params, none).left_out(), 6);
  EXPECT_TRUE(parts_needed(params, one).bodies);
  params.slope = 5;
  EXPECT_TRUE(parts_needed(params, none).slope);
  params.piston = 1;
  EXPECT_TRUE(parts_needed(params, none).piston);
  params.artificial = 0.1F;
  EXPECT_TRUE(parts_needed(params, none).friction);
  params.artificial = 0.0F;
  params.viscous = 0.01F;
  EXPECT_TRUE(parts_needed(params, none).friction);
  params.pockets = 1;
  EXPECT_TRUE(parts_needed(params, none).pockets);
  EXPECT_EQ(parts_needed(params, one).left_out(), 1);
  one[0].kind = SPLASH_MESH;
  EXPECT_EQ(parts_needed(params, one).left_out(), 0);
}

}  // namespace
}  // namespace splash::sim
