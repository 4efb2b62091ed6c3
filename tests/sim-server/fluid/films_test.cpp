// SPDX-License-Identifier: MIT
// Films between free bodies and what they touch: the kernels compute what the same sums in double
// precision do, with every vector width; bodies that touch only each other push each other alike;
// and where nothing is near nothing is computed and no bit changes.
#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/gauge/film_force.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/free_float.hpp"

namespace splash::sim {
namespace {

const Shape kBall = {ShapeKind::sphere, {0.12, 0.12, 0.12}};
const Shape kBox = {ShapeKind::box, {0.1, 0.08, 0.06}};
const Shape kDisc = {ShapeKind::cylinder, {0.1, 0.1, 0.05}};

FreeFloat pool() {
  return {tank_scene(0.02, {0.5, 0.4, 0.5}, 0.3)};
}

/// What the films of the last step did to a body.
BodyForce film_on(FreeFloat& world, std::size_t body) {
  const std::vector<float> push =
      world.fluid->free_bodies()->films().push().read(world.fluid->device(), 6 * (body + 1));
  return {vector_at(push, 1, 6 * body), vector_at(push, 1, 6 * body + 3)};
}

BodyForce expected(FreeFloat& world, const WaterState& water, std::size_t body) {
  std::vector<BodyState> states;
  for (const BodyStep& step : world.steps) states.push_back(state_of(step));
  const auto skin =
      film_skin(world.scene.bodies[body].shape, static_cast<int>(body), world.scene.fluid.spacing);
  return film_force(water, {world.scene, world.scene.tank, states}, world.bodies->points(), skin,
                    body);
}

class Films : public ::testing::TestWithParam<int> {};

TEST_P(Films, PushAsTheSumsInDoublePrecisionSay) {
  Device device(-1, false, GetParam());
  FreeFloat world = pool();
  world.scene.slope = {true, 0.35, 0.3};
  world.add(kBall, 500.0, {{0.1, 0.1, 0.061}});
  world.add(kBox, 500.0, {{0.29, 0.1, 0.05}, from_turn({0.0, 0.25, 0.0})});
  world.add(kDisc, 500.0, {{0.1, 0.345, 0.2}});  // at a side
  world.add(kBall, 500.0, {{0.38, 0.3, 0.1}});   // on the slope, dry in part
  world.start(device);
  world.run(0.05);
  world.fluid->free_bodies()->films().forget(device);  // the sums know of no past
  const Step step = {world.dt, 0.0, 0.0, 0};
  world.fluid->set_bodies(world.steps);
  world.fluid->prepare(step);
  const WaterState water = read_water(*world.fluid, true);
  world.fluid->advance(step);
  for (std::size_t body = 0; body < 4; ++body) {
    SCOPED_TRACE(body);
    const BodyForce found = film_on(world, body), wanted = expected(world, water, body);
    const double size = length(wanted.force);
    EXPECT_GT(size, 0.1);
    EXPECT_LT(length(found.force - wanted.force), 5.0e-3 * size);
    EXPECT_LT(length(found.torque - wanted.torque), 5.0e-3 * size * 0.06);
  }
}

INSTANTIATE_TEST_SUITE_P(Lanes, Films, kLaneCounts, lanes_name);

TEST(Films, OfBodiesThatTouchOnlyEachOtherAreEqualAndOpposite) {
  Device device(-1, false, 0);
  FreeFloat world = pool();
  world.add(kBall, 500.0, {{0.19, 0.2, 0.14}});
  world.add(kBall, 1500.0, {{0.3, 0.21, 0.185}});
  world.start(device);
  world.run(0.05);
  const Vector3 apart = world.state(1).position - world.state(0).position;
  world.run(world.dt);
  const BodyForce first = film_on(world, 0), second = film_on(world, 1);
  const double size = length(first.force);
  EXPECT_GT(size, 0.1);
  EXPECT_LT(length(first.force + second.force), 1.0e-5 * size);
  const Vector3 turning = first.torque + second.torque + cross(apart, second.force);
  EXPECT_LT(length(turning), 1.0e-3 * size * length(apart));
}

TEST(Films, ChangeNoBitWhereNothingIsNear) {
  Device device(-1, false, 0);
  std::vector<BodyState> ends;
  for (const bool films : {true, false}) {
    FreeFloat world = pool();
    world.add(kBall, 700.0, {{0.25, 0.2, 0.2}});
    world.start(device);
    if (!films) world.fluid->release(free_bodies(world.scene.bodies), {});
    world.run(0.05);
    EXPECT_EQ(world.fluid->free_bodies()->films().steps(), 0U);
    ends.push_back(world.state(0));
  }
  EXPECT_EQ(ends[0].position, ends[1].position);
  EXPECT_EQ(ends[0].spin, ends[1].spin);
}

}  // namespace
}  // namespace splash::sim
