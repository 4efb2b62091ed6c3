// SPDX-License-Identifier: MIT
// Bodies that lie on the floor or on each other: the water carries them as it does elsewhere, and
// what is light rises, whether the water around it sleeps or not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <tuple>

#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

constexpr double kDiameter = 0.12;  // [m]
constexpr double kVolume = M_PI / 6.0 * kDiameter * kDiameter * kDiameter;

/// What lies in 0.24 m of water, `per` spacings to a ball's diameter; `more`: of the fluid's table.
Scene pond(int per, const std::string& bodies, const std::string& more = "") {
  return parse_scene("fluid: {spacing: " + std::to_string(kDiameter / per) + more + R"(}
tank: {lower: [0.0, 0.0, 0.0], upper: [0.3, 0.3, 0.6]}
water: [{lower: [0.0, 0.0, 0.0], upper: [0.3, 0.3, 0.24]}]
bodies:
)" + bodies,
                     "pond.yaml");
}

const std::string kHeld = "kind: fixed";

std::string ball(const std::string& name, double z, const std::string& motion) {
  return "  - {name: " + name +
         ", shape: {kind: sphere, size: [0.12, 0.12, 0.12]}, rest: {position: [0.15, 0.15, " +
         std::to_string(z) + "]}, motion: {" + motion + "}}\n";
}

/// The mean force of the water on each body over a second, in the weight of what a ball displaces.
std::vector<double> buoyancies(Scene scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    GaugeSettings probe;
    probe.name = scene.bodies[b].name;
    probe.kind = GaugeKind::body;
    probe.body = b;
    scene.gauges.probes.push_back(probe);
  }
  Device device;
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  constexpr int kFrames = 100;
  std::vector<double> sums(scene.bodies.size(), 0.0);
  for (int k = 0; k < kFrames; ++k) {
    static_cast<void>(simulation.advance());
    if (k % 5 != 4) continue;
    const auto row = gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies());
    for (std::size_t b = 0; b < sums.size(); ++b) sums[b] += row[16 + 19 * b];
  }
  for (double& sum : sums) sum /= kFrames / 5 * 998.0 * 9.81 * kVolume;
  return sums;
}

class LyingBody : public ::testing::TestWithParam<int> {  // spacings across the ball
 protected:
  [[nodiscard]] Scene scene(const std::string& bodies) const {
    return pond(GetParam(), bodies, ", solver: weakly_compressible");
  }
};

TEST_P(LyingBody, KeepsItsBuoyancyOnTheFloorAndOnAnother) {
  const std::vector<double> shares =
      buoyancies(scene(ball("lower", 0.06, kHeld) + ball("upper", 0.18, kHeld)));
  std::printf("lower %.3f, upper %.3f of their buoyancy\n", shares[0], shares[1]);
  EXPECT_NEAR(shares[0], 1.0, 0.05);
  EXPECT_NEAR(shares[1], 1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Spacings, LyingBody, ::testing::Values(6, 8, 12));

/// Its density, spacings across it, and whether still water sleeps.
class LightBody : public ::testing::TestWithParam<std::tuple<int, int, bool>> {};

TEST_P(LightBody, RisesFromTheFloor) {
  const auto& [density, per, sleep] = GetParam();
  Device device;
  Scene scene = pond(per, ball("ball", 0.06, "kind: free, density: " + std::to_string(density)));
  scene.skip.sleep = sleep;
  Simulation simulation(device, scene, {});
  double height = 0.0;
  while (simulation.seconds() < 4.0 && height < 0.18) {
    static_cast<void>(simulation.advance());
    height = simulation.bodies().state(0, simulation.seconds()).position[2];
  }
  std::printf("at %.3f m after %.2f s\n", height, simulation.seconds());
  EXPECT_GE(height, 0.18);
}

INSTANTIATE_TEST_SUITE_P(Cases, LightBody,
                         ::testing::Combine(::testing::Values(250, 500, 750),
                                            ::testing::Values(6, 8, 12), ::testing::Bool()),
                         [](const auto& body) {
                           return std::to_string(std::get<0>(body.param)) + "_" +
                                  std::to_string(std::get<1>(body.param)) +
                                  (std::get<2>(body.param) ? "_asleep" : "_awake");
                         });

}  // namespace
}  // namespace splash::sim
