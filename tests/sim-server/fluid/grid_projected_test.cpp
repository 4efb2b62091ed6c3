// SPDX-License-Identifier: MIT
// The grid-projected solver: each stage of a step against its reference implementation, still water
// that stays still, and waves that last.
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <type_traits>

#include "sim-server/fluid/health/health.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/grid_projected_reference.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr double kStep = 4.0e-3;  ///< [s]

class GridProjectedReference : public ::testing::TestWithParam<int> {};

/// Water in a tank that no whole number of cells fills.
Water odd_tank() {
  Scene scene = tank_scene(0.02, {0.17, 0.09, 0.3}, 0.11);
  scene.fluid.viscosity = 1.0e-3;
  return fill(scene, PressureKind::grid_projected);
}

MacFaces read_faces(Device& device, const GridProjected& solver, const Buffer<float>& buffer) {
  const auto cells = static_cast<std::size_t>(solver.fields().grid.level[0].cells);
  const std::vector<double> all = read_numbers(device, buffer, 3 * cells);
  MacFaces faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(axis * cells);
    faces[axis].assign(first, first + static_cast<std::ptrdiff_t>(cells));
  }
  return faces;
}

/// The largest difference.
template <class Part>
double apart(const Part& a, const Part& b) {
  if constexpr (std::is_arithmetic_v<Part>) {
    return static_cast<double>(std::abs(a - b));
  } else if constexpr (std::is_same_v<Part, Vector3>) {
    return length(a - b);
  } else {
    double most = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) most = std::max(most, apart(a[i], b[i]));
    return most;
  }
}

/// After so many steps.
void expect_twin(Device& device, int steps, bool spaces) {
  Water water = odd_tank();
  water.start(device, {});
  water.stir(0.3, 7);
  for (int k = 0; k < steps; ++k) water.step(kStep);
  FluidState before;
  water.step(kStep, [&](Fluid& fluid) {
    before = read_state(fluid);
    EXPECT_EQ(fluid.solver().needs_density(), spaces);
  });
  const GridProjected& solver = solver_of(*water.fluid);
  const FluidParams& p = before.params;
  const std::size_t count = before.id.size();
  const MacReference reference(solver.fields().grid);

  ReferenceGathered gathered = reference.gather(before.position, before.velocity);
  const auto cells = static_cast<std::size_t>(solver.fields().grid.level[0].cells);
  EXPECT_LT(apart(read_faces(device, solver, solver.fields().mean), gathered.mean), 1.0e-5);
  EXPECT_LT(apart(read_faces(device, solver, solver.fields().weight), gathered.weight), 2.0e-4);
  EXPECT_LT(apart(read_numbers(device, solver.solids().fill(), cells), gathered.fill), 1.0e-4);
  EXPECT_GT(*std::max_element(gathered.fill.begin(), gathered.fill.end()), 0.9);

  MacFaces everywhere = gathered.weight;
  for (MacField& field : everywhere) std::fill(field.begin(), field.end(), 1.0);
  const auto unseen = [&](const std::vector<Vector3>& values, const MacFaces& mean) {
    std::vector<Vector3> left = values;
    for (std::size_t i = 0; i < count; ++i) {
      left[i] = left[i] - reference.at(before.position[i], mean, everywhere, {});
    }
    return left;
  };
  const std::vector<Vector3> deviation = unseen(before.velocity, gathered.mean);
  EXPECT_LT(apart(read_vectors(device, solver.deviation(), p.capacity, count), deviation), 1.0e-5);
  const ReferenceGathered seen = reference.gather(before.position, deviation);
  EXPECT_LT(apart(read_faces(device, solver, solver.seen()), seen.mean), 1.0e-5);
  const std::vector<Vector3> twice = unseen(deviation, seen.mean);

  const std::vector<double> pressure = read_numbers(device, solver.fields().pressure, cells);
  const MacFaces change = reference.change(gathered, p, pressure, kStep);
  const MacFaces shared = reference.shared(gathered, change);
  const MacFaces changed = read_faces(device, solver, solver.fields().change);
  const MacFaces known = reference.known(gathered);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < cells; ++c) {
      if (known[axis][c] > 0.0) {
        ASSERT_NEAR(changed[axis][c], shared[axis][c], 2.0e-5) << axis << ' ' << c;
      } else {
        ASSERT_TRUE(changed[axis][c] == 0.0 || changed[axis][c] > 1.0e29) << axis << ' ' << c;
      }
    }
  }
  const MacFaces carries = reference.sharpened(gathered, everywhere, gathered.mean);
  const MacFaces gained = reference.sharpened(gathered, known, shared);
  MacFaces still = carries, after_step = carries;
  MacFaces pushed = reference.change(gathered, p, MacField(cells, 0.0), kStep);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < cells; ++c) {
      still[axis][c] += change[axis][c];
      after_step[axis][c] += shared[axis][c];
      pushed[axis][c] += carries[axis][c];
    }
  }
  double left = 0.0;
  double asked = 0.0;
  for (const double rate : reference.left(gathered, still)) left += rate * rate;
  for (const double rate : reference.left(gathered, pushed)) asked += rate * rate;
  EXPECT_GT(asked, 1.0);
  EXPECT_LT(std::sqrt(left / asked), 2.0e-4);

  // Spacing: the state equation's pressures of water with slow sound.
  FluidState spacing = before;
  const double slow = kSpacingWay * static_cast<double>(p.support) / kStep;
  const double spacings = spaces ? kSpacingSteps : 0.0;
  spacing.params.gravity_x = spacing.params.gravity_y = spacing.params.gravity_z = 0.0F;
  spacing.params.viscous = spacing.params.artificial = 0.0F;
  spacing.params.sound_speed = static_cast<float>(slow);
  for (std::size_t i = 0; i < count; ++i) {
    spacing.pressure_term[i] =
        reference_pressure_term(spacing.params, before.density[i], before.peak_density[i]);
  }
  std::vector<ReferenceAcceleration> push = reference_acceleration(spacing);
  for (ReferenceAcceleration& of : push) of.value = spacings * of.value;
  const double filtered = 1.0 - std::exp(-filter_rate(0.02) * kStep);
  const std::vector<Vector3> places = places_of(*water.fluid);
  const std::vector<Vector3> velocities = velocities_of(*water.fluid);
  double worst_speed = 0.0;
  double worst_place = 0.0;
  int walls = 0;
  int looked = 0;  // velocities that were taken half a step ahead
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 gain = reference.at(before.position[i], gained, known, {0.0, 0.0, -9.81 * kStep});
    const Vector3 v = before.velocity[i] + gain;
    const Vector3 ahead = before.position[i] + (0.5 * kStep) * (v - deviation[i]);
    Vector3 carried = v - deviation[i];
    const Vector3 share = reference.at(before.position[i], known, everywhere, {0.0, 0.0, 0.0});
    const Vector3 share_ahead = reference.at(ahead, known, everywhere, {0.0, 0.0, 0.0});
    const Vector3 there = reference.at(ahead, after_step, everywhere, {0.0, 0.0, 0.0});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::min(share[axis], share_ahead[axis]) < 0.999) continue;
      carried[axis] = there[axis];
      ++looked;
    }
    const Vector3 way = kStep * carried + (kStep * kStep) * push[i].value;
    const Vector3 place = before.position[i] + way;
    const double off = 0.002;
    const bool stopped = place[0] < off || place[0] > 0.17 - off || place[1] < off ||
                         place[1] > 0.09 - off || place[2] < off;
    walls += stopped;
    if (stopped) continue;
    const Vector3 speed = v - filtered * twice[i] + (kSpacingKick * kStep) * push[i].value;
    const auto id = static_cast<std::size_t>(before.id[i]);
    worst_place = std::max(worst_place, length(places[id] - place));
    worst_speed = std::max(worst_speed, length(velocities[id] - speed));
  }
  EXPECT_LT(walls, static_cast<int>(count) / 4);
  EXPECT_GT(looked, static_cast<int>(count));
  EXPECT_LT(worst_speed, 1.0e-4);
  EXPECT_LT(worst_place, 1.0e-7);
}

TEST_P(GridProjectedReference, StepsAsTheTwinDoes) {
  Device device(-1, false, GetParam());
  expect_twin(device, 3, false);
  expect_twin(device, 4, true);
}

INSTANTIATE_TEST_SUITE_P(Builds, GridProjectedReference, kScalarAndVector, lanes_name);

/// How far cells are from holding their volume, beyond the twentieth that moves nothing.
double asked_of(double fill) {
  const double excess = fill - 1.0;
  return std::copysign(std::max(std::abs(excess) - 0.05, 0.0), excess);
}

/// Water in a tank without gravity, by `part` of its height.
Water pressed_together(double part) {
  Scene scene = tank_scene(0.02, {0.4, 0.2, 0.6}, 0.3);
  scene.fluid.gravity = {0.0, 0.0, 0.0};
  Water water = fill(scene, PressureKind::grid_projected);
  for (Vector3& place : water.particles) place[2] *= part;
  return water;
}

TEST_P(GridProjectedReference, CellsAskForTheRoomThatTheyLack) {
  Device device(-1, false, GetParam());
  for (const double part : {0.85, 1.15}) {
    Water water = pressed_together(part);
    water.start(device);
    water.step(1.0e-2);
    const GridProjected& solver = solver_of(*water.fluid);
    const MacGrid& g = solver.fields().grid;
    const MacLevel& l = g.level[0];
    const auto cells = static_cast<std::size_t>(l.cells);
    const std::vector<double> fill = read_numbers(device, solver.solids().fill(), cells);
    const MacFaces shift = read_faces(device, solver, solver.crowding().shift());
    const std::array<double, 3> inverse = {static_cast<double>(g.ix), static_cast<double>(g.iy),
                                           static_cast<double>(g.iz)};
    const std::array<std::size_t, 3> step = {1, static_cast<std::size_t>(l.row),
                                             static_cast<std::size_t>(l.layer)};
    int looked_at = 0;
    for (int z = 0; z < 5; ++z) {  // the surface is in the seventh layer or higher
      for (int y = 0; y < l.ny; ++y) {
        for (int x = 0; x < l.nx; ++x) {
          const int number = (z + 1) * l.layer + (y + 1) * l.row + x + 1;
          const auto c = static_cast<std::size_t>(number);
          double growth = 0.0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            growth += inverse[axis] * (shift[axis][c + step[axis]] - shift[axis][c]);
          }
          const double asked = asked_of(fill[c]);
          EXPECT_GT(std::abs(asked), 0.05) << part;
          ASSERT_NEAR(1.0e-2 * growth, asked, 0.1 * std::abs(asked)) << x << ' ' << y << ' ' << z;
          ++looked_at;
        }
      }
    }
    EXPECT_EQ(looked_at, 5 * l.nx * l.ny);
  }
}

TEST(GridProjected, CrowdedWaterTakesItsVolumeAgainAndNoSpeed) {
  Device device;
  Water water = pressed_together(0.85);
  water.start(device);
  for (int k = 0; k < 5; ++k) water.step(1.0e-2);
  const FluidState state = read_state(*water.fluid);
  double highest = 0.0;
  double fastest = 0.0;
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    highest = std::max(highest, state.position[i][2]);
    fastest = std::max(fastest, length(state.velocity[i]));
  }
  std::printf("highest %.4f m, fastest %.4f m/s\n", highest, fastest);
  EXPECT_GT(highest, 0.95 * 0.29);
  EXPECT_LT(fastest, 0.01);
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
    EXPECT_EQ(water.fluid->stats().not_finite, 0);
  }
  ASSERT_EQ(ends[0].id, ends[1].id);
  EXPECT_LT(apart(ends[0].velocity, ends[1].velocity), 1.0e-4);
}

TEST(GridProjected, StillWaterStaysStillAndWeighsWhatItShould) {
  Device device;
  const double depth = 0.3;
  Water water = fill(tank_scene(0.03, {0.3, 0.3, 0.5}, depth), PressureKind::grid_projected);
  start_at_rest(device, water);
  for (int k = 0; k < 200; ++k) water.step(1.0e-2);
  const double wave = std::sqrt(9.81 * depth);
  EXPECT_LT(water.fluid->stats().speed, 0.002 * wave);
  // From below, as pressure gauges read it: the grid's lowest cells, carried to the floor.
  const MacGrid& grid = solver_of(*water.fluid).fields().grid;
  const auto cells = static_cast<std::size_t>(grid.level[0].cells);
  const std::vector<double> pressure =
      read_numbers(device, solver_of(*water.fluid).fields().pressure, cells);
  const MacReference reference(grid);
  double sum = 0.0;
  for (int j = 0; j < grid.level[0].ny; ++j) {
    for (int i = 0; i < grid.level[0].nx; ++i) {
      sum +=
          pressure[reference.number({i, j, 0})] + 998.0 * 9.81 * 0.5 * static_cast<double>(grid.hz);
    }
  }
  const double floor = sum / (grid.level[0].nx * grid.level[0].ny);
  EXPECT_NEAR(floor / (998.0 * 9.81 * depth), 1.0, 0.005);
  const SolveWork work = water.fluid->solver_work();
  EXPECT_EQ(work.given_up, 0);
}

/// Health says what is wrong, and from the last sound state the water goes on as if nothing had
/// been: the solve keeps nothing of the step that went wrong.
TEST(GridProjected, GoesOnFromASoundStateAsIfNothingHadBeen) {
  Device device;
  Water water = odd_tank();
  water.start(device);
  water.stir(0.3, 5);
  const auto watched = [&](const std::function<void()>& meanwhile) {
    water.fluid->begin_watch(1);
    water.fluid->set_bodies({});
    water.fluid->prepare(water.step_at(kStep));
    meanwhile();
    water.fluid->advance(water.step_at(kStep));
    static_cast<void>(water.fluid->stats());
    return water.fluid->health().diagnosis();
  };
  const auto sound = [&] {
    EXPECT_FALSE(watched([] {}).has_value());
    water.fluid->health().accept();
  };
  for (int k = 0; k < 3 * kSpacingSteps; ++k) sound();  // after a recall the next step spaces
  Checkpoint checkpoint;
  checkpoint.keep(device, water.fluid->state());
  for (int k = 0; k < 3; ++k) sound();
  const Snapshot straight = water.fluid->snapshot();

  checkpoint.recall(device, water.fluid->state());
  water.fluid->note_recalled();
  water.fluid->health().forget();
  const auto wrong = watched([&] {
    Buffer<float> velocity = water.fluid->particles().velocity;
    const std::vector<float> none = {std::numeric_limits<float>::quiet_NaN()};
    velocity.write(device, none, 40);
  });
  ASSERT_TRUE(wrong.has_value());
  EXPECT_EQ(wrong->fault, Fault::not_finite);

  checkpoint.recall(device, water.fluid->state());
  water.fluid->note_recalled();
  water.fluid->health().forget();
  for (int k = 0; k < 3; ++k) sound();
  const Snapshot again = water.fluid->snapshot();
  EXPECT_EQ(straight.position, again.position);
  EXPECT_EQ(straight.velocity, again.velocity);
}

/// A drop flies freely until it touches the dry floor or a dry wall, half a spacing off, and goes
/// no farther.
TEST(GridProjected, ALoneDropFliesUntilItTouches) {
  Device device;
  constexpr double kRadius = 0.01;  // half a spacing [m]
  constexpr double kTowards = 0.5;  // to the wall at x = 0 [m/s]
  const std::vector<std::vector<Vector3>> drops = {
      {{0.13, 0.2, 0.17}},
      {{0.13, 0.2, 0.17}, {0.15, 0.2, 0.17}, {0.13, 0.22, 0.17}, {0.15, 0.22, 0.17}}};
  for (const std::vector<Vector3>& drop : drops) {
    Water water = fill(tank_scene(0.02, {0.4, 0.4, 0.4}, 0.2), PressureKind::grid_projected);
    water.settle = false;
    water.particles = drop;
    water.start(device);
    change_particles(*water.fluid,
                     [](int, Vector3&, Vector3& velocity) { velocity[0] = -kTowards; });
    for (int k = 1; k <= 100; ++k) {
      water.step(kStep);
      const std::vector<Vector3> places = places_of(*water.fluid);
      const std::vector<Vector3> velocities = velocities_of(*water.fluid);
      for (std::size_t i = 0; i < drop.size(); ++i) {
        const Vector3& from = drop[i];
        const Vector3& x = places[i];
        const Vector3& v = velocities[i];
        const double fall = 0.5 * 9.81 * kStep * kStep * k * (k + 1);
        const bool down = from[2] - fall < kRadius;
        EXPECT_NEAR(x[2], down ? kRadius : from[2] - fall, 1.0e-5) << k;
        EXPECT_NEAR(v[2], down ? 0.0 : -9.81 * kStep * k, 1.0e-4) << k;
        const bool beside = drop[0][0] - kTowards * kStep * k < kRadius;  // the first of it
        if (!beside) {
          EXPECT_NEAR(v[0], -kTowards, 1.0e-5) << k;
        }
        EXPECT_GE(x[0], kRadius - 1.0e-5) << k;
      }
    }
  }
}

/// The first sloshing mode of a tank 1 m long, half a metre deep, on ten layers.
TEST(GridProjected, AWaveLasts) {
  Device device;
  constexpr double kDepth = 0.5;
  constexpr double kNumber = std::numbers::pi;
  const double omega = std::sqrt(9.81 * kNumber * std::tanh(kNumber * kDepth));
  Water water = fill(tank_scene(0.05, {1.0, 0.1, 1.0}, kDepth), PressureKind::grid_projected);
  start_at_rest(device, water);
  const double c = 0.025 * omega / std::sinh(kNumber * kDepth);
  change_particles(*water.fluid, [c](int, Vector3& x, Vector3& v) {
    v[0] = -c * std::cosh(kNumber * x[2]) * std::sin(kNumber * x[0]);
    v[2] = c * std::sinh(kNumber * x[2]) * std::cos(kNumber * x[0]);
  });
  // Amplitudes of the mode between its zero crossings.
  const auto mode = [&] {
    double sum = 0.0;
    for (const Vector3& x : places_of(*water.fluid)) sum += std::cos(kNumber * x[0]);
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
