// SPDX-License-Identifier: MIT
// A body that hangs on a device by a spring: it sags by its weight less its buoyancy, swings as a
// mass on a spring does, and what the device feels is all that the spring gives. A simulated device
// that pushes it in and out of the water gets no energy out of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>

#include "examples/force/splash_force.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

constexpr double kGravity = 9.81;       // [m/s2]
constexpr double kFrame = 1.0 / 160.0;  // [s]

constexpr char kOfParticles[] = "spacing: 0.033";
constexpr char kOnGrid[] = "spacing: 0.025, solver: grid_projected";

/// A cube of a litre on a spring, at this height.
Scene scene_of(const std::string& height, const std::string& spring,
               const std::string& fluid = kOfParticles) {
  return parse_scene("fluid: {" + fluid + R"(}
tank: {lower: [0, 0, 0], upper: [0.4, 0.4, 1.6]}
water: [{lower: [0, 0, 0], upper: [0.4, 0.4, 0.4]}]
bodies:
  - name: cube
    shape: {size: [0.1, 0.1, 0.1]}
    motion: {kind: osc, coupling: spring, device_damping: 100, )" +
                         spring + R"(}
    rest: {position: [0.2, 0.2, )" +
                         height + "]}\n",
                     "cube.yaml");
}

BodyState cube(const Simulation& simulation) {
  return simulation.bodies().state(0, simulation.seconds());
}

/// The device is there now.
void pose(Simulation& simulation, const Vector3& place,
          const Quaternion& turn = {0.0, 0.0, 0.0, 1.0}) {
  static_cast<void>(simulation.live_body(0)->push(place, turn, {simulation.seconds(), {}}));
}

Vector3 felt(const FrameResult& frame) {
  return frame.pushes.size() == 1U ? frame.pushes[0].force : Vector3{NAN, NAN, NAN};
}

void expect_sag(Device& device, bool wet, const std::string& fluid) {
  Simulation simulation(
      device, scene_of(wet ? "0.28" : "1.2", "mass: 2, stiffness: 200, damping: 30", fluid), {});
  ASSERT_TRUE(simulation.can_feel());
  simulation.feel(true);
  while (simulation.seconds() < 2.0) static_cast<void>(simulation.advance());
  double mean = 0.0, sag = 0.0;
  constexpr int kFrames = 40;
  for (int k = 0; k < kFrames; ++k) {
    mean += felt(simulation.advance())[2] / kFrames;
    sag += ((wet ? 0.28 : 1.2) - cube(simulation).position[2]) / kFrames;
  }
  const double load = (2.0 - (wet ? 0.998 : 0.0)) * kGravity;
  std::printf("%s, %s: felt %.4f N, sag %.5f m, of %.4f N and %.5f m\n", fluid.c_str(),
              wet ? "in water" : "in air", mean, sag, -load, load / 200.0);
  EXPECT_NEAR(mean / -load, 1.0, wet ? 0.03 : 1.0e-3);
  EXPECT_NEAR(sag / (load / 200.0), 1.0, wet ? 0.03 : 1.0e-3);
}

TEST(Spring, SagsByTheWeightInTheAirAndByThatLessTheBuoyancyInWater) {
  Device device;
  for (const char* fluid : {kOfParticles, kOnGrid}) {
    for (const bool wet : {false, true}) expect_sag(device, wet, fluid);
  }
}

/// Expects what swings downwards through its middle then to do so as 0.5 kg on 50 N/m do.
void expect_swing(const std::vector<double>& crossings, std::size_t least) {
  ASSERT_GE(crossings.size(), least);
  const double period = 2.0 * M_PI * std::sqrt(0.5 / 50.0);
  const double found =
      (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  std::printf("period %.5f s of %.5f s\n", found, period);
  EXPECT_NEAR(found / period, 1.0, 0.01);
}

// It begins to fall on a slack spring, so it swings about where it would hang.
TEST(Spring, SwingsAsAMassOnItDoes) {
  Device device;
  Simulation simulation(device, scene_of("1.2", "mass: 0.5, stiffness: 50"), {});
  const double sag = 0.5 * kGravity / 50.0;
  std::vector<double> crossings;
  double above = sag;
  while (simulation.seconds() < 3.0) {
    static_cast<void>(simulation.advance());
    const double now = cube(simulation).position[2] - (1.2 - sag);
    if (above > 0.0 && now <= 0.0) {
      crossings.push_back(simulation.seconds() - kFrame * now / (now - above));
    }
    above = now;
  }
  expect_swing(crossings, 4);
}

// The device is turned by half a radian and held; a cube's moments of inertia are alike.
TEST(Spring, TurnsAsFastAsItSwings) {
  Device device;
  Simulation simulation(device, scene_of("1.2", "mass: 0.5, stiffness: 50"), {});
  std::vector<double> crossings;
  double before = 0.0;
  while (simulation.seconds() < 3.0) {
    const double now = simulation.seconds();
    pose(simulation, {0.2, 0.2, 1.2}, from_turn({0.0, 0.0, 0.5}));
    static_cast<void>(simulation.advance());
    const double angle = to_turn(cube(simulation).rotation)[2] - 0.5;
    if (now > 0.6 && before > 0.0 && angle <= 0.0) {
      crossings.push_back(simulation.seconds() - kFrame * angle / (angle - before));
    }
    before = angle;
  }
  expect_swing(crossings, 3);
}

void expect_all_momentum(const std::string& fluid) {
  Device device;
  Simulation simulation(device, scene_of("1.2", "mass: 0.5, stiffness: 80, damping: 2", fluid), {});
  simulation.feel(true);
  Vector3 given = {};
  Vector3 turned = {};
  while (simulation.seconds() < 0.8) {
    const double now = simulation.seconds();
    const Quaternion turn = from_turn({0.0, 0.0, 0.4 * std::sin(4.0 * now)});
    pose(simulation, {0.2 + 0.05 * std::sin(5.0 * now), 0.2, 1.2}, turn);
    const FrameResult frame = simulation.advance();
    ASSERT_EQ(frame.pushes.size(), 1U);
    const double seconds = frame.seconds - now;
    given = given - seconds * frame.pushes[0].force + Vector3{0.0, 0.0, -0.5 * kGravity * seconds};
    turned = turned - seconds * frame.pushes[0].torque;
    EXPECT_EQ(frame.pushes[0].by_speed[0], -2.0);
  }
  const BodyState state = cube(simulation);
  EXPECT_GT(length(state.velocity), 0.1);
  EXPECT_LT(length(given - 0.5 * state.velocity), 1.0e-4) << "N s";
  const double inertia = 0.5 * 0.1 * 0.1 / 6.0;
  EXPECT_GT(std::abs(state.spin[2]), 0.1);
  EXPECT_LT(length(turned - inertia * state.spin), 1.0e-5) << "N m s";
}

TEST(Spring, TellsAllTheMomentumThatItGives) {
  for (const char* fluid : {kOfParticles, kOnGrid}) expect_all_momentum(fluid);
}

TEST(Spring, NeverPullsAtOnceWhenPosesBeginOrJump) {
  Device device;
  Simulation simulation(device, scene_of("0.7", "mass: 1, stiffness: 200, damping: 10"), {});
  simulation.feel(true);
  double before = 0.0, steepest = 0.0, farthest = 0.0;
  Vector3 place = {0.2, 0.2, 0.7};
  while (simulation.seconds() < 4.0) {
    const double now = simulation.seconds();
    if (now > 1.0) place = {0.3, 0.1, 0.9};   // the first pose is elsewhere
    if (now > 2.5) place = {0.1, 0.3, 0.75};  // and the tracker jumps
    if (now > 1.0) pose(simulation, place);
    const double force = length(felt(simulation.advance()));
    if (now > 0.9) {
      steepest = std::max(steepest, std::abs(force - before));
      farthest = std::max(farthest, force);
    }
    before = force;
  }
  std::printf("steepest %.2f N a frame, most %.1f N\n", steepest, farthest);
  EXPECT_LT(steepest, 2.0) << "a jump of 0.3 m would be 60 N at once";
  EXPECT_LT(length(cube(simulation).position - place - Vector3{0.0, 0.0, -kGravity / 200.0}), 0.01)
      << "and it is there in the end";
}

TEST(Spring, IsSoundAfterAFrameWentWrongAndWhenTheSceneBeginsAnew) {
  Device device;
  Simulation simulation(device, scene_of("0.4", "mass: 0.7, stiffness: 100, damping: 5"), {});
  simulation.feel(true);
  const auto play = [&](double seconds, const Vector3& place) {
    double most = 0.0;
    for (const double end = simulation.seconds() + seconds; simulation.seconds() < end;) {
      pose(simulation, place);
      const double force = length(felt(simulation.advance()));
      EXPECT_TRUE(std::isfinite(force));
      most = std::max(most, force);
    }
    return most;
  };
  play(0.5, {0.2, 0.2, 0.4});
  const double calm = play(0.1, {0.2, 0.2, 0.4});
  int harms = 0;
  simulation.set_hook([&](Fluid& fluid, Step& /*step*/, Moment moment) {
    if (moment != Moment::between || harms++ > 0) return;
    std::vector<float> harmed = fluid.pressure_term().read(fluid.device(), 16);
    harmed[3] = std::numeric_limits<float>::quiet_NaN();
    Buffer<float> buffer = fluid.pressure_term();
    buffer.write(fluid.device(), harmed);
  });
  const FrameResult frame = simulation.advance();
  ASSERT_TRUE(frame.step_fault);
  EXPECT_LT(length(felt(frame)), 2.0 * calm + 1.0);
  simulation.set_hook({});
  play(0.1, {0.2, 0.2, 0.4});
  play(0.5, {0.25, 0.2, 0.55});
  simulation.restart();
  EXPECT_NEAR(cube(simulation).position[2], 0.4, 1.0e-6);
  EXPECT_LT(play(0.02, {0.25, 0.2, 0.55}), 3.0) << "the spring was slack";
  play(1.0, {0.25, 0.2, 0.55});
  EXPECT_NEAR(cube(simulation).position[0], 0.25, 0.01);
}

/// A device of 0.3 kg in a hand, at 1 kHz, that pushes the cube in and out of the water: the energy
/// that it ever had more of than it gave [J], and what went to and fro.
struct Outcome {
  double gained = 0.0;
  double work = 0.0;
};

Outcome push_in_and_out(Simulation& simulation, double factor, double seconds) {
  constexpr double kTurn = 0.001;
  splash_force::ForceModel model;
  std::deque<std::pair<double, splash_force::Model>> under_way;
  double z = 0.45, v = 0.0, energy = 0.0, next = 0.0;
  Outcome run;
  for (double now = 0.0; now < seconds; now += kTurn) {
    static_cast<void>(simulation.live_body(0)->push({0.2, 0.2, z}, {0, 0, 0, 1}, {now, {}}));
    if (now >= next) {
      simulation.set_origin(now - simulation.seconds());
      const FrameResult frame = simulation.advance();
      next += kFrame / factor;
      splash_force::Model told;
      told.session = 1;
      told.wrench.force = frame.pushes.at(0).force;
      told.velocity = frame.pushes.at(0).velocity;
      told.by_speed = frame.pushes.at(0).by_speed;
      under_way.emplace_back(next, told);
    }
    while (!under_way.empty() && under_way.front().first <= now) {
      model.take(under_way.front().second, now);
      under_way.pop_front();
    }
    const double force = model.force({0.2, 0.2, z}, {0.0, 0.0, v}, {}, now).force[2];
    const double wanted = 0.43 + 0.06 * std::sin(2.0 * M_PI * 0.7 * now);
    for (int part = 0; part < 10; ++part) {
      const double dt = kTurn / 10.0;
      v += dt * (force + 500.0 * (wanted - z) - 3.0 * v) / 0.3;
      const double way = dt * v;
      z += way;
      energy -= force * way;
      run.work += std::abs(force * way);
      run.gained = std::max(run.gained, -energy);
    }
  }
  return run;
}

void expect_no_energy(const Scene& scene, double seconds) {
  Device device;
  for (const double factor : {1.0, 0.3}) {
    Simulation simulation(device, scene, {});
    simulation.feel(true);
    const Outcome run = push_in_and_out(simulation, factor, seconds);
    std::printf("x %.1f: gained %.3f mJ of %.2f J\n", factor, 1.0e3 * run.gained, run.work);
    EXPECT_LT(run.gained, 1.0e-3);
    EXPECT_GT(run.work, 0.1);
  }
}

Scene light(const std::string& solver) {
  return scene_of("0.45", "mass: 0.6, stiffness: 60, damping: 1", "particles: 600" + solver);
}

/// The device is where the cube is.
Scene direct_on_grid() {
  Scene scene = light(", solver: grid_projected");
  scene.bodies[0].motion.coupling = CouplingKind::direct;
  return scene;
}

TEST(Spring, GivesADeviceNoEnergy) {
  expect_no_energy(light(""), 8.0);
  expect_no_energy(light(", solver: grid_projected"), 8.0);
}

TEST(Spring, GivesADeviceNoEnergyInAMinute) {
  expect_no_energy(light(""), 60.0);
  expect_no_energy(light(", solver: grid_projected"), 60.0);
}

TEST(Direct, WaterOnAGridGivesADeviceNoEnergy) {
  expect_no_energy(direct_on_grid(), 8.0);
}

TEST(Direct, WaterOnAGridGivesADeviceNoEnergyInAMinute) {
  expect_no_energy(direct_on_grid(), 60.0);
}

// A box as a mesh whose file has its origin in a corner: poses and torques are of that corner.
TEST(Spring, HoldsAMeshWhereItsFileHasItsOrigin) {
  const tests::TemporaryFolder folder;
  const std::string file =
      folder.write("cube.obj",
                   "v 0 0 0\nv .1 0 0\nv .1 .1 0\nv 0 .1 0\nv 0 0 .1\nv .1 0 .1\nv .1 .1 .1\n"
                   "v 0 .1 .1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const std::string motion =
      "    motion: {kind: osc, coupling: spring, device_damping: 100, mass: 0.5, stiffness: 100, "
      "damping: 20}\n";
  const Scene scene = parse_scene(
      "fluid: {spacing: 0.033}\ntank: {lower: [0, 0, 0], upper: [0.4, 0.4, 1.6]}\n"
      "water: [{lower: [0, 0, 0], upper: [0.4, 0.4, 0.2]}]\nbodies:\n  - name: cube\n"
      "    shape: {mesh: " +
          file + "}\n" + motion + "    rest: {position: [0.2, 0.2, 1.2]}\n",
      "mesh.yaml");
  Device device;
  Simulation simulation(device, scene, {});
  simulation.feel(true);
  const Quaternion turn = from_turn({0.0, 0.0, 1.2});
  const Vector3 corner = {0.25, 0.15, 1.1};
  FrameResult frame;
  while (simulation.seconds() < 2.5) {
    pose(simulation, corner, turn);
    frame = simulation.advance();
  }
  const BodyState state = cube(simulation);
  const Vector3 middle = corner + rotate(turn, {0.05, 0.05, 0.05});
  const Vector3 sag = {0.0, 0.0, -0.5 * kGravity / 100.0};
  EXPECT_LT(length(state.position - middle - sag), 1.0e-3);
  EXPECT_LT(length(to_turn(compose(state.rotation, inverse(turn)))), 0.01);
  const BodyPush& push = frame.pushes.at(0);
  const Vector3 weight = {0.0, 0.0, -0.5 * kGravity};
  EXPECT_LT(length(push.force - weight), 0.01);
  EXPECT_LT(length(push.torque - cross(middle - corner, weight)), 0.003);
  EXPECT_LT(length(push.velocity), 1.0e-3);
}

}  // namespace
}  // namespace splash::sim
