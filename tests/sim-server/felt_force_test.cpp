// SPDX-License-Identifier: MIT
// The force of the water that those feel who ask for it: that of sums in double precision, the
// weight of what a held body displaces, also near the floor, all the momentum that the water gets
// of tracked and of grabbed bodies (on a grid: felt_momentum_test.cpp), and how it changes with the
// body's speed. While nobody asks nothing is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "sim-server/bodies/skin.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/gauge/body_push.hpp"
#include "sim-server/gauge/film_force.hpp"
#include "sim-server/gauge/water_state.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

const std::string kHeldBox = R"(
tank: {lower: [0, 0, 0], upper: [0.4, 0.4, 0.6]}
water: [{lower: [0, 0, 0], upper: [0.4, 0.4, 0.36]}]
bodies:
  - name: box
    shape: {size: [0.12, 0.12, 0.12]}
    motion: {kind: osc}
    rest: {position: [0.2, 0.2, 0.2]}
)";

constexpr double kFrame = 1.0 / 160.0;                            // [s]
constexpr double kDisplaced = 998.0 * 9.81 * 0.12 * 0.12 * 0.12;  ///< weight of the box's water [N]

/// The box in water of these settings.
Scene held(const std::string& fluid) {
  return parse_scene("fluid: {" + fluid + "}" + kHeldBox, "held.yaml");
}

BodyForce in_doubles(Simulation& simulation, Fluid& fluid) {
  return body_force(read_water(fluid, true), simulation.bodies().points(), 0,
                    simulation.bodies().state(0, simulation.seconds()));
}

TEST(FeltForce, IsThatOfSumsInDoublePrecision) {
  Device device;
  const Scene scene = held("spacing: 0.03, solver: weakly_compressible");
  Simulation simulation(device, scene, {});
  ASSERT_TRUE(simulation.can_feel());
  EXPECT_TRUE(simulation.advance().pushes.empty()) << "nobody asked";
  EXPECT_EQ(simulation.totals().felt, 0U);
  simulation.feel(true);
  BodyForce sum;
  double seconds = 0.0;
  simulation.set_hook([&](Fluid& fluid, Step& step, Moment moment) {
    if (moment != Moment::between) return;
    const BodyForce now = in_doubles(simulation, fluid);
    sum.force = sum.force + step.dt * now.force;
    sum.torque = sum.torque + step.dt * now.torque;
    seconds += step.dt;
  });
  for (int k = 0; k < 3; ++k) {
    sum = {};
    seconds = 0.0;
    const FrameResult frame = simulation.advance();
    ASSERT_EQ(frame.pushes.size(), 1U);
    const BodyPush& push = frame.pushes[0];
    EXPECT_EQ(push.body, 0);
    const double force = length(sum.force) / seconds;
    EXPECT_GT(force, 1.0);
    EXPECT_LT(length(push.force - (1.0 / seconds) * sum.force), 1.0e-4 * force);
    EXPECT_LT(length(push.torque - (1.0 / seconds) * sum.torque), 1.0e-4 * 0.12 * force);
  }
  EXPECT_EQ(simulation.totals().felt, 3U);
  simulation.feel(false);
  EXPECT_TRUE(simulation.advance().pushes.empty());
}

/// Mean force on the box over 40 frames, in its displaced weight [1].
Vector3 felt_share(const std::string& fluid, double height) {
  Device device;
  Scene scene = held(fluid);
  scene.bodies[0].rest.position[2] = height;
  Simulation simulation(device, scene, {});
  simulation.feel(true);
  Vector3 mean = {};
  constexpr int kFrames = 40;
  for (int k = 0; k < kFrames; ++k) {
    const FrameResult frame = simulation.advance();
    EXPECT_EQ(frame.pushes.size(), 1U);
    if (frame.pushes.empty()) return {};
    mean = mean + (1.0 / kFrames) * frame.pushes[0].force;
  }
  std::printf("%s, at %.3f m: %.4f %.4f %.4f of the displaced weight\n", fluid.c_str(), height,
              mean[0] / kDisplaced, mean[1] / kDisplaced, mean[2] / kDisplaced);
  return (1.0 / kDisplaced) * mean;
}

TEST(FeltForce, OfAHeldBoxIsTheWeightOfWhatItDisplaces) {
  for (const char* fluid :
       {"spacing: 0.02, solver: weakly_compressible", "spacing: 0.02, solver: grid_projected"}) {
    const Vector3 share = felt_share(fluid, 0.2);
    EXPECT_NEAR(share[2], 1.0, 0.03) << fluid;
    EXPECT_NEAR(share[0], 0.0, 0.02) << fluid;
  }
}

// Who asks while all water sleeps is told the same, and nothing wakes for longer than a frame.
TEST(FeltForce, InWaterThatSleepsIsThatWeightAsWell) {
  Device device;
  Simulation simulation(device, held("spacing: 0.02"), {});
  const std::uint64_t& idle = simulation.totals().skipped.idle;
  while (idle < 10 && simulation.seconds() < 10.0) static_cast<void>(simulation.advance());
  ASSERT_EQ(idle, 10U) << "it does not sleep";
  simulation.feel(true);
  double share = 0.0;
  for (int k = 0; k < 20; ++k) {
    const FrameResult frame = simulation.advance();
    ASSERT_EQ(frame.pushes.size(), 1U);
    share = frame.pushes[0].force[2] / kDisplaced;
    EXPECT_NEAR(share, 1.0, 0.03);
  }
  std::printf("asleep %.4f of the displaced weight\n", share);
  EXPECT_EQ(idle, 29U) << "one frame of the twenty was computed";
}

// No particle fits under it: without the film of water there it would lack what carries it.
TEST(FeltForce, OfABoxNextToTheFloorIsThatWeightAsWell) {
  EXPECT_NEAR(felt_share("spacing: 0.02, solver: weakly_compressible", 0.07)[2], 1.0, 0.03);
  // The gap is a quarter of a cell.
  EXPECT_NEAR(felt_share("spacing: 0.02, solver: grid_projected", 0.07)[2], 1.0, 0.1);
}

TEST(FeltForce, OfAFilmIsThatOfSumsInDoublePrecision) {
  Device device;
  Scene scene = held("spacing: 0.03, solver: weakly_compressible");
  scene.bodies[0].rest.position = {0.2, 0.2, 0.065};
  Simulation simulation(device, scene, {});
  simulation.feel(true);
  const auto skin = film_skin(scene.bodies[0].shape, 0, 0.03);
  const std::vector<BodyState> states = {simulation.bodies().state(0, 0.0)};
  Vector3 sum = {};
  Vector3 film = {};
  int step_number = 0;
  simulation.set_hook([&](Fluid& fluid, Step& step, Moment moment) {
    if (moment != Moment::between) return;
    const WaterState water = read_water(fluid, true);
    sum = sum + step.dt * body_force(water, simulation.bodies().points(), 0, states[0]).force;
    if (step_number++ > 0) return;  // the sums know of no past
    film =
        film_force(water, {scene, scene.tank, states}, simulation.bodies().points(), skin, 0).force;
  });
  const FrameResult frame = simulation.advance();
  const Vector3 by_film = frame.pushes.at(0).force - (1.0 / frame.seconds) * sum;
  std::printf("film %.3f N of %.3f N\n", by_film[2], film[2]);
  EXPECT_GT(std::abs(film[2]), 1.0);
  EXPECT_NEAR(by_film[2], film[2], 0.02 * std::abs(film[2]));
}

/// A ball of water that floats in the air without weight, and a plate that runs into it: the
/// momentum of the forces in what it gets [1].
double momentum_felt(bool grabbed, double speed, int frames) {
  Device device;
  const std::string motion =
      grabbed ? "motion: {kind: script, keyframes: [{time: 0, position: [-0.15, 0, 0.3]}]}"
              : "motion: {kind: osc}\n    rest: {position: [-0.15, 0, 0.3]}";
  const Scene scene = parse_scene(
      R"(fluid: {spacing: 0.02, gravity: [0, 0, 0], settle: never, sound_speed: 20}
tank: {lower: [-0.5, -0.3, 0], upper: [0.5, 0.3, 0.6]}
water: [{lower: [-0.1, -0.1, 0.2], upper: [0.1, 0.1, 0.4], form: sphere}]
bodies:
  - name: plate
    shape: {size: [0.06, 0.16, 0.16]}
    )" + motion +
          "\n",
      "ball.yaml");
  Simulation simulation(device, scene, {});
  simulation.feel(true);
  if (grabbed) {
    EXPECT_TRUE(simulation.advance().pushes.empty()) << "nobody holds it";
    simulation.live_body(0)->grab(true);
    static_cast<void>(simulation.advance());
  }
  Vector3 given = {};
  const auto momentum_now = [&] { return momentum(read_water(simulation.fluid(), false)).sum; };
  const Vector3 before = momentum_now();
  for (int k = 0; k < frames; ++k) {
    const double start = simulation.seconds();
    static_cast<void>(simulation.live_body(0)->push({-0.15 + speed * start, 0.0, 0.3},
                                                    {0.0, 0.0, 0.0, 1.0}, {start, {}}));
    const FrameResult frame = simulation.advance();
    if (grabbed && frame.pushes.empty() && k < 2) continue;  // it has not been held so long
    EXPECT_EQ(frame.pushes.size(), 1U);
    if (frame.pushes.empty()) return 0.0;
    given = given - (frame.seconds - start) * frame.pushes[0].force;
  }
  const Vector3 got = momentum_now() - before;
  std::printf("%s at %.1f m/s: momentum %.4f N s, by forces %.4f N s\n",
              grabbed ? "grabbed" : "tracked", speed, got[0], given[0]);
  EXPECT_GT(got[0], 0.3 * 4.18 * speed);
  return given[0] / got[0];
}

TEST(FeltForce, IsAllTheMomentumThatTheWaterGets) {
  EXPECT_NEAR(momentum_felt(false, 0.3, 70), 1.0, 0.005);
  EXPECT_NEAR(momentum_felt(false, 1.0, 22), 1.0, 0.005);
  EXPECT_NEAR(momentum_felt(true, 0.5, 45), 1.0, 0.005);
}

// The body moves on from the frame's first step at either of two speeds: the force of the second
// step differs by the rate. Without what rubs, which acts in one direction alone.
TEST(FeltForce, ChangesWithTheSpeedByItsRate) {
  Device device;
  const Scene scene = held("spacing: 0.03, artificial: 0");
  Simulation simulation(device, scene, {});
  simulation.feel(true);
  const Vector3 rate = simulation.advance().pushes.at(0).by_speed;
  const Snapshot water = simulation.fluid().snapshot();
  const double start = simulation.seconds();
  const auto force_at = [&](double speed) {
    simulation.resume(water, start);
    int step_number = 0;
    double found = 0.0;
    simulation.set_hook([&](Fluid& fluid, Step& step, Moment moment) {
      if (moment == Moment::before && step_number == 0) {
        const auto steps = static_cast<int>(std::lround(kFrame / step.dt));
        std::vector<BodyStep> all;
        for (int k = 0; k < steps; ++k) {
          BodyStep body = simulation.bodies().at(start).at(0);
          body.vz = static_cast<float>(speed);
          body.pz += static_cast<float>(speed * k * step.dt);
          all.push_back(body);
        }
        fluid.set_bodies(all);
      }
      if (moment == Moment::between && step_number == 1) {
        BodyState state = simulation.bodies().state(0, start);
        state.position[2] += speed * step.dt;
        state.velocity[2] = speed;
        found =
            body_force(read_water(fluid, true), simulation.bodies().points(), 0, state).force[2];
      }
      if (moment == Moment::between) ++step_number;
    });
    static_cast<void>(simulation.advance());
    return found;
  };
  constexpr double kSpeed = 0.05;
  const double change = (force_at(kSpeed) - force_at(-kSpeed)) / (2.0 * kSpeed);
  std::printf("dF/dv %.1f N s/m, by the rate %.1f\n", change, rate[2]);
  EXPECT_LT(change, 0.0);
  EXPECT_NEAR(rate[2] / change, 1.0, 0.1);
}

// The grid's pressures act at once: the body is faster from the frame's first step on, and so is
// the force of that frame.
TEST(FeltForce, OfWaterOnAGridChangesWithTheSpeedByItsRate) {
  Device device;
  Scene scene = held("spacing: 0.03, solver: grid_projected");
  scene.bodies[0].rest.rotation = from_turn({0.3, -0.2, 0.1});
  Simulation simulation(device, scene, {});
  simulation.feel(true);
  const BodyPush still = simulation.advance().pushes.at(0);
  const Snapshot water = simulation.fluid().snapshot();
  const double start = simulation.seconds();
  const auto push_at = [&](const std::function<void(BodyStep&)>& move) {
    simulation.resume(water, start);
    simulation.set_hook([&](Fluid& fluid, Step& step, Moment moment) {
      if (moment != Moment::before) return;
      EXPECT_EQ(step.first_body, 0) << "one step a frame";
      BodyStep body = simulation.bodies().at(start).at(0);
      move(body);
      fluid.set_bodies({body});
    });
    return simulation.advance().pushes.at(0);
  };
  constexpr double kSpeed = 0.05;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto moved = [&](double speed) {
      return push_at([&](BodyStep& body) {
        const std::array<float*, 6> part = {&body.vx, &body.vy, &body.vz,
                                            &body.wx, &body.wy, &body.wz};
        *part[e] = static_cast<float>(speed);
      });
    };
    const BodyPush up = moved(kSpeed), down = moved(-kSpeed);
    const auto of = [&](const BodyPush& push) {
      return e < 3 ? push.force[e] : push.torque[e - 3];
    };
    const double change = (of(up) - of(down)) / (2.0 * kSpeed);
    const double rate = e < 3 ? still.by_speed[e] : still.by_spin[e - 3];
    std::printf("part %zu: dF/dv %.4f, by the rate %.4f\n", e, change, rate);
    EXPECT_LT(change, 0.0);
    EXPECT_NEAR(rate / change, 1.0, 0.02);
  }
}

/// Measures the forces on body 0 as a gauge does.
Scene gauged(Scene scene) {
  GaugeSettings probe;
  probe.kind = GaugeKind::body;
  scene.gauges.probes = {probe};
  return scene;
}

TEST(MeasuredForce, IsTheWeightOfTheDisplacedWaterFromTheStartOn) {
  Device device;
  Scene scene = gauged(held("spacing: 0.03, solver: grid_projected"));
  scene.bodies[0].rest.rotation = from_turn({0.3, -0.2, 0.1});
  scene.bodies[0].rest.position = {0.21, 0.19, 0.2};
  Simulation simulation(device, scene, {});
  simulation.measure_forces();
  for (int k = 0; k < 4; ++k) {
    const BodyForce& found = simulation.bodies().force(0);
    std::printf("%.4f %.4f %.4f of the displaced weight, torque %.4f of it by the box's edge\n",
                found.force[0] / kDisplaced, found.force[1] / kDisplaced,
                found.force[2] / kDisplaced, length(found.torque) / (0.12 * kDisplaced));
    EXPECT_LT(length(found.force - Vector3{0.0, 0.0, kDisplaced}), 0.05 * kDisplaced);
    EXPECT_LT(length(found.torque), 0.02 * 0.12 * kDisplaced);
    EXPECT_TRUE(simulation.advance().pushes.empty()) << "nobody feels it";
  }
  simulation.feel(true);
  const BodyPush push = simulation.advance().pushes.at(0);
  EXPECT_EQ(push.force, simulation.bodies().force(0).force);
  EXPECT_EQ(push.torque, simulation.bodies().force(0).torque);
}

/// A thin disc that comes down flat sets in motion what a disc at the surface has of added mass,
/// 4/3 rho R^3 (Lamb, Hydrodynamics, article 102), wherever surface and disc are in cells and
/// steps.
TEST(MeasuredForce, OfADiscThatTouchesTheWaterFlatIsASlap) {
  Device device;
  constexpr double kRadius = 0.14;
  for (const double depth : {0.24, 0.26}) {
    for (const double phase : {0.0, 0.5}) {
      const double from = depth + 0.03 + phase * 0.005;
      char text[512];
      std::snprintf(
          text, sizeof text,
          "fluid: {spacing: 0.02, solver: grid_projected}\n"
          "tank: {lower: [0, 0, 0], upper: [0.8, 0.8, 0.4]}\n"
          "water: [{lower: [0, 0, 0], upper: [0.8, 0.8, %.3f]}]\n"
          "bodies:\n  - name: disc\n    shape: {kind: cylinder, size: [0.28, 0.28, 0.02]}\n"
          "    motion: {kind: script, smooth: false, keyframes: [{time: 0, position: [0.4, "
          "0.4, %.4f]}, {time: 0.2, position: [0.4, 0.4, %.4f]}]}\n",
          depth, from, from - 0.1);
      Simulation simulation(device, gauged(parse_scene(text, "slap.yaml")), {});
      simulation.measure_forces();
      double impulse = 0.0;
      const double ends = (from - depth) / 0.5;  // 1 cm in the water
      while (simulation.seconds() < ends) {
        const double before = simulation.seconds();
        static_cast<void>(simulation.advance());
        impulse += (simulation.seconds() - before) * simulation.bodies().force(0).force[2];
      }
      const double part = impulse / (4.0 / 3.0 * 998.0 * std::pow(kRadius, 3) * 0.5);
      std::printf("water of %.2f m, phase %.1f: %.2f of the slap\n", depth, phase, part);
      // With what the water pushes after the slap it is 1.2; a disc of 14 spacings gets more, as
      // hats smooth away the flow around its rim, which it then drives anew.
      EXPECT_NEAR(part, 1.5, 0.45) << depth << ' ' << phase;
    }
  }
}

TEST(FeltForce, IsNoneOfAFreeBody) {
  Device device;
  Scene free = held("spacing: 0.03");
  free.bodies[0].motion.kind = MotionKind::free;
  free.bodies[0].motion.density = 900.0;
  EXPECT_FALSE(Simulation(device, free, {}).can_feel());
}

}  // namespace
}  // namespace splash::sim
