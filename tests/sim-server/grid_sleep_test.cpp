// SPDX-License-Identifier: MIT
// With the grid-projected solver all water sleeps or none: when nothing in it has moved for a while
// no step is computed, until something comes to it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/opencl_ledger.hpp"

namespace splash::sim {
namespace {

constexpr double kDepth = 0.15;    ///< of the water [m]
constexpr double kRadius = 0.05;   ///< of the ball [m]
constexpr double kSupport = 0.05;  ///< of the kernel [m]
constexpr double kRest = 0.003;    ///< slower water is at rest [m/s]

/// A tank with a sensor in its floor; `more`: whatever else there is.
Scene pond(const std::string& more) {
  return parse_scene(R"(
fluid: {spacing: 0.02, solver: grid_projected}
tank: {lower: [0, 0, 0], upper: [0.3, 0.3, 0.5]}
water: [{lower: [0, 0, 0], upper: [0.3, 0.3, 0.15]}]
gauges:
  probes:
    - {name: floor, kind: pressure, place: [0.15, 0.15, 0]}
)" + more,
                     "pond.yaml");
}

/// A ball; `motion`: how it moves, and where it is where that does not say so.
std::string ball(const std::string& motion) {
  return "bodies:\n"
         "  - name: ball\n"
         "    shape: {kind: sphere, size: [0.1, 0.1, 0.1]}\n" +
         motion;
}

std::string ball_at(double height, const std::string& motion) {
  return ball("    rest: {position: [0.15, 0.15, " + std::to_string(height) +
              "]}\n    motion: {kind: " + motion + "}\n");
}

/// One that comes down at 1 m/s from half a metre, 2 s after time began, and stops half in.
const std::string kHand = ball(
    "    motion: {kind: script, smooth: false, keyframes: [{time: 2, position: [0.15, 0.15, 0.5]}, "
    "{time: 2.35, position: [0.15, 0.15, 0.15]}]}\n");

/// One of half the water's density, afloat.
constexpr char kBox[] = R"(bodies:
  - name: box
    shape: {kind: box, size: [0.16, 0.16, 0.08]}
    rest: {position: [0.15, 0.15, 0.15]}
    motion: {kind: free, density: 500}
)";

void expect_same(const Snapshot& a, const Snapshot& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.id, b.id);
}

struct Rest {
  double slept_at = -1.0;  ///< when it first fell asleep [s]
  double woken_at = -1.0;  ///< when it first woke after that [s]
  double slept = 0.0;      ///< for how long [s]
  std::vector<DetectedImpact> impacts;
};

/// Until `seconds`.
Rest run(Simulation& simulation, double seconds) {
  Rest all;
  while (simulation.seconds() < seconds) {
    const double before = simulation.seconds();
    const std::uint64_t idle = simulation.totals().skipped.idle;
    const FrameResult frame = simulation.advance();
    EXPECT_FALSE(frame.step_fault) << describe(*frame.step_fault);
    const bool sleeps = simulation.totals().skipped.idle > idle;
    EXPECT_EQ(sleeps, frame.stats.asleep == simulation.particles());
    if (sleeps && all.slept_at < 0.0) all.slept_at = before;
    if (!sleeps && all.slept_at >= 0.0 && all.woken_at < 0.0) all.woken_at = before;
    if (sleeps) all.slept += frame.seconds - before;
    all.impacts.insert(all.impacts.end(), frame.found.impacts.begin(), frame.found.impacts.end());
  }
  return all;
}

TEST(GridSleep, BeginsASecondAfterTheWaterCameToRest) {
  Device device;
  Simulation simulation(device, pond(""), {});
  const Rest pool = run(simulation, 1.5);
  std::printf("asleep from %.3f s on\n", pool.slept_at);
  EXPECT_GE(pool.slept_at, 1.0);
  EXPECT_LT(pool.slept_at, 1.05);
  EXPECT_LT(pool.woken_at, 0.0);
}

TEST(GridSleep, AsksNothingOfTheDeviceAndMovesNothing) {
  Device device;
  Simulation simulation(device, pond(""), {});
  ASSERT_GT(run(simulation, 1.5).slept, 0.0);
  const Snapshot before = simulation.fluid().snapshot();
  const std::int64_t steps = simulation.totals().steps;
  device.queue().finish();
  bench::begin_ledger();
  for (int k = 0; k < 200; ++k) static_cast<void>(simulation.advance());
  EXPECT_EQ(bench::noted_commands(), bench::Commands{});
  EXPECT_TRUE(bench::end_ledger().empty());
  EXPECT_EQ(simulation.totals().steps, steps);
  expect_same(before, simulation.fluid().snapshot());
  const std::vector<int> moving =
      simulation.fluid().moving().read(device, static_cast<std::size_t>(simulation.particles()));
  EXPECT_EQ(moving, std::vector<int>(moving.size(), 0));
}

TEST(GridSleep, StillTellsThePressureOnTheFloor) {
  Device device;
  const Scene scene = pond("");
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  const auto floor = [&] {
    return gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies()).at(1);
  };
  static_cast<void>(run(simulation, 0.5));
  const double awake = floor();
  ASSERT_GT(run(simulation, 1.5).slept, 0.0);
  const double weight = scene.fluid.density * 9.81 * kDepth;
  std::printf("%.2f Pa awake, %.2f asleep, %.2f by weight\n", awake, floor(), weight);
  EXPECT_NEAR(floor(), awake, 1.0e-3 * weight);
  EXPECT_NEAR(floor(), weight, 0.01 * weight);
  EXPECT_EQ(floor(), floor());
  ASSERT_GT(run(simulation, 1.7).slept, 0.15) << "a look does not wake it";
}

// What the ball disturbs is the water in the support around it, and nothing while it is farther.
TEST(GridSleep, EndsWhenAHandComesIn) {
  Device device;
  Simulation simulation(device, pond(kHand), {});
  const Rest hand = run(simulation, 2.5);
  const double gap = 0.5 - kRadius - (hand.woken_at - 2.0) - kDepth;
  std::printf("woken at %.3f s, the hand %.3f m over the water\n", hand.woken_at, gap);
  EXPECT_GT(gap, 0.0);
  EXPECT_LT(gap, kSupport + 0.01);
  EXPECT_EQ(hand.impacts.size(), 1U);
}

TEST(GridSleep, IsNotDisturbedByWhatMovesHighAbove) {
  Device device;
  Simulation simulation(
      device,
      pond(ball("    motion: {kind: script, keyframes: [{time: 0, position: [0.1, 0.15, 0.4]}, "
                "{time: 3, position: [0.2, 0.2, 0.4]}]}\n")),
      {});
  EXPECT_LT(run(simulation, 1.5).slept_at, 1.05);
  EXPECT_GT(run(simulation, 2.0).slept, 0.45);
}

// A tracker sees the ball elsewhere, where no water is: it leaves a hole.
TEST(GridSleep, EndsWhenABodyIsGone) {
  Device device;
  Simulation simulation(device, pond(ball_at(0.1, "osc")), {});
  ASSERT_GT(run(simulation, 6.0).slept, 0.0);
  const double now = simulation.seconds();
  static_cast<void>(
      simulation.live_body(0)->push({0.15, 0.15, 0.4}, {0.0, 0.0, 0.0, 1.0}, {now, {}}));
  const Rest hole = run(simulation, now + 0.3);
  EXPECT_LT(hole.slept, 0.1);
  EXPECT_GT(simulation.fluid().stats().speed, 0.1);
}

// The ball falls for longer than the water takes to rest.
TEST(GridSleep, LetsAFreeBodyFallIntoTheWater) {
  Device device;
  Simulation simulation(device, pond(ball_at(10.0, "free, density: 500")), {});
  const Rest drop = run(simulation, 1.6);
  const double fall = std::sqrt(2.0 * (10.0 - kRadius - kDepth) / 9.81);
  ASSERT_EQ(drop.impacts.size(), 1U);
  EXPECT_NEAR(drop.impacts[0].time, fall, 0.02);
}

// It floats at rest, then the water beneath it sleeps, too, and both as they were.
TEST(GridSleep, HoldsAFloatThatRests) {
  Device device;
  Simulation simulation(device, pond(kBox), {});
  const Rest rest = run(simulation, 25.0);
  std::printf("asleep from %.2f s on, for %.2f s\n", rest.slept_at, rest.slept);
  ASSERT_GT(rest.slept, 1.0);
  const BodyState before = simulation.bodies().state(0, simulation.seconds());
  static_cast<void>(run(simulation, 25.5));
  const BodyState after = simulation.bodies().state(0, simulation.seconds());
  EXPECT_EQ(before.position, after.position);
  EXPECT_EQ(before.rotation, after.rotation);
}

TEST(GridSleep, NeverBeginsWhileAWaveMakerOrTheTankMoves) {
  Device device;
  for (const std::string moves :
       {"wave_maker: {stroke: 0.001, period: 10}\n",
        "tank_motion: {samples: [{time: 0}, {time: 5, acceleration: [0.001, 0, 0]}]}\n"}) {
    Simulation simulation(device, pond(moves), {});
    EXPECT_EQ(run(simulation, 2.0).slept, 0.0) << moves;
  }
}

TEST(GridSleep, IsLeftOutWhereTheSceneWantsIt) {
  Device device;
  for (const std::string skip : {"skip: {sleep: false}\n", "skip: {idle: false}\n"}) {
    Simulation simulation(device, pond(skip), {});
    EXPECT_EQ(run(simulation, 1.5).slept, 0.0) << skip;
  }
}

TEST(GridSleep, GivesTheSameBitsTwice) {
  std::vector<Snapshot> ends;
  for (int k = 0; k < 2; ++k) {
    Device device;
    Simulation simulation(device, pond(kHand), {});
    ASSERT_GT(run(simulation, 2.6).slept, 0.5);
    ends.push_back(simulation.fluid().snapshot());
  }
  expect_same(ends[0], ends[1]);
}

// What sleeps would have moved by its speed times that long at most.
TEST(GridSleep, ChangesNoImpact) {
  Device device;
  Simulation lazy(device, pond(kHand), {});
  Simulation busy(device, pond(kHand + "skip: {sleep: false}\n"), {});
  const Rest some = run(lazy, 2.6), all = run(busy, 2.6);
  ASSERT_GT(some.slept, 0.5);
  ASSERT_EQ(all.slept, 0.0);
  ASSERT_EQ(some.impacts.size(), 1U);
  ASSERT_EQ(all.impacts.size(), 1U);
  const DetectedImpact &a = some.impacts[0], &b = all.impacts[0];
  std::printf("impact at %.5f and %.5f s, %.5f and %.5f m/s\n", a.time, b.time, a.speed, b.speed);
  EXPECT_NEAR(a.time, b.time, kRest * some.slept / 1.0);
  EXPECT_NEAR(a.approach, b.approach, 0.05) << "as detection promises of any impact";
  EXPECT_NEAR(a.position[2], b.position[2], kRest * some.slept);
}

/// What a frame asks of the device for how the forces depend on the bodies' speeds.
std::int64_t rates_asked(Device& device, Simulation& simulation, FrameResult& frame) {
  device.queue().finish();
  bench::begin_ledger();
  frame = simulation.advance();
  device.queue().finish();
  std::map<std::string, bench::Launches> ledger = bench::end_ledger();
  // One answer in each step is to the water's flow.
  return ledger["ask_for_answer"].count - ledger["push_faces"].count;
}

// While little moves these are those of before, and no other than those that are found anew.
TEST(GridSleep, RatesOfStillBodiesAreFoundOnlyNowAndThen) {
  Device device;
  Simulation simulation(device, pond(ball_at(0.1, "osc")), {});
  FrameResult frame;
  while (simulation.seconds() < 0.5) frame = simulation.advance();
  simulation.feel(true);
  EXPECT_GE(rates_asked(device, simulation, frame), 6);
  int found = 0;
  for (int k = 0; k < 40; ++k) found += rates_asked(device, simulation, frame) > 0 ? 1 : 0;
  const Vector3 kept = frame.pushes.at(0).by_speed;
  std::printf("in %d of 40 frames, water at %.4f m/s\n", found, frame.stats.speed);
  EXPECT_LT(found, 20);
  simulation.feel(false);
  static_cast<void>(simulation.advance());
  simulation.feel(true);
  EXPECT_GE(rates_asked(device, simulation, frame), 6) << "nobody had felt it";
  for (std::size_t i = 0; i < 3; ++i) {
    const double anew = frame.pushes.at(0).by_speed[i];
    std::printf("%.4f N s/m, anew %.4f\n", kept[i], anew);
    EXPECT_NEAR(kept[i], anew, 0.02 * std::abs(anew));
    EXPECT_LT(anew, 0.0);
  }
}

}  // namespace
}  // namespace splash::sim
