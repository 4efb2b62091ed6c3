// SPDX-License-Identifier: MIT
// Water at rest sleeps, where and only where nothing moves it; what a step passes over stays as it
// is, is known by its cells, and is looked at once a frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr SleepRule kRule = {.speed = 0.05, .frames = 3};
constexpr double kDt = 1.0e-3;

/// A trough 1.2 m long; a box hangs above its left end and comes down when it is told to.
class Sleeping : public ::testing::TestWithParam<int> {
 protected:
  Sleeping() : device_(-1, false, GetParam()) {
    water_.scene = tank_scene(0.03, {1.2, 0.24, 0.6}, 0.12);
    water_.scene.bodies = {body_of("box", {ShapeKind::box, {0.12, 0.12, 0.06}})};
    water_.particles = initial_particles(water_.scene);
    water_.settle = true;
    water_.motions = {[this](double) {
      return BodyState{{0.12, 0.12, height_}, {0, 0, 0, 1}, {0.0, 0.0, -drop_}};
    }};
    water_.start(device_);
    water_.fluid->zero_velocities();
    water_.fluid->let_sleep(kRule);
  }

  /// One frame of one step.
  void frame() {
    Fluid& fluid = *water_.fluid;
    const Step step = {kDt, 0.0, 0.0, 0, true};
    fluid.set_bodies(water_.bodies->at(water_.time));
    fluid.prepare(step);
    fluid.advance(step);
    device_.queue().finish();
    height_ -= drop_ * kDt;
    water_.time += kDt;
  }

  /// Stops all water, frame by frame, until it sleeps.
  void put_to_sleep() {
    for (int k = 0; k < kRule.frames + 2; ++k) {
      water_.fluid->zero_velocities();
      frame();
    }
    ASSERT_EQ(water_.fluid->stats().asleep, water_.params.count);
  }

  std::vector<int> moving() const {
    return water_.fluid->moving().read(water_.fluid->device(),
                                       static_cast<std::size_t>(water_.params.count));
  }

  static std::size_t where(const Snapshot& state, int id) {
    return static_cast<std::size_t>(std::find(state.id.begin(), state.id.end(), id) -
                                    state.id.begin());
  }

  /// Without waking anyone.
  void set_velocity(const std::vector<float>& velocity) {
    const_cast<Buffer<float>&>(water_.fluid->particles().velocity).write(device_, velocity);
  }

  double height_ = 0.5;
  double drop_ = 0.0;
  Device device_;
  Water water_;
};

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
    const double x = state.place(i)[0];
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
    state.velocity[state.velocity.size() / 3 + where(state, fast)] = 0.06F;  // along y
    if (k == 0) water_.fluid->restore(state);  // which wakes everything
    set_velocity(state.velocity);
    frame();
    state = water_.fluid->snapshot();
  }
  const double cell = static_cast<double>(water_.params.support);
  const std::vector<int> moves = moving();
  const Vector3 source = state.place(where(state, fast));
  int asleep = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Vector3 off = state.place(i) - source;
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

class Resting : public Sleeping {
 protected:
  /// By id: where each is in the arrays, and its place, velocity, density, P and acceleration.
  struct Numbers {
    std::vector<std::size_t> id;  ///< of each in the arrays
    std::vector<std::size_t> place;
    std::vector<std::array<float, 11>> state;
  };
  Numbers numbers() {
    const Fluid& fluid = *water_.fluid;
    const auto count = static_cast<std::size_t>(water_.params.count);
    const auto n = static_cast<std::size_t>(fluid.params().capacity);
    const Snapshot now = water_.fluid->snapshot();
    const std::vector<float> density = fluid.density().read(device_, count);
    const std::vector<float> pressure = fluid.pressure_term().read(device_, count);
    const std::vector<float> push = fluid.acceleration().read(device_, 3 * n);
    Numbers all = {std::vector<std::size_t>(count), std::vector<std::size_t>(count),
                   std::vector<std::array<float, 11>>(count)};
    for (std::size_t i = 0; i < count; ++i) {
      const auto id = static_cast<std::size_t>(now.id[i]);
      all.id[i] = id;
      all.place[id] = i;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        all.state[id][axis] = now.position[axis * n + i];
        all.state[id][3 + axis] = now.velocity[axis * n + i];
        all.state[id][6 + axis] = push[axis * n + i];
      }
      all.state[id][9] = density[i];
      all.state[id][10] = pressure[i];
    }
    return all;
  }

  /// What goes on in each cell; nothing beyond the grid.
  struct Cells {
    int x, y, z;
    std::vector<int> activity;
    int operator()(int at_x, int at_y, int at_z) const {
      const bool within = at_x >= 0 && at_x < x && at_y >= 0 && at_y < y && at_z >= 0 && at_z < z;
      return within ? activity[static_cast<std::size_t>((at_z * y + at_y) * x + at_x)] : 0;
    }
    [[nodiscard]] std::array<int, 3> of(const FluidParams& p,
                                        const std::array<float, 11>& state) const {
      const auto cell = [](float a, int cells) {
        return std::clamp(static_cast<int>(a), 1, cells - 2);
      };
      return {cell((state[0] - p.origin_x) * p.inverse_cell, x),
              cell((state[1] - p.origin_y) * p.inverse_cell, y),
              cell((state[2] - p.origin_z) * p.inverse_cell, z)};
    }
  };
  Cells read_cells() {
    const FluidParams& p = water_.params;
    Cells cells = {p.cells_x, p.cells_y, p.cells_z, {}};
    cells.activity = water_.fluid->cell_activity().read(
        device_, static_cast<std::size_t>(p.cells_x * p.cells_y * p.cells_z));
    return cells;
  }

  /// The most that goes on in the cells of all that are handled with particle `id`: those of its
  /// vector that are in the same row. Vectors are as they are `now`, cells as they were sorted by,
  /// of where all had been `before` the step: whoever wakes may leave its cell at once.
  int most_around(const Cells& activity, const Numbers& before, const Numbers& now,
                  std::size_t id) const {
    const auto lanes = static_cast<std::size_t>(GetParam());
    const std::size_t first = now.place[id] / lanes * lanes;
    const std::array<int, 3> here = activity.of(water_.params, before.state[id]);
    int from = here[0];
    int to = here[0];
    for (std::size_t i = first; i < std::min(first + lanes, now.id.size()); ++i) {
      const std::array<int, 3> cell = activity.of(water_.params, before.state[now.id[i]]);
      if (cell[1] != here[1] || cell[2] != here[2]) continue;
      from = std::min(from, cell[0]);
      to = std::max(to, cell[0]);
    }
    int most = 0;
    for (int x = from; x <= to; ++x) most = std::max(most, activity(x, here[1], here[2]));
    return most;
  }

  /// A frame of three steps under watch, `harm` between the halves of the first.
  std::optional<Diagnosis> watch(const std::function<void()>& harm) {
    Fluid& fluid = *water_.fluid;
    fluid.begin_watch(3);
    for (int k = 0; k < 3; ++k) {
      const Step step = {kDt, 0.0, 0.0, 0, k == 0};
      fluid.prepare(step);
      if (k == 0) harm();
      fluid.advance(step);
    }
    static_cast<void>(fluid.stats());
    fluid.end_watch();
    const auto found = fluid.health().diagnosis();
    if (!found) fluid.health().accept();
    return found;
  }
};

// Water that moves at one end changes the order of all: who sleeps at the other end keeps what it
// has, wherever the sort puts it.
TEST_P(Resting, WhoeverSleepsKeepsItsNumbersThroughAllSorts) {
  put_to_sleep();
  const Numbers first = numbers();
  Numbers before = first;
  std::vector<bool> sleeps(first.place.size(), true);
  drop_ = 1.0;
  int moved = 0;
  while (height_ > 0.1) {
    frame();
    const Numbers now = numbers();
    const Cells activity = read_cells();
    for (std::size_t id = 0; id < sleeps.size(); ++id) {
      sleeps[id] = sleeps[id] && most_around(activity, before, now, id) == 0;
      if (!sleeps[id]) continue;
      ASSERT_EQ(now.state[id], first.state[id]) << "at a height of " << height_;
      moved += now.place[id] != first.place[id];
    }
    before = now;
  }
  EXPECT_GT(moved, 1000);
  EXPECT_GT(std::count(sleeps.begin(), sleeps.end(), false), 100);
}

TEST_P(Resting, DensityIsKeptUpOneCellFartherThanWaterMoves) {
  put_to_sleep();
  drop_ = 1.0;
  while (water_.fluid->stats().asleep == water_.params.count) frame();
  for (int k = 0; k < 20; ++k) frame();
  const Cells activity = read_cells();
  const auto most_around = [&](int x, int y, int z) {
    int most = 0;
    for (int k = 0; k < 27; ++k)
      most = std::max(most, activity(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1));
    return most;
  };
  int cells[3] = {0, 0, 0};
  for (int z = 0; z < activity.z; ++z) {
    for (int y = 0; y < activity.y; ++y) {
      for (int x = 0; x < activity.x; ++x) {
        ++cells[activity(x, y, z)];
        EXPECT_EQ(activity(x, y, z) > 0, most_around(x, y, z) == 2) << x << ' ' << y << ' ' << z;
      }
    }
  }
  EXPECT_GT(cells[0], 10);
  EXPECT_GT(cells[1], 10);
  EXPECT_GT(cells[2], 10);
}

// Three steps of a frame, the harm after the first: it is seen when the frame ends.
TEST_P(Resting, HarmToSleepersIsSeenBeforeTheFrameEnds) {
  put_to_sleep();
  const auto last = static_cast<std::size_t>(water_.params.count) - 1;
  const Fluid& fluid = *water_.fluid;
  struct Harm {
    Fault fault;
    std::function<void()> done;
  };
  const auto poke = [&](const auto& buffer, auto value) {
    device_.queue().enqueueWriteBuffer(buffer.memory(), CL_TRUE, last * sizeof value, sizeof value,
                                       &value);
  };
  const std::vector<Harm> harms = {
      {Fault::changed, [&] { poke(fluid.particles().velocity, 1.0e-3F); }},
      {Fault::lost, [&] { poke(fluid.particles().id, fluid.particles().id.read(device_, 1)[0]); }},
      {Fault::not_finite, [&] { poke(fluid.density(), std::numeric_limits<float>::infinity()); }}};
  for (const Harm& harm : harms) {
    put_to_sleep();
    const Snapshot sound = water_.fluid->snapshot();
    EXPECT_FALSE(watch([] {}));
    const auto found = watch(harm.done);
    ASSERT_TRUE(found) << describe(harm.fault);
    EXPECT_EQ(found->fault, harm.fault);
    EXPECT_EQ(found->step, 2);
    water_.fluid->restore(sound);
  }
}

// Gauges prepare a step of their own between two frames, which sorts those that moved in the last.
TEST_P(Resting, IsNoHarmThatGaugesSortBetweenFrames) {
  put_to_sleep();
  Fluid& fluid = *water_.fluid;
  drop_ = 1.0;
  int asleep = 0;
  while (height_ > 0.1) {
    fluid.begin_watch(1);
    frame();
    static_cast<void>(fluid.stats());
    asleep += fluid.stats().asleep;
    const auto found = fluid.health().diagnosis();
    ASSERT_FALSE(found) << describe(found->fault) << " at a height of " << height_;
    fluid.health().accept();
    fluid.set_bodies(water_.bodies->at(water_.time));
    fluid.prepare({0.0, 0.0, 0.0, 0, false});
  }
  fluid.end_watch();
  EXPECT_GT(asleep, 1000);
}

INSTANTIATE_TEST_SUITE_P(Builds, Resting, kScalarAndVector, lanes_name);

}  // namespace
}  // namespace splash::sim
