// SPDX-License-Identifier: MIT
// The initial flows: free of divergence, along the walls, as fast as they say.
#include "sim-server/scene/initial_fluid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

Scene basin(FlowKind kind) {
  Scene scene;
  scene.tank = {{-0.5, 0.1, 0.2}, {0.5, 0.7, 1.0}};
  scene.water = {{{-0.5, 0.1, 0.2}, {0.5, 0.7, 0.7}}};
  scene.flow.kind = kind;
  scene.flow.velocity = {0.1, 0.2, -0.3};
  scene.flow.centre = {0.1, 0.2, 0.3};
  scene.flow.rate = 4.0;
  scene.flow.amplitude = 0.02;
  scene.flow.mode = 2;
  scene.flow.speed = 0.3;
  return scene;
}

double divergence(const Scene& scene, const Vector3& place) {
  constexpr double kStep = 1.0e-5;
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    Vector3 ahead = place;
    Vector3 behind = place;
    ahead[i] += kStep;
    behind[i] -= kStep;
    sum += (initial_velocity(scene, ahead)[i] - initial_velocity(scene, behind)[i]) / (2 * kStep);
  }
  return sum;
}

TEST(Flow, HasNoDivergence) {
  for (const FlowKind kind :
       {FlowKind::uniform, FlowKind::strain, FlowKind::standing_wave, FlowKind::vortex}) {
    const Scene scene = basin(kind);
    const Vector3 place = {0.13, 0.33, 0.51};
    EXPECT_NEAR(divergence(scene, place), 0.0, 1e-8);
    EXPECT_GT(length(initial_velocity(scene, place)), 0.01);
  }
  EXPECT_EQ(length(initial_velocity(basin(FlowKind::none), {0.1, 0.2, 0.3})), 0.0);
}

TEST(Flow, RunsAlongTheWalls) {
  for (const FlowKind kind : {FlowKind::standing_wave, FlowKind::vortex}) {
    const Scene scene = basin(kind);
    EXPECT_NEAR(initial_velocity(scene, {-0.5, 0.4, 0.5})[0], 0.0, 1e-12);
    EXPECT_NEAR(initial_velocity(scene, {0.5, 0.4, 0.5})[0], 0.0, 1e-12);
    EXPECT_NEAR(initial_velocity(scene, {0.2, 0.1, 0.5})[1], 0.0, 1e-12);
    EXPECT_NEAR(initial_velocity(scene, {0.2, 0.7, 0.5})[1], 0.0, 1e-12);
    EXPECT_NEAR(initial_velocity(scene, {0.2, 0.3, 0.2})[2], 0.0, 1e-12);
  }
}

// At the surface the wave rises at a omega cos(kx).
TEST(Flow, OfAWaveCarriesItsCrestToItsAmplitude) {
  const Scene scene = basin(FlowKind::standing_wave);
  const double k = 2.0 * M_PI;
  const double omega = std::sqrt(9.81 * k * std::tanh(k * 0.5));
  EXPECT_NEAR(initial_velocity(scene, {-0.5, 0.4, 0.7})[2], 0.02 * omega, 1e-12);
  EXPECT_NEAR(initial_velocity(scene, {0.0, 0.4, 0.7})[2], -0.02 * omega, 1e-12);
}

// Far from the floor the orbits of deep water: cosh(kH) is beyond what a double holds.
TEST(Flow, OfAShortWaveInDeepWaterIsFinite) {
  Scene scene = basin(FlowKind::standing_wave);
  scene.tank = {{0.0, 0.0, 0.0}, {0.2, 0.2, 3.5}};
  scene.water = {{{0.0, 0.0, 0.0}, {0.2, 0.2, 3.0}}};
  scene.flow.mode = 100;
  const double k = 500.0 * M_PI;
  const double omega = std::sqrt(9.81 * k);
  const Vector3 top = initial_velocity(scene, {0.001, 0.1, 2.999});
  EXPECT_NEAR(top[0], -0.02 * omega * std::exp(-k * 0.001) * std::sin(k * 0.001), 1e-9);
  EXPECT_NEAR(top[2], 0.02 * omega * std::exp(-k * 0.001) * std::cos(k * 0.001), 1e-9);
  EXPECT_EQ(initial_velocity(scene, {0.001, 0.1, 0.1})[2], 0.0);
}

TEST(Flow, OfAStrainStretchesFromItsCentre) {
  const Vector3 v = initial_velocity(basin(FlowKind::strain), {0.2, 0.9, 0.6});
  EXPECT_NEAR(v[0], 0.4, 1e-12);
  EXPECT_EQ(v[1], 0.0);
  EXPECT_NEAR(v[2], -1.2, 1e-12);
}

TEST(Flow, OfAVortexIsAsFastAsItSays) {
  EXPECT_NEAR(initial_velocity(basin(FlowKind::vortex), {0.0, 0.1, 0.5})[0], 0.3, 1e-12);
}

}  // namespace
}  // namespace splash::sim
