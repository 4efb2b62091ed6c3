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

/// `values`, of `parts` for each particle, in the order of their names.
std::vector<float> by_name(const std::vector<float>& values, const std::vector<int>& names,
                           std::size_t parts) {
  const std::size_t stride = values.size() / parts;
  std::vector<float> sorted(parts * names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t part = 0; part < parts; ++part) {
      sorted[parts * static_cast<std::size_t>(names[i]) + part] = values[part * stride + i];
    }
  }
  return sorted;
}

void expect_alike(const Snapshot& a, const Snapshot& b) {
  EXPECT_THAT(by_name(a.position, a.id, 3),
              testing::Pointwise(testing::FloatNear(kPlaceRounds), by_name(b.position, b.id, 3)));
  EXPECT_THAT(by_name(a.velocity, a.id, 3),
              testing::Pointwise(testing::FloatNear(kSpeedRounds), by_name(b.velocity, b.id, 3)));
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
  std::vector<Water> lean = situations();
  std::vector<Water> whole = situations();
  for (Water* water : {&lean.front(), &whole.front()}) {
    water->scene.fluid.viscosity = 0.0;
    water->scene.fluid.artificial = 0.0;
  }
  expect_no_difference(device, std::move(lean.front()), std::move(whole.front()));
  std::vector<Water> rubbing = situations();
  rubbing.front().scene.fluid.solver = GetParam();
  rubbing.front().start(device);
  EXPECT_TRUE(rubbing.front().fluid->parts().friction);
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
