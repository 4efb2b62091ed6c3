// SPDX-License-Identifier: MIT
// Water that has come to rest stands where the scene says, around bodies and in tanks whose sides
// are no multiple of the spacing.
#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/fluid/air/air_cells.hpp"
#include "sim-server/gauge/sensors.hpp"
#include "sim-server/gauge/water_state.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "sim-server/simulation/water_notices.hpp"

namespace splash::sim {
namespace {

struct Tub {
  const char* name;
  Vector3 size;  ///< of the water [m]
  int particles;
  std::vector<BodySettings> bodies;
};

Scene scene_of(const Tub& tub) {
  Scene scene;
  scene.name = tub.name;
  scene.tank = {{0.0, 0.0, 0.0}, {tub.size[0], tub.size[1], tub.size[2] + 0.4}};
  scene.water = {{{0.0, 0.0, 0.0}, tub.size}};
  scene.fluid.particles = tub.particles;
  scene.bodies = tub.bodies;
  return scene;
}

BodySettings body(const Shape& shape, const Vector3& place, double density = 0.0) {
  BodySettings body;
  body.name = "body";
  body.shape = shape;
  body.rest.position = place;
  if (density > 0.0) body.motion.kind = MotionKind::free;
  body.motion.density = density;
  return body;
}

/// Mean height of the surface on lines that no body comes near [m].
double level(Simulation& simulation) {
  const WaterState water = read_water(simulation.fluid(), false);
  const Scene& scene = simulation.scene();
  const auto points = with_images(water.position, scene.tank, water.support);
  constexpr int kLines = 16;
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < kLines; ++i) {
    for (int j = 0; j < kLines; ++j) {
      const double x = (i + 0.5) / kLines * scene.tank.upper[0];
      const double y = (j + 0.5) / kLines * scene.tank.upper[1];
      bool clear = true;
      for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodyState state = simulation.bodies().state(b, simulation.seconds());
        const Vector3 place = {x, y, scene.water[0].upper[2]};
        const Vector3 local = rotate(inverse(state.rotation), place - state.position);
        clear = clear && distance_to(scene.bodies[b].shape, local) > water.support;
      }
      if (!clear) continue;
      sum += water_height(points, water, x, y, scene.tank.lower[2]).top;
      ++count;
    }
  }
  return sum / count;
}

const Shape kBall = {ShapeKind::sphere, {0.12, 0.12, 0.12}};

const std::vector<Tub> kTubs = {
    {"odd", {0.773, 0.391, 0.287}, 2000, {}},
    {"odd_fine", {0.773, 0.391, 0.287}, 8000, {}},
    {"flat", {0.913, 0.707, 0.151}, 3000, {}},
    {"three_balls",
     {0.9, 0.4, 0.3},
     5000,
     {body(kBall, {0.15, 0.2, 0.3}, 500), body(kBall, {0.45, 0.2, 0.3}, 500),
      body(kBall, {0.75, 0.2, 0.3}, 500)}},
    {"sunken",
     {0.9, 0.4, 0.3},
     5000,
     {body(kBall, {0.15, 0.2, 0.06}), body(kBall, {0.5, 0.21, 0.1})}},
    {"boards",
     {0.773, 0.4, 0.3},
     4000,
     {body({ShapeKind::box, {0.03, 0.3, 0.6}}, {0.21, 0.2, 0.3}),
      body({ShapeKind::box, {0.03, 0.3, 0.6}}, {0.55, 0.2, 0.3})}},
};

class Level : public ::testing::TestWithParam<Tub> {};

// The surface lies a sixth of a spacing deeper than the volume says, wherever there are bodies or
// none (kSurfaceLoss, fluid/params/smoothing.hpp): so they are compared with a tub that has none.
TEST_P(Level, IsThatOfTheFile) {
  Device device;
  const Tub& tub = GetParam();
  Simulation simulation(device, scene_of(tub), {});
  Tub without = tub;
  without.bodies.clear();
  Simulation empty(device, scene_of(without), {});
  const double plain = level(empty);
  EXPECT_NEAR((tub.size[2] - plain) / particle_spacing(empty.scene()), 0.15, 0.07);
  if (tub.bodies.empty()) return;
  EXPECT_NEAR(level(simulation) / plain, 1.0, 0.002);
  if (!is_free(tub.bodies[0])) return;
  while (simulation.seconds() < 1.0) ASSERT_FALSE(simulation.advance().step_fault);
  EXPECT_NEAR(level(simulation) / plain, 1.0, 0.0025) << "they lie a little deeper";
}

// A slit of 6 mm between two boxes has no room for particles 25 mm apart, and a lid none for what
// would lie on top: of 15.36 litres 0.36 are missing, on 0.15 m2.
TEST(MissingWater, IsToldInOneLine) {
  Device device;
  Tub tub = {"lid",
             {0.5, 0.3, 0.2},
             0,
             {body({ShapeKind::box, {0.12, 0.3, 0.2}}, {0.31, 0.15, 0.1}),
              body({ShapeKind::box, {0.124, 0.3, 0.2}}, {0.438, 0.15, 0.1}),
              body({ShapeKind::box, {0.5, 0.3, 0.05}}, {0.25, 0.15, 0.23})}};
  Scene scene = scene_of(tub);
  scene.fluid.spacing = 0.025;
  EXPECT_EQ(missing_water(Simulation(device, scene, {})),
            "block 1 has 15 litres for 15.4, so that its level is about 0.1976 m for 0.2 "
            "(particles are too large for what bodies leave of it: more fluid.particles)");
  scene.bodies.clear();
  EXPECT_EQ(missing_water(Simulation(device, scene, {})), "");
}

INSTANTIATE_TEST_SUITE_P(Tubs, Level, ::testing::ValuesIn(kTubs),
                         [](const auto& tub) { return std::string(tub.param.name); });

}  // namespace
}  // namespace splash::sim
