// SPDX-License-Identifier: MIT
// What body points see of the water against the brute-force double-precision reference.
#include <gtest/gtest.h>

#include "sim-server/detect/impacts.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/detect/detect_reference.hpp"
#include "tests/sim-server/detect/detect_rig.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

/// Of colour and gradient, relative to the sum of the magnitudes of their terms; measured at most
/// 5e-6. At the rim of the support 1 - q^2 is a small difference: its absolute error stays.
constexpr double kBound = 2.0e-5;
constexpr double kRim = 1.0e-8;

constexpr double kFar = 0.03;  ///< how far ahead the points look [m]

/// Where a body is, as the kernel reads it; near everything.
BodyStep as_step(const BodyState& body) {
  const auto f = [](double x) { return static_cast<float>(x); };
  BodyStep step = {};
  step.px = f(body.position[0]), step.py = f(body.position[1]), step.pz = f(body.position[2]);
  step.qx = f(body.rotation[0]), step.qy = f(body.rotation[1]), step.qz = f(body.rotation[2]);
  step.qw = f(body.rotation[3]);
  step.vx = f(body.velocity[0]), step.vy = f(body.velocity[1]), step.vz = f(body.velocity[2]);
  step.wx = f(body.spin[0]), step.wy = f(body.spin[1]), step.wz = f(body.spin[2]);
  step.lower_x = step.lower_y = step.lower_z = -1.0e9F;
  step.upper_x = step.upper_y = step.upper_z = 1.0e9F;
  return step;
}

/// Skins of bodies: points in body axes, and where the bodies are.
struct Skins {
  std::vector<Vector3> places;
  std::vector<int> owner;
  std::vector<BodyState> bodies;
  std::vector<Vector3> normals;
};

/// The mean density around each particle, all of which are near a body.
Buffer<float> averaged(Water& water) {
  Device& device = water.fluid->device();
  Kernel kernel(detect_program(device), "average_density");
  const Fluid& fluid = *water.fluid;
  const int count = fluid.params().count;
  const Buffer<BodyStep> bodies(device, std::vector<BodyStep>{as_step({})});
  Buffer<float> mean(device, fluid.water_density().size());
  kernel.run(device.queue(), static_cast<std::size_t>(count),
             {{"p", fluid.params_buffer()},
              {"cell_start", fluid.grid().cell_start()},
              {"position", fluid.particles().position},
              {"density", fluid.water_density()},
              {"count", count},
              {"bodies", bodies},
              {"first_body", 0},
              {"body_count", 1},
              {"mean", mean}});
  return mean;
}

/// Runs the kernel for bodies of the second of two steps; the first has them elsewhere.
std::vector<Touch> touch(Water& water, const Buffer<float>& density, const Skins& skins) {
  Device& device = water.fluid->device();
  Kernel kernel(detect_program(device), "touch_water");
  std::vector<float> parts;
  for (const Vector3& place : skins.places) {
    for (const double part : place) parts.push_back(static_cast<float>(part));
  }
  std::vector<float> facings;
  for (const Vector3& normal : skins.normals) {
    for (const double part : normal) facings.push_back(static_cast<float>(part));
    facings.push_back(static_cast<float>(kFar));
  }
  std::vector<BodyStep> steps(skins.bodies.size(), as_step({{0.1, 0.2, 0.1}}));
  for (const BodyState& body : skins.bodies) steps.push_back(as_step(body));
  const Buffer<float> skin(device, parts);
  const Buffer<float> facing(device, facings);
  const Buffer<int> owner(device, skins.owner);
  const Buffer<BodyStep> bodies(device, steps);
  const Buffer<Touch> out(device, skins.places.size());
  const Fluid& fluid = *water.fluid;
  kernel.run(device.queue(), skins.places.size(),
             {{"p", fluid.params_buffer()},
              {"cell_start", fluid.grid().cell_start()},
              {"position", fluid.particles().position},
              {"velocity", fluid.particles().velocity},
              {"density", density},
              {"points", static_cast<int>(skins.places.size())},
              {"skin", skin},
              {"facing", facing},
              {"owner", owner},
              {"bodies", bodies},
              {"first_body", static_cast<int>(skins.bodies.size())},
              {"piston", static_cast<float>(water.piston.offset)},
              {"out", out}});
  return out.read(device, skins.places.size());
}

struct Seen {
  int water = 0;
  int spray = 0;
  int full = 0, partly = 0, none = 0;  ///< points with so much matter ahead
};

/// From the place that the kernel says it looked from.
void expect_references(const FluidState& state, const std::vector<float>& density,
                       const Touch& touch, Seen& seen) {
  const ReferenceTouch reference =
      reference_touch(state, density, vector(touch.x, touch.y, touch.z));
  ASSERT_NEAR(static_cast<double>(touch.colour), reference.colour,
              kBound * reference.colour + kRim);
  ASSERT_NEAR(static_cast<double>(touch.all_colour), reference.all_colour,
              kBound * reference.all_colour + kRim);
  const Vector3 gradient = vector(touch.gx, touch.gy, touch.gz);
  const double rim = 100.0 * kRim / static_cast<double>(state.params.support);
  ASSERT_LT(length(gradient - reference.gradient), kBound * reference.gradient_scale + rim);
  // Where the colour is faint, the mean is that of hardly any water.
  if (reference.colour > 1.0e-3) {
    const Vector3 water = vector(touch.water_u, touch.water_v, touch.water_w);
    ASSERT_LT(length(water - reference.water), 3.0e-5);  // of up to 2.6 m/s
  }
  const Vector3 far =
      vector(touch.x, touch.y, touch.z) + kFar * vector(touch.nx, touch.ny, touch.nz);
  const double ahead = reference_matter(state, far);
  ASSERT_NEAR(static_cast<double>(touch.ahead), ahead, 1.0e-3);
  seen.full += ahead == 1.0;
  seen.partly += ahead > 0.1 && ahead < 0.9;
  seen.none += ahead == 0.0;
  seen.water += reference.seen;
  seen.spray += reference.passed_over;
}

/// That place, and its velocity.
void expect_rigid(const Skins& skins, std::size_t i, const Touch& touch) {
  const BodyState& body = skins.bodies[static_cast<std::size_t>(skins.owner[i])];
  const Vector3 arm = rotate(body.rotation, skins.places[i]);
  ASSERT_LT(length(vector(touch.x, touch.y, touch.z) - (body.position + arm)), 2.0e-7);
  const Vector3 normal = rotate(body.rotation, skins.normals[i]);
  ASSERT_LT(length(vector(touch.nx, touch.ny, touch.nz) - normal), 1.0e-6);
  ASSERT_LT(length(vector(touch.u, touch.v, touch.w) - (body.velocity + cross(body.spin, arm))),
            2.0e-6);
}

/// Two turned, moving bodies with points all over the tank.
Skins wide_bodies() {
  Skins skins;
  skins.places = random_places(201, {-0.25, -0.2, -0.2}, {0.25, 0.2, 0.2}, 72);
  for (int i = 0; i < 201; ++i) skins.owner.push_back(i % 3 == 0 ? 1 : 0);
  for (const Vector3& way : random_places(201, {-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}, 73)) {
    skins.normals.push_back((1.0 / length(way)) * way);
  }
  skins.bodies = {{{0.2, 0.15, 0.12}, from_turn({0.2, -0.4, 0.9}), {0.5, 0, -1}, {3, -2, 5}},
                  {{0.1, 0.1, 0.1}, from_turn({2.0, 0.1, 0.0}), {0, 0.8, 0.1}, {0, 0, -4}}};
  return skins;
}

class TouchWater : public ::testing::TestWithParam<int> {};

TEST_P(TouchWater, IsTheTwins) {
  Device device(-1, false, GetParam());
  Seen seen;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.stir(1.5, 71);
    prepare(water);
    const Skins skins = wide_bodies();
    const std::vector<Touch> touches = touch(water, water.fluid->water_density(), skins);
    const FluidState state = read_state(*water.fluid, water.piston.offset);
    const auto density = water.fluid->water_density().read(device, state.position.size());
    for (std::size_t i = 0; i < touches.size(); ++i) {
      expect_rigid(skins, i, touches[i]);
      expect_references(state, density, touches[i], seen);
    }
  }
  EXPECT_GT(seen.water, 1000);
  EXPECT_GT(seen.spray, 1000);
  for (const int points : {seen.full, seen.partly, seen.none}) EXPECT_GT(points, 20);
}

// The filter's density is the water's own: a body next to a lone particle makes it no water.
TEST_P(TouchWater, GoesByTheDensityWithoutBodies) {
  Device device(-1, false, GetParam());
  Water water = two_bodies();
  water.start(device);
  prepare(water);
  FluidState state = read_state(*water.fluid);
  const auto density = water.fluid->water_density().read(device, state.position.size());
  const std::vector<double> with_bodies = reference_density(state);
  state.body_position.clear();
  const std::vector<double> without = reference_density(state);
  int differ = 0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(density[i]), without[i], 1.0e-5 * without[i]);
    if (with_bodies[i] > 1.05 * without[i]) ++differ;
  }
  EXPECT_GT(differ, 50);
}

INSTANTIATE_TEST_SUITE_P(Lanes, TouchWater, kLaneCounts, lanes_name);

TEST_P(TouchWater, AveragesTheDensityAroundEachParticle) {
  Device device(-1, false, GetParam());
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.stir(1.5, 71);
    prepare(water);
    const FluidState state = read_state(*water.fluid, water.piston.offset);
    const std::size_t count = state.position.size();
    const auto density = water.fluid->water_density().read(device, count);
    const auto mean = averaged(water).read(device, count);
    for (std::size_t i = 0; i < count; ++i) {
      const double reference = reference_mean_density(state, density, i);
      ASSERT_NEAR(static_cast<double>(mean[i]), reference, kBound * reference);
    }
  }
}

// The limit is such that a film of one layer is no surface, the top layer of still water is.
TEST(LeastDensity, TellsAFilmFromWater) {
  Device device;
  Water film = hanging_block();
  std::erase_if(film.particles, [](const Vector3& x) { return x[2] > kBlockBottom + 0.02; });
  Water block = hanging_block();
  for (Water* water : {&film, &block}) {
    water->start(device);
    prepare(*water);
  }
  const auto colour_below = [](Water& water) {
    const Skins skins = {
        {{0.0, 0.0, 0.0}}, {0}, {{{0.5, 0.5, kBlockBottom - 0.005}}}, {{0.0, 0.0, 1.0}}};
    return static_cast<double>(touch(water, averaged(water), skins).front().colour);
  };
  EXPECT_EQ(colour_below(film), 0.0);
  EXPECT_GT(colour_below(block), 0.1);
}

}  // namespace
}  // namespace splash::sim
