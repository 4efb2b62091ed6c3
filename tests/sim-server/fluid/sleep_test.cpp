// SPDX-License-Identifier: MIT
// Water at rest sleeps, where and only where nothing moves it.
#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/sleeping.hpp"

namespace splash::sim {
namespace {

TEST_P(Sleeping, WaterAtRestStaysAsItIs) {
  put_to_sleep();
  const Snapshot before = water_.fluid->snapshot();
  const auto count = static_cast<std::size_t>(water_.params.count);
  const std::vector<float> density = water_.fluid->density().read(device_, count);
  const std::vector<float> pressure = water_.fluid->pressure_term().read(device_, count);
  for (int k = 0; k < 5; ++k) frame();
  const Snapshot after = water_.fluid->snapshot();
  EXPECT_EQ(before.position, after.position);
  EXPECT_EQ(before.velocity, after.velocity);
  EXPECT_EQ(before.id, after.id);
  EXPECT_EQ(density, water_.fluid->density().read(device_, count));
  EXPECT_EQ(pressure, water_.fluid->pressure_term().read(device_, count));
  EXPECT_GT(density.front(), 500.0F);
}

TEST_P(Sleeping, ABodyThatMovesWakesWhatItReachesAndNoMore) {
  put_to_sleep();
  drop_ = 0.5;
  double woken_at = -1.0;
  int frames = 0;
  while (woken_at < 0.0 && ++frames < 2000) {
    frame();
    if (water_.fluid->stats().asleep < water_.params.count) woken_at = height_;
  }
  // Its underside is as far from the water as the support and two cells reach, and not nearer
  // than the support: what it pushes is awake in time.
  const double support = static_cast<double>(water_.params.support);
  const double gap = woken_at - 0.03 - 0.12;
  EXPECT_GT(gap, 0.9 * support);
  EXPECT_LT(gap, 3.1 * support);
  const Snapshot state = water_.fluid->snapshot();
  const std::vector<int> moves = moving();
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const double x = vector_of(*water_.fluid, state.position, i)[0];
    if (x > 0.9) {
      EXPECT_EQ(moves[i], 0) << "at " << x;
    }
  }
}

TEST_P(Sleeping, AFastParticleKeepsItsSurroundingsAwake) {
  put_to_sleep();
  const int fast = water_.params.count / 2;
  Snapshot state = water_.fluid->snapshot();
  for (int k = 0; k < kRule.frames + 3; ++k) {
    std::fill(state.velocity.begin(), state.velocity.end(), 0.0F);
    state.velocity[part(*water_.fluid, 1, where(state, fast))] = 0.06F;
    if (k == 0) water_.fluid->restore(state);  // which wakes everything
    set_velocity(state.velocity);
    frame();
    state = water_.fluid->snapshot();
  }
  const double cell = static_cast<double>(water_.params.support);
  const std::vector<int> moves = moving();
  const Vector3 source = vector_of(*water_.fluid, state.position, where(state, fast));
  int asleep = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Vector3 off = vector_of(*water_.fluid, state.position, i) - source;
    const double apart = std::max({std::abs(off[0]), std::abs(off[1]), std::abs(off[2])});
    if (apart < 0.9 * cell) {
      EXPECT_NE(moves[i], 0) << "next to the fast one";
    }
    // A vector of particles moves as one: 16 in a row of 16 a cell and less, here.
    if (std::abs(off[0]) > 8.0 * cell) {
      EXPECT_EQ(moves[i], 0) << "far from the fast one";
      ++asleep;
    }
  }
  EXPECT_GT(asleep, 20);
}

// A rule that nothing can meet must change nothing at all.
TEST_P(Sleeping, WhileAllAreAwakeNothingDiffers) {
  Device device(-1, false, GetParam());
  std::vector<Snapshot> ends;
  for (const double speed : {0.0, 1.0e-4}) {
    Water water;
    water.scene = tank_scene(0.03, {0.4, 0.24, 0.6}, 0.12);
    water.particles = initial_particles(water.scene);
    water.start(device);
    water.fluid->let_sleep({speed, 1000});
    water.stir(0.5, 3);
    water.fluid->set_bodies({});
    for (int k = 0; k < 30; ++k) {
      const Step step = {kDt, 0.0, 0.0, 0, true};
      water.fluid->prepare(step);
      water.fluid->advance(step);
    }
    ends.push_back(water.fluid->snapshot());
  }
  EXPECT_EQ(ends[0].position, ends[1].position);
  EXPECT_EQ(ends[0].velocity, ends[1].velocity);
}

INSTANTIATE_TEST_SUITE_P(Builds, Sleeping, kScalarAndVector, lanes_name);

}  // namespace
}  // namespace splash::sim
