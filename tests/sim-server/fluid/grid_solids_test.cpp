// SPDX-License-Identifier: MIT
// Solids in the grid-projected water: what they displace is their volume, free bodies begin to move
// as their added mass says and float as Archimedes says, and what lies on the floor is borne, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <numeric>

#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/start/settle.hpp"
#include "tests/sim-server/fluid/free_float.hpp"
#include "tests/sim-server/fluid/grid_projected_reference.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr double kGravity = 9.81;
constexpr double kDensity = 998.0;

/// A body that stays where it is.
Water with_solid(double spacing, const Vector3& tank, double depth, const Shape& shape,
                 const BodyState& place) {
  Scene scene = tank_scene(spacing, tank, depth);
  scene.fluid.solver = PressureKind::grid_projected;
  scene.bodies = {body_of("solid", shape, place)};
  Water water = {.scene = scene, .particles = initial_particles(scene)};
  water.motions = {[place](double) { return place; }};
  return water;
}

/// Away from bodies every second step finds densities and spaces the particles, for both; beside
/// them each step does, for itself.
TEST(GridSpacing, IsLessOftenAwayFromBodies) {
  Device device;
  constexpr double kSide = 0.06;
  const Vector3 middle = {0.08, 0.08, 0.06};
  Water water =
      with_solid(0.02, {0.6, 0.16, 0.3}, 0.12, {ShapeKind::box, {kSide, kSide, kSide}}, {middle});
  water.start(device);
  water.stir(0.1, 3);
  Fluid& fluid = *water.fluid;
  std::map<int, double> last;  // densities by id
  for (int k = 0; k < 6; ++k) {
    const Step step = water.step_at(0.005);
    fluid.set_bodies(water.bodies->at(water.time));
    fluid.prepare(step);
    const bool everywhere = fluid.solver().needs_density();
    EXPECT_EQ(everywhere, k % kSpacingSteps == 0);
    FluidState state = read_state(fluid);
    fluid.accelerate(step);
    const std::vector<Vector3> push = read_acceleration(fluid);
    const std::vector<double> density = reference_density(state);
    FluidParams& p = state.params;
    p.gravity_x = p.gravity_y = p.gravity_z = p.viscous = p.artificial = 0.0F;
    p.sound_speed = static_cast<float>(kSpacingWay * static_cast<double>(p.support) / step.dt);
    for (std::size_t i = 0; i < push.size(); ++i) {
      state.pressure_term[i] = reference_pressure_term(p, state.density[i], state.peak_density[i]);
    }
    const std::vector<ReferenceAcceleration> expected = reference_acceleration(state);
    int beside = 0;
    int away = 0;
    for (std::size_t i = 0; i < push.size(); ++i) {
      double gap = 0.0;  // to the body
      for (std::size_t axis = 0; axis < 3; ++axis) {
        gap = std::max(gap, std::abs(state.position[i][axis] - middle[axis]) - 0.5 * kSide);
      }
      const bool is_beside = gap < static_cast<double>(p.support - p.spacing);
      if (!is_beside && gap < static_cast<double>(p.support)) continue;
      ++(is_beside ? beside : away);
      const double times = is_beside ? 1.0 : everywhere ? kSpacingSteps : 0.0;
      const Vector3 off = push[i] - times * expected[i].value;
      ASSERT_LT(length(off), 1.0e-4 * (1.0 + expected[i].scale)) << k << ' ' << gap;
      const double known = is_beside || everywhere ? density[i] : last.at(state.id[i]);
      ASSERT_NEAR(state.density[i], known, 0.01) << k << ' ' << gap;
    }
    EXPECT_GT(beside, 100);
    EXPECT_GT(away, 100);
    for (std::size_t i = 0; i < push.size(); ++i) last[state.id[i]] = state.density[i];
    fluid.move(step);
    fluid.device().queue().finish();
    water.time += step.dt;
  }
}

/// What the faces along each axis, and the cells, say of the volume of the solids in them [m3].
struct Displaced {
  Vector3 by_faces = {0.0, 0.0, 0.0};
  double by_cells = 0.0;
  double borne = 0.0;  ///< what pressures push them up with [N]
  double aside = 0.0;  ///< and along x [N]
};

Displaced displaced(Device& device, const Fluid& fluid) {
  const GridProjected& solver = solver_of(fluid);
  const MacGrid& grid = solver.fields().grid;
  const MacLevel& level = grid.level[0];
  const MacReference reference(grid);
  const auto cells = static_cast<std::size_t>(level.cells);
  const std::vector<double> gap = read_numbers(device, solver.solids().gap(), 3 * cells);
  const std::vector<double> excess = read_numbers(device, solver.solids().excess(), 3 * cells);
  const std::vector<double> space = read_numbers(device, solver.solids().space(), cells);
  const std::vector<double> pressure = read_numbers(device, solver.fields().pressure, cells);
  const double area = static_cast<double>(grid.hx) * static_cast<double>(grid.hy);
  const double volume = area * static_cast<double>(grid.hz);
  const std::array<int, 3> step = {1, level.row, level.layer};
  Displaced sum;
  for (int k = 0; k < level.nz; ++k) {
    for (int j = 0; j < level.ny; ++j) {
      for (int i = 0; i < level.nx; ++i) {
        const std::size_t c = reference.number({i, j, k});
        sum.by_cells += volume * (1.0 - space[c]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          sum.by_faces[axis] += volume * (1.0 - gap[axis * cells + c] - excess[axis * cells + c]);
        }
        const double low = gap[2 * cells + c];
        const double high = gap[2 * cells + c + static_cast<std::size_t>(step[2])];
        sum.borne += area * pressure[c] * (low - high);
        sum.aside += static_cast<double>(grid.hy) * static_cast<double>(grid.hz) * pressure[c] *
                     (gap[c] - gap[c + 1]);
        sum.borne -= volume * excess[2 * cells + c] * kDensity * kGravity;
      }
    }
  }
  return sum;
}

TEST(GridSolids, DisplaceTheirVolume) {
  Device device;
  const Vector3 tank = {0.3, 0.3, 0.3};
  const Vector3 middle = {0.161, 0.147, 0.142};
  const Quaternion askew = from_turn({0.4, -0.7, 0.3});
  const Shape ball = {ShapeKind::sphere, {0.12, 0.12, 0.12}};
  const Shape box = {ShapeKind::box, {0.13, 0.09, 0.07}};
  const auto expect = [&](const Shape& shape, const Quaternion& turn, double volume,
                          double within) {
    Water water = with_solid(0.015, tank, 0.27, shape, {middle, turn});
    water.start(device);
    water.step(1.0e-3);
    const Displaced by = displaced(device, *water.fluid);
    for (const double of_faces : by.by_faces) EXPECT_NEAR(of_faces / volume, 1.0, within);
    EXPECT_NEAR(by.by_cells / volume, 1.0, within);
  };
  expect(ball, {0.0, 0.0, 0.0, 1.0}, std::numbers::pi * std::pow(0.12, 3) / 6.0, 0.02);
  expect(box, {0.0, 0.0, 0.0, 1.0}, 0.13 * 0.09 * 0.07, 0.03);
  expect(box, askew, 0.13 * 0.09 * 0.07, 0.03);
}

/// On the floor, too, near it or on it: there is water beneath. Of a post that goes through the
/// floor only the sides are wet, and nothing bears it.
TEST(GridSolids, AreBorneByTheWeightOfWhatTheyDisplace) {
  Device device;
  const auto expect = [&](const Shape& shape, double height, double displaces, double within) {
    Water water = with_solid(0.015, {0.3, 0.3, 0.5}, 0.3, shape, {{0.161, 0.147, height}});
    water.start(device);
    settle(*water.fluid, water.bodies->at(0.0), 0.0, 0.5, 1.0e-2);
    for (int k = 0; k < 50; ++k) water.step(1.0e-2);
    const double borne = displaced(device, *water.fluid).borne / (kDensity * kGravity);
    std::printf("at %.3f m: %.4f litres of %.4f\n", height, 1000.0 * borne, 1000.0 * displaces);
    EXPECT_NEAR(borne, displaces, within) << height;
    EXPECT_LT(water.fluid->stats().speed, 0.03 * std::sqrt(kGravity * 0.3));
  };
  const Shape ball = {ShapeKind::sphere, {0.12, 0.12, 0.12}};
  const Shape box = {ShapeKind::box, {0.13, 0.09, 0.07}};
  const Shape mat = {ShapeKind::box, {0.21, 0.17, 0.03}};
  const double of_ball = std::numbers::pi * std::pow(0.12, 3) / 6.0;
  const double of_box = 0.13 * 0.09 * 0.07;
  const double of_mat = 0.21 * 0.17 * 0.03;
  expect(ball, 0.142, of_ball, 0.01 * of_ball);
  expect(ball, 0.061, of_ball, 0.01 * of_ball);
  expect(box, 0.035, of_box, 0.03 * of_box);
  expect(box, 0.04, of_box, 0.03 * of_box);
  expect(mat, 0.015, of_mat, 0.05 * of_mat);
  const double wet = 0.09 * 0.09 * 0.3;
  expect({ShapeKind::box, {0.09, 0.09, 0.5}}, 0.2, 0.0, 0.05 * wet);
}

/// A plate that starts to move deep in the water sets as much of it in motion, however thin it is
/// and wherever it is in the cells: 8/3 rho R^3 (Lamb, article 102), but for what five cells across
/// the plate do not see of the flow around its edge.
TEST(GridSolids, ThinPlatesLetNoWaterThrough) {
  Device device;
  constexpr double kSpacing = 0.02;
  constexpr double kRadius = 0.1;
  constexpr double kSpeed = 0.5;
  for (const double thick : {1.0, 2.0, 4.0}) {
    for (const double off : {0.0, 0.01, 0.02, 0.03}) {
      const auto at = [&](double time) {
        return BodyState{.position = {0.32, 0.32, 0.24 + off - kSpeed * time},
                         .velocity = {0.0, 0.0, -kSpeed}};
      };
      Water water = with_solid(
          kSpacing, {0.64, 0.64, 0.6}, 0.5,
          {ShapeKind::cylinder, {2.0 * kRadius, 2.0 * kRadius, thick * kSpacing}}, at(0.0));
      water.motions = {at};
      water.start(device);
      water.step(1.0e-2);
      double sum = 0.0;
      for (const float v : water.fluid->snapshot().velocity) {
        sum += static_cast<double>(water.params.mass) * static_cast<double>(v * v);
      }
      const double part = sum / (8.0 / 3.0 * kDensity * std::pow(kRadius, 3) * kSpeed * kSpeed);
      std::printf("%.0f spacings thick, %.2f m: %.2f of the energy\n", thick, off, part);
      EXPECT_NEAR(part, 0.75, 0.25) << thick << ' ' << off;
    }
  }
}

class GridBodies : public ::testing::TestWithParam<double> {};

/// From rest under water: (rho_b - rho) g = (rho_b + rho / 2) a, walls and surface add little.
TEST_P(GridBodies, BeginAsTheirAddedMassSays) {
  Device device;
  const double density = GetParam();
  FreeFloat world = {tank_scene(0.02, {0.6, 0.6, 0.8}, 0.6)};
  world.scene.fluid.solver = PressureKind::grid_projected;
  world.add({ShapeKind::sphere, {0.16, 0.16, 0.16}}, density, {{0.31, 0.29, 0.3}});
  world.start(device);
  world.dt = 2.0e-3;
  world.run(world.dt);
  const double found = world.state(0).velocity[2] / world.dt;
  const double wanted = -kGravity * (density - kDensity) / (density + 0.5 * kDensity);
  std::printf("%.0f kg/m3: %.3f m/s2, by theory %.3f\n", density, found, wanted);
  EXPECT_NEAR(found / wanted, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Densities, GridBodies, ::testing::Values(20.0, 500.0, 2000.0));

/// From where they stand flat on the floor what is lighter than water rises; what is heavier stays.
TEST(GridSolids, LeaveTheFloorIfTheyAreLight) {
  Device device;
  for (const ShapeKind kind : {ShapeKind::box, ShapeKind::cylinder, ShapeKind::sphere}) {
    for (const double density : {0.9 * kDensity, 1.1 * kDensity}) {
      FreeFloat world = {tank_scene(0.03, {0.6, 0.6, 0.6}, 0.36)};
      world.scene.fluid.solver = PressureKind::grid_projected;
      world.add({kind, {0.12, 0.12, 0.12}}, density, {{0.33, 0.28, 0.06}});
      world.start(device);
      world.dt = 1.0e-2;
      world.run(1.0);
      const double risen = world.state(0).position[2] - 0.06;
      std::printf("%.0f kg/m3: %.1f mm\n", density, 1000.0 * risen);
      if (density < kDensity) {
        EXPECT_GT(risen, 0.05);
      } else {
        EXPECT_LT(std::abs(risen), 0.003);
      }
    }
  }
}

/// Afloat, flat against a wall: there is water between, or it would be pressed to the wall.
TEST(GridSolids, AreNotHeldByAWall) {
  Device device;
  constexpr double kSide = 0.24;
  FreeFloat world = {tank_scene(0.03, {0.72, 0.6, 0.6}, 0.36)};
  world.scene.fluid.solver = PressureKind::grid_projected;
  world.add({ShapeKind::box, {kSide, kSide, kSide}}, 0.5 * kDensity, {{0.5 * kSide, 0.31, 0.36}});
  world.start(device);
  world.dt = 1.0e-2;
  world.run(1.0);
  const double sealed = 0.5 * kDensity * kGravity * std::pow(0.5 * kSide, 2) * kSide;
  const double push = displaced(device, *world.fluid).aside;
  std::printf("%.2f of %.2f N\n", push, sealed);
  EXPECT_LT(std::abs(push), 0.1 * sealed);
}

/// Pressures have no moment about a ball's centre.
TEST(GridSolids, ABallThatFloatsDoesNotSpin) {
  Device device;
  FreeFloat world = {tank_scene(0.025, {0.4, 0.4, 0.6}, 0.2)};
  world.scene.fluid.solver = PressureKind::grid_projected;
  world.add({ShapeKind::sphere, {0.12, 0.12, 0.12}}, 0.5 * kDensity, {{0.2, 0.2, 0.1}});
  world.start(device);
  world.dt = 1.0e-2;
  world.run(3.0);
  const double spin = length(world.state(0).spin);
  std::printf("%.2f rad/s\n", spin);
  EXPECT_LT(spin, 0.5);
}

TEST(GridSolids, ABoxFloatsAsDeepAsItIsHeavy) {
  Device device;
  constexpr double kSide = 0.16;
  constexpr double kHeight = 0.12;
  FreeFloat world = {tank_scene(0.02, {0.4, 0.4, 0.5}, 0.2)};
  world.scene.fluid.solver = PressureKind::grid_projected;
  world.add({ShapeKind::box, {kSide, kSide, kHeight}}, 0.5 * kDensity, {{0.2, 0.2, 0.217}});
  world.start(device);
  world.dt = 1.0e-2;
  world.run(3.0);
  double height = 0.0;
  double fastest = 0.0;  // on average
  for (int k = 0; k < 100; ++k) {
    world.run(world.dt);
    height += world.state(0).position[2] / 100.0;
    fastest += world.fluid->stats().speed / 100.0;
  }
  const double water = static_cast<double>(world.fluid->params().count) * std::pow(0.02, 3);
  const double level = (water + 0.5 * kSide * kSide * kHeight) / (0.4 * 0.4);
  const double draft = level - (height - 0.5 * kHeight);
  std::printf("draft %.4f m of %.4f, fastest water %.4f m/s\n", draft, 0.5 * kHeight, fastest);
  EXPECT_NEAR(draft, 0.5 * kHeight, 0.005);
  EXPECT_LT(fastest, 0.05 * std::sqrt(kGravity * 0.2));
}

/// On a beach, the water's edge included.
TEST(GridSolids, WaterOnASlopeStaysStill) {
  Device device;
  Scene scene = tank_scene(0.02, {1.0, 0.2, 0.4}, 0.2);
  scene.fluid.solver = PressureKind::grid_projected;
  scene.slope = {true, 0.4, 0.5};
  Water water = fill(scene, PressureKind::grid_projected);
  start_at_rest(device, water);
  for (int k = 0; k < 100; ++k) water.step(1.0e-2);
  std::printf("fastest %.4f of sqrt(gH)\n", water.fluid->stats().speed / std::sqrt(kGravity * 0.2));
  EXPECT_LT(water.fluid->stats().speed, 0.02 * std::sqrt(kGravity * 0.2));
}

/// Mean height of the highest so many particles within a box around the tank's middle, or outside
/// it.
double top_of(const std::vector<Vector3>& places, const Vector3& half, bool within,
              std::size_t highest) {
  std::vector<double> heights;
  for (const Vector3& x : places) {
    const bool inside = std::abs(x[0] - 0.225) < half[0] && std::abs(x[1] - 0.18) < half[1];
    if (inside == within) heights.push_back(x[2]);
  }
  std::sort(heights.rbegin(), heights.rend());
  return std::accumulate(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(highest),
                         0.0) /
         static_cast<double>(highest);
}

/// By how much, in spacings.
class Hovering : public ::testing::TestWithParam<double> {};

/// A hand that hangs a little above the water does not press it down.
TEST_P(Hovering, LeavesTheWaterLevel) {
  Device device;
  constexpr double kSpacing = 0.025;
  const double gap = GetParam() * kSpacing;
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.size = {0.18, 0.09, 0.04};
  Water water = with_solid(kSpacing, {0.45, 0.36, 0.84}, 0.24, shape, {{0.225, 0.18, 0.26 + gap}});
  start_at_rest(device, water);
  for (int k = 0; k < 40; ++k) water.step(1.0e-2);
  const std::vector<Vector3> places = places_of(*water.fluid);
  const double beneath = top_of(places, {0.07, 0.03, 0.0}, true, 8);
  const double elsewhere = top_of(places, {0.15, 0.18, 0.0}, false, 50);
  std::printf("%.2f spacings lower beneath it\n", (elsewhere - beneath) / kSpacing);
  EXPECT_NEAR(beneath, elsewhere, 0.15 * kSpacing);
}

INSTANTIATE_TEST_SUITE_P(GridSolids, Hovering, ::testing::Values(0.6, 1.2, 1.6));

/// A piston that goes slowly lifts the level as it takes room.
TEST(GridSolids, APistonLiftsTheWater) {
  Device device;
  constexpr double kSpeed = 0.02;
  Scene scene = tank_scene(0.02, {0.4, 0.2, 0.4}, 0.2);
  scene.fluid.solver = PressureKind::grid_projected;
  scene.wave_maker = {true, 0.1, 2.0};
  Water water = fill(scene, PressureKind::grid_projected);
  start_at_rest(device, water);
  const auto mean_height = [&] {
    double sum = 0.0;
    for (const Vector3& x : places_of(*water.fluid)) sum += x[2];
    return sum / static_cast<double>(water.particles.size());
  };
  const double before = mean_height();
  for (int k = 0; k < 300; ++k) {
    water.piston.offset += 1.0e-2 * kSpeed;
    water.piston.speed = kSpeed;
    water.step(1.0e-2);
  }
  const double gone = water.piston.offset;
  water.piston.speed = 0.0;
  for (int k = 0; k < 100; ++k) water.step(1.0e-2);
  const double risen = mean_height() / before;
  std::printf("piston at %.3f m: mean height times %.4f, by volume %.4f\n", gone, risen,
              0.4 / (0.4 - gone));
  EXPECT_NEAR(risen, 0.4 / (0.4 - gone), 0.02);
}

}  // namespace
}  // namespace splash::sim
