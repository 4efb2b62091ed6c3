// SPDX-License-Identifier: MIT
// Air that is shut in: how much there is, how fast it swings, how it bears the water, and that
// water without any does not know of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include "sim-server/device/device_error.hpp"
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr double kGravity = 9.81;         ///< [m/s2]
constexpr double kDensity = 998.0;        ///< [kg/m3]
constexpr double kAtmosphere = 101325.0;  ///< [Pa]
constexpr double kHeatRatio = 1.4;        ///< of air [1]
constexpr double kBubbleRadius = 0.06;    ///< of bubbles [m]

std::vector<AirPocket> pockets_in(Fluid& fluid) {
  return dynamic_cast<const GridProjected&>(fluid.solver()).air().read(fluid.device());
}

Scene scene_of(double spacing, const Vector3& tank, double depth) {
  Scene scene = tank_scene(spacing, tank, depth);
  scene.fluid.solver = PressureKind::grid_projected;
  scene.fluid.air_pockets = true;
  return scene;
}

/// The scene's water but for some of it.
template <class Left>
Water water_without(const Scene& scene, Left&& is_left_out) {
  Water water = {.scene = scene, .particles = initial_particles(scene)};
  std::erase_if(water.particles, is_left_out);
  return water;
}

/// A ball of air in the middle of a ball of water four times as wide, which nothing pulls.
struct Bubble {
  Bubble(Device& device, double spacing)
      : scene_(scene_of(spacing, {0.6, 0.6, 0.6}, 0.6)), spacing_(spacing) {
    scene_.fluid.gravity = {0.0, 0.0, 0.0};
    water = water_without(scene_, [&](const Vector3& x) {
      return off(x) < kBubbleRadius || off(x) > 4.0 * kBubbleRadius;
    });
    air = volume_within(kBubbleRadius);
    const double inner = radius_of(air);
    const double outer = radius_of(volume_within(4.0 * kBubbleRadius));
    // An incompressible fluid between them flows by 4 pi / (1/R - 1/R_water) for f = 1 inside.
    const double flow = 4.0 * std::numbers::pi / (1.0 / inner - 1.0 / outer);
    frequency =
        std::sqrt(kHeatRatio * kAtmosphere * flow / (kDensity * air)) / (2.0 * std::numbers::pi);
    water.start(device);
  }
  Water water;
  double air = 0.0;        ///< volume of the particles that are left out [m3]
  double frequency = 0.0;  ///< of its swing, as Minnaert's but for the water's end [Hz]

 private:
  static double off(const Vector3& x) { return length(x - Vector3{0.3, 0.3, 0.3}); }
  static double radius_of(double volume) { return std::cbrt(0.75 * volume / std::numbers::pi); }
  double volume_within(double most) const {
    const auto all = initial_particles(scene_);
    const auto count =
        std::count_if(all.begin(), all.end(), [&](const Vector3& x) { return off(x) < most; });
    return static_cast<double>(count) * std::pow(spacing_, 3.0);
  }

  Scene scene_;
  double spacing_;
};

class Sizes : public ::testing::TestWithParam<double> {};

TEST_P(Sizes, OfABubbleAreItsAirs) {
  Device device;
  Bubble bubble(device, kBubbleRadius / GetParam());
  bubble.water.step(1.0e-4);
  const auto pockets = pockets_in(*bubble.water.fluid);
  ASSERT_EQ(pockets.size(), 1U);
  const double volume = static_cast<double>(pockets[0].volume);
  std::printf("R/dp %.1f: %.4f of the volume\n", GetParam(), volume / bubble.air);
  EXPECT_NEAR(volume / bubble.air, 1.0, 0.01);
  EXPECT_EQ(pockets[0].amount, pockets[0].volume) << "shut in by the atmosphere's pressure";
}

INSTANTIATE_TEST_SUITE_P(Bubbles, Sizes, ::testing::Values(3.0, 4.0, 5.0));

// Water that is pushed away from the air comes back by its spring. The grid's surface is smoother
// than the air's, and coarser ones swing more slowly: 0.75 and 0.86 of this at R/dp 3 and 4.
TEST(Bubbles, SwingAtTheirFrequency) {
  Device device;
  Bubble bubble(device, kBubbleRadius / 5.0);
  const double dt = 0.002 / bubble.frequency;
  bubble.water.step(dt);
  change_particles(*bubble.water.fluid, [dt](int, Vector3& place, Vector3& velocity) {
    const Vector3 from = place - Vector3{0.3, 0.3, 0.3};
    const double far = length(from);
    const double speed = 1.0e-6 * kBubbleRadius * kBubbleRadius / (dt * far * far);  // [m/s]
    velocity = velocity + (speed / far) * from;
  });
  double before = 0.0;
  std::vector<double> crossings;
  for (int k = 0; k < 1500 && crossings.size() < 3; ++k) {
    bubble.water.step(dt);
    const double now = static_cast<double>(pockets_in(*bubble.water.fluid).at(0).pressure);
    if (k > 20 && now * before < 0.0) crossings.push_back(bubble.water.time);
    before = now;
  }
  ASSERT_EQ(crossings.size(), 3U);
  const double frequency = 1.0 / (crossings[2] - crossings[0]);
  std::printf("%.3f of the frequency\n", frequency / bubble.frequency);
  EXPECT_NEAR(frequency / bubble.frequency, 1.0, 0.1);
}

/// A hood over the wall x = 0: a plate across the tank, and a lid.
constexpr double kWidth = 0.32, kLength = 0.6;               ///< of the tank [m]
constexpr double kSolid = 0.32 * (0.1 * 0.36 + 0.24 * 0.1);  ///< volume of both [m3]

Scene hood() {
  Scene scene = scene_of(0.02, {kLength, kWidth, 1.0}, 0.56);
  scene.bodies = {body_of("plate", {ShapeKind::box, {0.1, kWidth, 0.36}}, {{0.29, 0.16, 0.32}}),
                  body_of("lid", {ShapeKind::box, {0.34, kWidth, 0.1}}, {{0.17, 0.16, 0.45}})};
  return scene;
}

/// That hood, `raised(time)` above its place [m], with air under its lid down to 0.2 m, where the
/// water around stands at 0.56 m.
Water under_the_hood(const Scene& scene, const std::function<double(double)>& raised) {
  Water water = {.scene = scene, .particles = initial_particles(scene)};
  std::erase_if(water.particles, [](const Vector3& place) {
    return place[0] <= 0.24 && place[2] >= 0.2 && place[2] <= 0.4;
  });
  for (const BodySettings& body : scene.bodies) {
    water.motions.push_back([place = body.rest.position, raised](double time) {
      BodyState state = {place};
      state.position[2] += raised(time);
      const double later = raised(time + 1.0e-4);
      state.velocity[2] = (later - raised(time)) / 1.0e-4;
      return state;
    });
  }
  return water;
}

/// Volume of the water under the lid, which is `raised` [m3].
double water_inside(Fluid& fluid, double raised) {
  const std::vector<Vector3> places = places_of(fluid);
  const auto inside = [&](const Vector3& x) { return x[0] < 0.24 && x[2] < 0.45 + raised; };
  const auto count = std::count_if(places.begin(), places.end(), inside);
  return static_cast<double>(count) *
         static_cast<double>(fluid.params().mass / fluid.params().rest_density);
}

/// Of the pressure that the water's level asks of the air, what the air has.
double share_of_pressure(Water& water, double raised) {
  const AirPocket pocket = pockets_in(*water.fluid).at(0);
  const double inside = water_inside(*water.fluid, raised) / (0.24 * kWidth);
  const double all = static_cast<double>(water.particles.size()) *
                     static_cast<double>(water.params.mass / water.params.rest_density);
  const double level = (all + kSolid + static_cast<double>(pocket.volume)) / (kLength * kWidth);
  const double gauge = kDensity * kGravity * (level - inside);
  const double boyle =
      kAtmosphere *
      (std::pow(static_cast<double>(pocket.amount) / static_cast<double>(pocket.volume),
                kHeatRatio) -
       1.0);
  std::printf("%.2f l of %.2f at %.0f Pa, by its volume %.0f, by the levels %.3f and %.3f m %.0f\n",
              1e3 * static_cast<double>(pocket.volume), 1e3 * static_cast<double>(pocket.amount),
              static_cast<double>(pocket.pressure), boyle, inside, level, gauge);
  return static_cast<double>(pocket.pressure) / gauge;
}

TEST(Hood, KeepsItsAirUnderThePressureOfTheWater) {
  Device device;
  Water water = under_the_hood(hood(), [](double) { return 0.0; });
  water.start(device);
  run(water, 3.0);
  ASSERT_EQ(pockets_in(*water.fluid).size(), 1U);
  EXPECT_NEAR(share_of_pressure(water, 0.0), 1.0, 0.03);
  EXPECT_NEAR(water_inside(*water.fluid, 0.0), 0.2 * 0.24 * kWidth, 0.02 * 0.24 * kWidth);
}

// Boyle's diving bell: the deeper the less air. Taken out of the water it loses its air.
TEST(Hood, TakesItsAirDownAndLetsItGoAbove) {
  const auto raised = [](double time) {
    return time < 5.5 ? -0.1 * std::clamp(time - 0.5, 0.0, 1.0)
                      : -0.1 + 0.6 * std::clamp((time - 5.5) / 1.5, 0.0, 1.0);
  };
  Device device;
  Water water = under_the_hood(hood(), raised);
  water.start(device);
  run(water, 0.5);
  const double above = static_cast<double>(pockets_in(*water.fluid).at(0).volume);
  run(water, 4.5);
  EXPECT_NEAR(share_of_pressure(water, -0.1), 1.0, 0.03);
  EXPECT_LT(static_cast<double>(pockets_in(*water.fluid).at(0).volume), above);
  run(water, 2.5);
  EXPECT_TRUE(pockets_in(*water.fluid).empty());
}

TEST(Hood, WithoutAirPocketsFills) {
  Device device;
  Scene scene = hood();
  scene.fluid.air_pockets = false;
  Water water = under_the_hood(scene, [](double) { return 0.0; });
  water.start(device);
  run(water, 3.0);
  EXPECT_GT(water_inside(*water.fluid, 0.0), 0.95 * 0.4 * 0.24 * kWidth);
}

// Water without any goes on as if nobody looked for it, bit for bit.
TEST(Pockets, ChangeNothingWhereThereAreNone) {
  Device device;
  std::vector<std::vector<float>> places;
  for (const bool looks : {false, true}) {
    Scene scene = scene_of(0.02, {0.4, 0.3, 0.5}, 0.2);
    scene.fluid.air_pockets = looks;
    Water water = water_without(scene, [](const Vector3&) { return false; });
    water.start(device);
    water.stir(0.5, 7);
    for (int k = 0; k < 40; ++k) water.step(0.004);
    places.push_back(water.fluid->snapshot().position);
  }
  EXPECT_EQ(places[0], places[1]);
}

TEST(Pockets, AreRefusedWhereManyWorkItemsSolve) {
  Device device(-1, false, gpu_profile());
  Water water = under_the_hood(hood(), [](double) { return 0.0; });
  EXPECT_THROW(water.start(device), DeviceError);
}

}  // namespace
}  // namespace splash::sim
