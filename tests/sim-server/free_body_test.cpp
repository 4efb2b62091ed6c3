// SPDX-License-Identifier: MIT
// Free bodies in the whole simulation: they make impacts, float, come to rest, and are taken back
// with the water when a frame goes wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

/// A tank with 0.2 m of water and a ball above it, as a scene file says it.
Scene pond(const std::string& height, const std::string& motion) {
  return parse_scene(R"(
fluid: {spacing: 0.025, solver: weakly_compressible}
tank: {lower: [0.0, 0.0, 0.0], upper: [0.5, 0.5, 0.6]}
water:
  - {lower: [0.0, 0.0, 0.0], upper: [0.5, 0.5, 0.2]}
bodies:
  - name: ball
    shape: {kind: sphere, size: [0.15, 0.15, 0.15]}
    rest: {position: [0.25, 0.25, )" +
                         height + R"(]}
    motion: {kind: free, )" +
                         motion + R"(}
gauges:
  probes:
    - {name: ball, kind: body, body: ball}
)",
                     "pond.yaml");
}

TEST(FreeBody, MakesOneImpactWithItsSpeed) {
  Device device;
  const Scene scene = pond("0.6", "density: 500");
  Simulation simulation(device, scene, {});
  std::vector<DetectedImpact> impacts;
  while (simulation.seconds() < 1.0) {
    const FrameResult frame = simulation.advance();
    impacts.insert(impacts.end(), frame.found.impacts.begin(), frame.found.impacts.end());
    ASSERT_FALSE(frame.step_fault) << describe(*frame.step_fault);
  }
  ASSERT_EQ(impacts.size(), 1U);
  const double fall = 0.6 - 0.075 - 0.2;
  // It is announced up to 15 ms ahead, with the speed of then.
  const double speed = std::sqrt(2.0 * 9.81 * fall);
  EXPECT_GT(impacts[0].speed, speed - 9.81 * scene.detect.impact_lookahead - 0.02);
  EXPECT_LT(impacts[0].speed, speed + 0.02);
  EXPECT_NEAR(impacts[0].time, std::sqrt(2.0 * fall / 9.81), 0.012);
}

TEST(FreeBody, FloatsWithTheForceOfItsWeight) {
  Device device;
  const Scene scene = pond("0.2", "density: 499");
  Simulation simulation(device, scene, {});
  while (simulation.seconds() < 4.0) static_cast<void>(simulation.advance());
  const BodyState ball = simulation.bodies().state(0, simulation.seconds());
  // Half in: what it drives away raises the water by 14 mm / 2 over the whole tank.
  EXPECT_NEAR(ball.position[2], 0.2, 0.0125);
  const double weight = 499.0 * 9.81 * M_PI / 6.0 * 0.15 * 0.15 * 0.15;
  EXPECT_NEAR(simulation.bodies().force(0).force[2], weight, 0.05 * weight);
  Gauges gauges(scene);
  const std::vector<double> row =
      gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies());
  EXPECT_EQ(row.at(3), ball.position[2]);
  EXPECT_EQ(row.at(16), simulation.bodies().force(0).force[2]);
}

// What holds it up against its weight is not the water.
TEST(FreeBody, ThatIsHeldFeelsTheWaterAlone) {
  Device device;
  for (const auto solver : {PressureKind::weakly_compressible, PressureKind::grid_projected}) {
    Scene scene = pond("0.2", "density: 2000, held: [x, y, z, rx, ry, rz]");
    scene.fluid.solver = solver;
    Simulation simulation(device, scene, {});
    double force = 0.0;
    int frames = 0;
    for (; simulation.seconds() < 0.5; ++frames) {
      static_cast<void>(simulation.advance());
      force += simulation.bodies().force(0).force[2];
    }
    EXPECT_EQ(simulation.bodies().state(0, simulation.seconds()).position[2],
              static_cast<double>(0.2F));
    const double buoyancy = 0.5 * 998.0 * 9.81 * M_PI / 6.0 * 0.15 * 0.15 * 0.15;
    EXPECT_NEAR(force / frames, buoyancy, 0.1 * buoyancy) << static_cast<int>(solver);
  }
}

TEST(FreeBody, IsNotHeldInTheAirByWaterThatSleeps) {
  Device device;
  Scene scene = pond("40.0", "density: 500");
  scene.tank.upper[2] = 0.6;
  Simulation simulation(device, scene, {});
  while (simulation.seconds() < 2.0) static_cast<void>(simulation.advance());
  const double fallen = 0.5 * 9.81 * simulation.seconds() * simulation.seconds();
  EXPECT_NEAR(simulation.bodies().state(0, simulation.seconds()).position[2], 40.0 - fallen,
              0.01 * fallen);
}

TEST(FreeBody, IsTakenBackWithTheWater) {
  Device device;
  const Scene scene = pond("0.35", "density: 500");
  Simulation harmed(device, scene, {});
  Simulation sound(device, scene, {});
  while (harmed.seconds() < 0.15) static_cast<void>(harmed.advance());
  while (sound.seconds() < 0.15) static_cast<void>(sound.advance());
  const BodyState before = harmed.bodies().state(0, harmed.seconds());
  int steps = 0;
  harmed.set_hook([&steps](Fluid& fluid, Step&, Moment moment) {
    if (moment != Moment::between || steps++ > 0) return;
    std::vector<float> density = fluid.pressure_term().read(fluid.device(), 16);
    density[3] = std::numeric_limits<float>::quiet_NaN();
    Buffer<float> buffer = fluid.pressure_term();
    buffer.write(fluid.device(), density);
  });
  const FrameResult frame = harmed.advance();
  ASSERT_TRUE(frame.step_fault);
  EXPECT_EQ(frame.step_fault->remedy, Remedy::retry);
  const BodyState after = harmed.bodies().state(0, harmed.seconds());
  EXPECT_TRUE(std::isfinite(after.position[2]));
  EXPECT_LT(after.position[2], before.position[2]) << "the frame was done again";
  static_cast<void>(sound.advance());
  const double way = sound.seconds() - harmed.seconds();
  EXPECT_NEAR(after.position[2] + way * after.velocity[2],
              sound.bodies().state(0, sound.seconds()).position[2], 1.0e-3);
}

TEST(FreeBody, ThatIsNowhereIsAFault) {
  Device device;
  Simulation simulation(device, pond("0.35", "density: 500"), {});
  int harms = 0;
  simulation.set_hook([&harms](Fluid& fluid, Step& step, Moment moment) {
    if (moment != Moment::between || harms++ > 0) return;
    std::vector<BodyStep> steps = fluid.boundary().steps().read(fluid.device(), 1);
    steps[0].px = std::numeric_limits<float>::infinity();
    Buffer<BodyStep> buffer = fluid.boundary().steps();
    buffer.write(fluid.device(), steps, static_cast<std::size_t>(step.first_body));
  });
  const FrameResult frame = simulation.advance();
  ASSERT_TRUE(frame.step_fault);
  EXPECT_EQ(frame.step_fault->what.fault, Fault::body);
  EXPECT_NE(describe(*frame.step_fault).find("'ball'"), std::string::npos)
      << describe(*frame.step_fault);
  EXPECT_NEAR(simulation.bodies().state(0, simulation.seconds()).position[0], 0.25, 1.0e-3);
}

/// The first acceleration of a body that is let go in deep water of 2 cm a particle [m/s2].
double first_acceleration(Device& device, const Shape& shape, double height, double density) {
  Scene scene;
  scene.fluid.spacing = 0.02;
  scene.fluid.solver = PressureKind::grid_projected;
  scene.tank = {.lower = {0.0, 0.0, 0.0}, .upper = {0.64, 0.64, 0.7}};
  scene.water = {{{0.0, 0.0, 0.0}, {0.64, 0.64, 0.5}}};
  BodySettings body;
  body.name = "body";
  body.shape = shape;
  body.rest.position = {0.32, 0.32, height};
  body.motion.kind = MotionKind::free;
  body.motion.density = density;
  scene.bodies = {body};
  Simulation simulation(device, scene, {});
  static_cast<void>(simulation.advance());
  return simulation.bodies().state(0, simulation.seconds()).velocity[2] / simulation.seconds();
}

/// A flat disc that rises takes its added mass of water with it, 8/3 rho R^3 (Lamb, Hydrodynamics,
/// article 102), in the middle of a cell of the grid, which are 4 cm wide, and at its face.
TEST(FreeBody, TakesWaterWithItHoweverThin) {
  Device device;
  constexpr double kWater = 998.0;
  constexpr double kRadius = 0.1;
  constexpr double kDensity = 500.0;
  const double added = 8.0 / 3.0 * kWater * std::pow(kRadius, 3);
  for (const double thick : {0.02, 0.04}) {
    const double volume = M_PI * kRadius * kRadius * thick;
    const double wanted = 9.81 * (kWater - kDensity) * volume / (kDensity * volume + added);
    const double found = first_acceleration(
        device, {.kind = ShapeKind::cylinder, .size = {2.0 * kRadius, 2.0 * kRadius, thick}}, 0.26,
        kDensity);
    std::printf("%.0f mm thick: %.2f of %.2f m/s2\n", 1000.0 * thick, found, wanted);
    EXPECT_NEAR(found / wanted, 0.85, 0.3) << thick;
  }
}

TEST(FreeBody, ComesToRestAndThenCostsNothing) {
  Device device;
  Simulation simulation(device, pond("0.2", "density: 499"), {});
  // Water's own viscosity calms a pond late: here after 16 s.
  while (simulation.seconds() < 30.0 && simulation.totals().skipped.idle == 0U) {
    static_cast<void>(simulation.advance());
  }
  EXPECT_GT(simulation.totals().skipped.idle, 0U);
}

}  // namespace
}  // namespace splash::sim
