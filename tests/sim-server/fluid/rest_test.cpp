// SPDX-License-Identifier: MIT
// What a step passes over stays as it is, is known by its cells, and is looked at once a frame.
#include <array>
#include <functional>
#include <limits>
#include <optional>

#include "tests/sim-server/fluid/sleeping.hpp"

namespace splash::sim {
namespace {

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
