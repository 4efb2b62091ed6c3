// SPDX-License-Identifier: MIT
// What a scene's water has become when its time begins: what something holds has come to rest, and
// what nothing holds is where the scene says, at rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "sim-server/simulation/water_notices.hpp"

namespace splash::sim {
namespace {

const std::string kPool = "  - {lower: [0.0, 0.0, 0.0], upper: [0.5, 0.3, 0.15]}\n";
const std::string kDam = "  - {lower: [0.0, 0.0, 0.0], upper: [0.2, 0.3, 0.3]}\n";
const std::string kDrop =
    "  - {lower: [0.175, 0.075, 0.4], upper: [0.325, 0.225, 0.55], form: sphere}\n";

const std::string kState = ", solver: weakly_compressible";

Scene scene_of(const std::string& water, const std::string& fluid = kState) {
  return parse_scene("fluid: {spacing: 0.025" + fluid +
                         "}\n"
                         "tank: {lower: [0.0, 0.0, 0.0], upper: [0.5, 0.3, 0.6]}\n"
                         "skip: {sleep: false}\n"
                         "water:\n" +
                         water,
                     "water.yaml");
}

struct Particle {
  Vector3 place = {};
  Vector3 velocity = {};
};

/// By id.
std::vector<Particle> particles_of(Simulation& simulation) {
  const Snapshot now = simulation.fluid().snapshot();
  const auto stride = static_cast<std::size_t>(simulation.fluid().params().capacity);
  std::vector<Particle> all(now.id.size());
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    Particle& particle = all[static_cast<std::size_t>(now.id[i])];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      particle.place[axis] = static_cast<double>(now.position[axis * stride + i]);
      particle.velocity[axis] = static_cast<double>(now.velocity[axis * stride + i]);
    }
  }
  return all;
}

/// The farthest that any particle of `lattice` from `first` on is from where it was put [spacings].
double farthest(const std::vector<Particle>& all, const std::vector<Vector3>& lattice,
                std::size_t first = 0) {
  double most = 0.0;
  for (std::size_t i = first; i < all.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      most = std::max(most, std::abs(all[i].place[axis] - lattice[i][axis]) / 0.025);
    }
  }
  return most;
}

class Settling : public ::testing::TestWithParam<const char*> {};

TEST_P(Settling, LeavesADropWhereItHangs) {
  Device device;
  const Scene scene = scene_of(kPool + kDrop, GetParam());
  const std::vector<Vector3> lattice = initial_particles(scene);
  const std::size_t pool = initial_particles(scene_of(kPool)).size();
  Simulation simulation(device, scene, {});
  const std::vector<Particle> start = particles_of(simulation);
  EXPECT_LT(farthest(start, lattice, pool), 1.5) << "packed anew, where it was";
  for (const Particle& particle : start) EXPECT_EQ(particle.velocity, Vector3({0.0, 0.0, 0.0}));
  for (std::size_t i = 0; i < pool; ++i) EXPECT_LT(start[i].place[2], 0.17);
  // Then it falls as one, and nothing in it presses.
  while (simulation.seconds() < 0.1) ASSERT_FALSE(simulation.advance().step_fault);
  const double speed = 9.81 * simulation.seconds();
  const std::vector<Particle> later = particles_of(simulation);
  for (std::size_t i = pool; i < later.size(); ++i) {
    EXPECT_NEAR(later[i].velocity[0], 0.0, 0.05);
    EXPECT_NEAR(later[i].velocity[1], 0.0, 0.05);
    EXPECT_NEAR(later[i].velocity[2], -speed, 0.05);
  }
}

TEST_P(Settling, LeavesADamWhereItStands) {
  Device device;
  const Scene scene = scene_of(kDam, GetParam());
  Simulation simulation(device, scene, {});
  const std::vector<Particle> start = particles_of(simulation);
  EXPECT_LT(farthest(start, initial_particles(scene)), 0.1);
  for (const Particle& particle : start) EXPECT_EQ(particle.velocity, Vector3({0.0, 0.0, 0.0}));
  // Its column gets to the other side of the tank, 0.3 m farther, only in time.
  const auto front = [&] {
    double x = 0.0;
    for (const Particle& particle : particles_of(simulation)) x = std::max(x, particle.place[0]);
    return x;
  };
  EXPECT_LT(front(), 0.2);
  while (simulation.seconds() < 0.3) ASSERT_FALSE(simulation.advance().step_fault);
  EXPECT_GT(front(), 0.45);
}

INSTANTIATE_TEST_SUITE_P(
    Solvers, Settling,
    ::testing::Values(", solver: weakly_compressible", ", solver: grid_projected"),
    [](const auto& solver) {
      return std::string(solver.param).substr(std::string(", solver: ").size());
    });

TEST(SettlingOfHeldWater, IsTheSameToTheLastBitWhateverIsAskedElsewhere) {
  Device device;
  Simulation asked(device, scene_of(kPool, kState + ", settle: always"), {});
  Simulation usual(device, scene_of(kPool), {});
  const Snapshot a = asked.fluid().snapshot();
  const Snapshot b = usual.fluid().snapshot();
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.id, b.id);
  EXPECT_GT(farthest(particles_of(usual), initial_particles(scene_of(kPool))), 0.1) << "it settled";
}

TEST(SettlingOfHeldWater, IsLeftOutWhereTheSceneWantsNone) {
  Device device;
  const Scene scene = scene_of(kPool + kDrop, ", settle: never");
  Simulation simulation(device, scene, {});
  EXPECT_LT(farthest(particles_of(simulation), initial_particles(scene)), 0.1) << "nor packed";
}

TEST(SettlingOfFreeWater, IsDoneWhereTheSceneWantsIt) {
  Device device;
  Simulation simulation(device, scene_of(kDrop, ", settle: always"), {});
  for (const Particle& particle : particles_of(simulation)) EXPECT_LT(particle.place[2], 0.4);
}

TEST(SettlingOfFreeWater, IsToldInOneLine) {
  Device device;
  Simulation falling(device, scene_of(kPool + kDrop), {});
  EXPECT_EQ(unsupported_water(falling).substr(0, 69),
            "nothing holds block 2, from 0.175 0.075 0.4 to 0.325 0.225 0.55 of th");
  Simulation still(device, scene_of(kPool), {});
  EXPECT_EQ(unsupported_water(still), "");
}

}  // namespace
}  // namespace splash::sim
