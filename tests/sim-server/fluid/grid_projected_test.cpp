// SPDX-License-Identifier: MIT
// The grid-projected solver: each stage of a step against its twin, the same bits twice, still
// water that stays still, and waves that last.
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/grid_projected_twin.hpp"
#include "tests/sim-server/fluid/lane_settings.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr double kStep = 4.0e-3;  ///< [s]

class GridProjectedTwin : public ::testing::TestWithParam<Build> {};

const GridProjected& solver_of(const Water& water) {
  return dynamic_cast<const GridProjected&>(water.fluid->solver());
}

/// Water in a tank that no whole number of cells fills.
Water odd_tank() {
  Scene scene = tank_scene(0.02, {0.17, 0.09, 0.3}, 0.11);
  scene.fluid.viscosity = 1.0e-3;
  return fill(scene, PressureKind::grid_projected);
}

std::vector<double> read(Device& device, const Buffer<float>& buffer, std::size_t first,
                         std::size_t count) {
  std::vector<float> values(count);
  buffer.read(device, values, first);
  return {values.begin(), values.end()};
}

std::vector<Vector3> read_vectors(Device& device, const Buffer<float>& buffer, std::size_t stride,
                                  std::size_t count) {
  std::vector<Vector3> vectors(count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> part = read(device, buffer, axis * stride, count);
    for (std::size_t i = 0; i < count; ++i) vectors[i][axis] = part[i];
  }
  return vectors;
}

MacFaces read_faces(Device& device, const GridProjected& solver, const Buffer<float>& buffer) {
  const auto cells = static_cast<std::size_t>(solver.grid().level[0].cells);
  return {read(device, buffer, 0, cells), read(device, buffer, cells, cells),
          read(device, buffer, 2 * cells, cells)};
}

/// The largest difference.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

double apart(const MacFaces& a, const MacFaces& b) {
  return std::max({apart(a[0], b[0]), apart(a[1], b[1]), apart(a[2], b[2])});
}

double apart(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) most = std::max(most, length(a[i] - b[i]));
  return most;
}

TEST_P(GridProjectedTwin, StepsAsTheTwinDoes) {
  Device device(-1, false, GetParam().lanes);
  Water water = odd_tank();
  water.start(device, {});
  water.stir(0.3, 7);
  for (int k = 0; k < 3; ++k) water.step(kStep);
  FluidState before;
  water.step(kStep, [&](Fluid& fluid) { before = read_state(fluid); });
  const GridProjected& solver = solver_of(water);
  const FluidParams& p = before.params;
  const std::size_t count = before.id.size();
  const auto stride = static_cast<std::size_t>(p.capacity);
  const MacTwin twin(solver.grid());

  TwinGathered gathered = twin.gather(before.position, before.velocity);
  const auto cells = static_cast<std::size_t>(solver.grid().level[0].cells);
  EXPECT_LT(apart(read_faces(device, solver, solver.mean()), gathered.mean), 1.0e-5);
  EXPECT_LT(apart(read_faces(device, solver, solver.weight()), gathered.weight), 2.0e-4);
  EXPECT_LT(apart(read(device, solver.fill(), 0, cells), gathered.fill), 1.0e-4);
  EXPECT_GT(*std::max_element(gathered.fill.begin(), gathered.fill.end()), 0.9);

  MacFaces everywhere = gathered.weight;
  for (MacField& field : everywhere) std::fill(field.begin(), field.end(), 1.0);
  std::vector<Vector3> deviation = before.velocity;
  const auto unseen = [&](const std::vector<Vector3>& values, const MacFaces& mean) {
    std::vector<Vector3> left = values;
    for (std::size_t i = 0; i < count; ++i) {
      left[i] = left[i] - twin.at(before.position[i], mean, everywhere, {0.0, 0.0, 0.0});
    }
    return left;
  };
  deviation = unseen(before.velocity, gathered.mean);
  EXPECT_LT(apart(read_vectors(device, solver.deviation(), stride, count), deviation), 1.0e-5);
  const TwinGathered seen = twin.gather(before.position, deviation);
  EXPECT_LT(apart(read_faces(device, solver, solver.seen()), seen.mean), 1.0e-5);
  const std::vector<Vector3> twice = unseen(deviation, seen.mean);

  const std::vector<double> pressure = read(device, solver.pressures(), 0, cells);
  const MacFaces change = twin.change(gathered, p, pressure, kStep);
  const MacFaces changed = read_faces(device, solver, solver.change());
  EXPECT_LT(apart(changed, change), 2.0e-5);
  MacFaces still = gathered.mean;
  MacFaces pushed = twin.change(gathered, p, MacField(cells, 0.0), kStep);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < cells; ++c) {
      still[axis][c] += change[axis][c];
      pushed[axis][c] += gathered.mean[axis][c];
    }
  }
  double left = 0.0;
  double asked = 0.0;
  for (const double rate : twin.left(gathered, still)) left += rate * rate;
  for (const double rate : twin.left(gathered, pushed)) asked += rate * rate;
  EXPECT_GT(asked, 1.0);
  EXPECT_LT(std::sqrt(left / asked), 2.0e-4);

  // Spacing: the state equation's pressures of water with sound of 0.4 H a step.
  FluidState spacing = before;
  const double slow = 0.4 * static_cast<double>(p.support) / kStep;
  spacing.params.gravity_x = spacing.params.gravity_y = spacing.params.gravity_z = 0.0F;
  spacing.params.viscous = spacing.params.artificial = 0.0F;
  spacing.params.sound_speed = static_cast<float>(slow);
  for (std::size_t i = 0; i < count; ++i) {
    spacing.pressure_term[i] =
        twin_pressure_term(spacing.params, before.density[i], before.knit[i]);
  }
  const std::vector<TwinAcceleration> push = twin_acceleration(spacing);
  const MacFaces known = twin.known(gathered);
  const double filtered = 1.0 - std::exp(-filter_rate(0.02) * kStep);
  const Snapshot after = water.fluid->snapshot();
  double worst_speed = 0.0;
  double worst_place = 0.0;
  int walls = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 gain = twin.at(before.position[i], change, known, {0.0, 0.0, -9.81 * kStep});
    const Vector3 v = before.velocity[i] + gain;
    const Vector3 way = kStep * (v - deviation[i]) + (kStep * kStep) * push[i].value;
    const Vector3 place = before.position[i] + way;
    const double off = 0.002;
    const bool stopped = place[0] < off || place[0] > 0.17 - off || place[1] < off ||
                         place[1] > 0.09 - off || place[2] < off;
    walls += stopped;
    if (stopped) continue;
    const Vector3 speed = v - filtered * twice[i] + (0.05 * kStep) * push[i].value;
    worst_place = std::max(worst_place, length(vector_of(*water.fluid, after.position, i) - place));
    worst_speed = std::max(worst_speed, length(vector_of(*water.fluid, after.velocity, i) - speed));
  }
  EXPECT_LT(walls, static_cast<int>(count) / 4);
  EXPECT_LT(worst_speed, 1.0e-4);
  EXPECT_LT(worst_place, 1.0e-6);
}

INSTANTIATE_TEST_SUITE_P(Builds, GridProjectedTwin, kBuilds, build_name);

TEST(GridProjected, GivesTheSameBitsTwice) {
  Device device;
  std::vector<Snapshot> ends;
  for (int run = 0; run < 2; ++run) {
    Water water = odd_tank();
    water.start(device);
    water.stir(0.5, 3);
    for (int k = 0; k < 20; ++k) water.step(kStep);
    ends.push_back(water.fluid->snapshot());
  }
  EXPECT_EQ(ends[0].position, ends[1].position);
  EXPECT_EQ(ends[0].velocity, ends[1].velocity);
  EXPECT_EQ(ends[0].id, ends[1].id);
}

/// Many work-items solve together what one does, up to rounding.
TEST(GridProjected, StepsOnADeviceOfManyWorkItemsAsOnACpu) {
  std::vector<Snapshot> ends;
  for (const bool many : {false, true}) {
    Device device(-1, false, many ? gpu_profile() : cpu_profile(2));
    Water water = odd_tank();
    water.start(device);
    water.stir(0.3, 3);
    for (int k = 0; k < 3; ++k) water.step(kStep);
    ends.push_back(water.fluid->snapshot());
    EXPECT_EQ(water.fluid->survey().not_finite, 0);
  }
  ASSERT_EQ(ends[0].id, ends[1].id);
  double worst = 0.0;
  for (std::size_t i = 0; i < ends[0].velocity.size(); ++i) {
    worst =
        std::max(worst, static_cast<double>(std::abs(ends[0].velocity[i] - ends[1].velocity[i])));
  }
  EXPECT_LT(worst, 5.0e-4);
}

TEST(GridProjected, StillWaterStaysStillAndWeighsWhatItShould) {
  Device device;
  const double depth = 0.3;
  Water water = fill(tank_scene(0.03, {0.3, 0.3, 0.5}, depth), PressureKind::grid_projected);
  water.start(device);
  let_settle(water);
  for (int k = 0; k < 200; ++k) water.step(1.0e-2);
  const double wave = std::sqrt(9.81 * depth);
  EXPECT_LT(water.fluid->survey().speed, 0.002 * wave);
  // From below, as pressure gauges read it: the grid's lowest cells, carried to the floor.
  const MacGrid& grid = solver_of(water).grid();
  const auto cells = static_cast<std::size_t>(grid.level[0].cells);
  const std::vector<double> pressure = read(device, solver_of(water).pressures(), 0, cells);
  const MacTwin twin(grid);
  double sum = 0.0;
  for (int j = 0; j < grid.level[0].ny; ++j) {
    for (int i = 0; i < grid.level[0].nx; ++i) {
      sum += pressure[static_cast<std::size_t>(twin.number(i, j, 0))] +
             998.0 * 9.81 * 0.5 * static_cast<double>(grid.hz);
    }
  }
  const double floor = sum / (grid.level[0].nx * grid.level[0].ny);
  EXPECT_NEAR(floor / (998.0 * 9.81 * depth), 1.0, 0.005);
  const SolveWork work = water.fluid->solver_work().density;
  EXPECT_EQ(work.given_up, 0);
}

/// The first sloshing mode of a tank 1 m long, half a metre deep, on ten layers.
TEST(GridProjected, AWaveLasts) {
  Device device;
  constexpr double kDepth = 0.5;
  constexpr double kNumber = std::numbers::pi;
  const double omega = std::sqrt(9.81 * kNumber * std::tanh(kNumber * kDepth));
  Water water = fill(tank_scene(0.05, {1.0, 0.1, 1.0}, kDepth), PressureKind::grid_projected);
  water.start(device);
  let_settle(water);
  Snapshot state = water.fluid->snapshot();
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    const Vector3 x = vector_of(*water.fluid, state.position, i);
    const double c = 0.025 * omega / std::sinh(kNumber * kDepth);
    state.velocity[part(*water.fluid, 0, i)] =
        static_cast<float>(-c * std::cosh(kNumber * x[2]) * std::sin(kNumber * x[0]));
    state.velocity[part(*water.fluid, 2, i)] =
        static_cast<float>(c * std::sinh(kNumber * x[2]) * std::cos(kNumber * x[0]));
  }
  water.fluid->restore(state);
  // Amplitudes of the mode between its zero crossings.
  const auto mode = [&] {
    const Snapshot now = water.fluid->snapshot();
    double sum = 0.0;
    for (std::size_t i = 0; i < now.id.size(); ++i) {
      sum += std::cos(kNumber * vector_of(*water.fluid, now.position, i)[0]);
    }
    return 2.0 * sum * std::pow(0.05, 3) / 0.1;
  };
  const double level = mode();
  std::vector<double> crests;
  double most = 0.0;
  double last = 0.0;
  for (int k = 0; k < 500; ++k) {
    water.step(1.0e-2);
    const double now = mode() - level;
    if (last * now < 0.0) {
      if (most > 0.0) crests.push_back(most);
      most = 0.0;
    }
    most = std::max(most, std::abs(now));
    last = now;
  }
  ASSERT_GE(crests.size(), 7U);
  const double half = std::numbers::pi / omega;
  const double rate =
      std::log(crests.front() / crests.back()) / (half * static_cast<double>(crests.size() - 1));
  const double viscosity = rate / (2.0 * kNumber * kNumber);
  std::printf("first crest %.3f of A, viscosity %.5f m2/s, %zu crests\n", crests.front() / 0.025,
              viscosity, crests.size());
  EXPECT_GT(crests.front(), 0.94 * 0.025);
  EXPECT_LT(viscosity, 0.004);  // the state equation's: 0.02
  EXPECT_NEAR(static_cast<double>(crests.size()), 5.0 / half - 1.0, 1.0);
}

}  // namespace
}  // namespace splash::sim
