// SPDX-License-Identifier: MIT
// What examples/force gives a hand: never a step, never more than is allowed, nothing once the
// simulator is silent, and, at the port of a simulated device, no energy that the hand has not
// given before.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>
#include <random>

#include "examples/force/splash_force.hpp"

namespace splash_force {
namespace {

constexpr double kTurn = 0.001;  ///< of the device's loop [s]

Model pushing(double force, std::int32_t session = 1) {
  Model model;
  model.session = session;
  model.wrench.force = {0.0, 0.0, force};
  return model;
}

Safety plain() {
  Safety safety;
  safety.passive = false;
  return safety;
}

TEST(ForceModel, GrowsFromNothingAndNeverSteps) {
  ForceModel model(plain());
  double before = 0.0;
  double now = 0.0;
  for (; now < 1.0; now += kTurn) {
    if (std::fmod(now, 0.006) < kTurn) model.take(pushing(4.0), now);
    const double force = model.force({}, {}, {}, now).force[2];
    EXPECT_LE(std::abs(force - before), 200.0 * 1.01 * kTurn) << now;
    EXPECT_TRUE(now >= 0.25 || force < 2.1) << now;
    before = force;
  }
  EXPECT_NEAR(before, 4.0, 1.0e-6);
  // A simulator that was started anew begins as softly, by the slew limit at the latest.
  model.take(pushing(4.0, 2), now);
  for (int k = 0; k < 50; ++k) {
    const double force = model.force({}, {}, {}, now).force[2];
    EXPECT_LE(std::abs(force - before), 200.0 * 1.01 * kTurn);
    before = force;
    now += kTurn;
  }
  EXPECT_LT(before, 0.5);
}

TEST(ForceModel, IsZeroAfterFiftyMillisecondsOfSilenceAndFadesBefore) {
  ForceModel model(plain());
  double now = 0.0;
  for (; now < 1.0; now += kTurn) {
    model.take(pushing(2.0), now);
    model.force({}, {}, {}, now);
  }
  const double last = now - kTurn;
  double before = 2.0;
  for (; now < last + 0.1; now += kTurn) {
    const double force = model.force({}, {}, {}, now).force[2];
    EXPECT_LE(before - force, 200.0 * 1.01 * kTurn) << "a ramp, no step";
    EXPECT_TRUE(now < last + 0.05 || force == 0.0) << now;
    before = force;
  }
  model.take(pushing(2.0), now);
  EXPECT_LT(model.force({}, {}, {}, now + kTurn).force[2], 0.05) << "and begins softly";
}

// The largest force fades to nothing within the silence, and no faster than the slew limit, be the
// last part of the silence ever so short.
TEST(ForceModel, FadesTheLargestForceWithoutAStep) {
  for (const double fade : {0.02, 0.001}) {
    Safety safety = plain();
    safety.fade = fade;
    ForceModel model(safety);
    double now = 0.0;
    for (; now < 1.0; now += kTurn) {
      model.take(pushing(50.0), now);
      model.force({}, {}, {}, now);
    }
    const double last = now - kTurn;
    double before = safety.max_force;
    for (; now < last + 0.06; now += kTurn) {
      const double force = model.force({}, {}, {}, now).force[2];
      EXPECT_LE(before - force, 200.0 * 1.01 * kTurn) << fade << " " << now - last;
      EXPECT_TRUE(now < last + 0.05 || force == 0.0) << now - last;
      before = force;
    }
  }
}

TEST(ForceModel, NeverExceedsItsLimitsNorBelievesWhatIsNoNumber) {
  Safety safety = plain();
  safety.ramp = 0.0;
  ForceModel model(safety);
  Model wild = pushing(1.0e9);
  wild.by_speed = {-1.0e9, 1.0e9, -1.0e9};
  wild.wrench.torque = {9.0, 0.0, 0.0};
  const double none = std::numeric_limits<double>::quiet_NaN();
  Model broken = pushing(none);
  for (double now = 0.0; now < 0.5; now += kTurn) {
    model.take(wild, now);
    model.take(broken, now);
    const Wrench wrench = model.force({}, {50.0, -50.0, 3.0}, {}, now);
    const double size = std::hypot(wrench.force[0], wrench.force[1], wrench.force[2]);
    ASSERT_LE(size, safety.max_force * 1.000001);
    ASSERT_LE(std::abs(wrench.torque[0]), safety.max_torque * 1.000001);
  }
  const Wrench lost = model.force({none, 0.0, 0.0}, {}, {}, 0.5);
  EXPECT_EQ(lost.force[2], 0.0);
}

TEST(ForceModel, ExtrapolatesBySpeedWithinItsDamping) {
  Safety safety = plain();
  safety.ramp = 0.0;
  safety.slew = 1.0e9;
  ForceModel model(safety);
  Model told = pushing(1.0);
  told.velocity = {0.0, 0.0, 0.2};
  told.by_speed = {0.0, 0.0, -3.0};
  model.take(told, 0.0);
  model.force({}, {}, {}, 0.0);
  EXPECT_NEAR(model.force({}, {0.0, 0.0, -0.1}, {}, 0.001).force[2], 1.0 + 3.0 * 0.3, 1.0e-12);
  told.by_speed = {0.0, 0.0, -3000.0};
  model.take(told, 0.002);
  EXPECT_NEAR(model.force({}, {0.0, 0.0, -0.1}, {}, 0.002).force[2], 1.0 + 5.0 * 0.3, 1.0e-12);
}

TEST(ForceModel, ReadsTheSimulatorsPackets) {
  std::vector<char> bytes = {'#', 'b', 'u', 'n', 'd', 'l', 'e', '\0'};
  osc::put_int(bytes, 1);
  osc::put_int(bytes, 2);
  const auto put = [&](const std::string& address, const std::string& types,
                       const std::vector<double>& values) {
    std::vector<char> one;
    osc::put_text(one, address);
    osc::put_text(one, types);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (types[i + 1] == 'i') osc::put_int(one, static_cast<std::uint32_t>(values[i]));
      if (types[i + 1] == 'f') osc::put_float(one, values[i]);
    }
    osc::put_int(bytes, static_cast<std::uint32_t>(one.size()));
    bytes.insert(bytes.end(), one.begin(), one.end());
  };
  put("/frame", ",iiif", {77, 5, 9, 0.5});
  put("/force", ",iffffff", {4, 9, 9, 9, 9, 9, 9});
  put("/body/at", ",ifffffff", {3, 1, 2, 3, 0, 0, 0, 1});
  put("/body/twist", ",iffffff", {3, 0.5, 0, 0, 0, 0, 0.25});
  put("/force", ",iffffff", {3, 1, -2, 3, 0.5, 0, 0});
  put("/force/rate", ",iffffff", {3, -1, -2, -3, 0, 0, -0.5});
  Model model;
  ASSERT_TRUE(osc::take_packet(bytes.data(), bytes.size(), 3, model));
  EXPECT_EQ(model.session, 77);
  EXPECT_EQ(model.velocity[0], 0.5);
  EXPECT_EQ(model.spin[2], 0.25);
  EXPECT_EQ(model.wrench.force[1], -2.0);
  EXPECT_EQ(model.wrench.torque[0], 0.5);
  EXPECT_EQ(model.by_speed[2], -3.0);
  EXPECT_EQ(model.by_spin[2], -0.5);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<char> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(osc::take_packet(cut.data(), cut.size(), 3, model)) << size;
  }
}

/// A hand-sized box in water, as a formula: its buoyancy, the drag of a plate, and its added mass
/// by the change of its speed from frame to frame.
struct Water {
  double area = 0.18 * 0.09;  ///< [m2]
  double height = 0.04;       ///< [m]
  double speed_before = 0.0;

  /// `z`: of its middle above the surface [m].
  double force(double z, double speed, double seconds) {
    const double wet = std::clamp(0.5 * height - z, 0.0, height) / height;
    const double buoyancy = 998.0 * 9.81 * area * height * wet;
    const double drag = -0.5 * 998.0 * 1.2 * area * wet * speed * std::abs(speed);
    const double mass = 0.3 * wet;
    const double inertia = -mass * (speed - speed_before) / seconds;
    speed_before = speed;
    return buoyancy + drag + inertia;
  }
};

/// What holds the device: a spring and a damper that draw it to where it is to go.
struct Grip {
  double stiffness = 500.0;  ///< [N/m]
  double damping = 3.0;      ///< [N s/m]
  double mass = 0.3;         ///< of the device [kg]
  double way = 0.04;         ///< that it is to go to either side [m]
};

struct Outcome {
  double gained = 0.0;    ///< most energy that the device ever had more than it gave [J]
  double roughest = 0.0;  ///< largest change of the force in a turn [N]
  double work = 0.0;      ///< that went to and fro [J]
};

/// A device in a hand that pushes it in and out of the water for a minute. Poses reach
/// the simulator within a frame, forces come a frame later, unevenly, and one in fifty is lost.
Outcome push_in_and_out(const Safety& safety, double real_time_factor, double hertz,
                        const Grip& grip = {}) {
  std::mt19937 chance(7);
  std::uniform_real_distribution<double> jitter(0.0, 0.004);
  const double frame = 1.0 / 160.0;
  ForceModel model(safety);
  Water water;
  std::deque<std::pair<double, Model>> under_way;
  double z = 0.03, v = 0.0, z_seen = z, v_seen = 0.0, next_frame = 0.0;
  double energy = 0.0, force = 0.0;
  Outcome run;
  for (double now = 0.0; now < 60.0; now += kTurn) {
    if (now >= next_frame) {
      // What was seen a frame ago is what is computed now.
      Model told = pushing(water.force(z_seen, v_seen, frame / real_time_factor));
      told.velocity = {0.0, 0.0, v_seen};
      told.by_speed = {-4.0, -4.0, -4.0};
      z_seen = z;
      v_seen = v;
      next_frame += frame / real_time_factor;
      if (chance() % 50 != 0) {
        under_way.emplace_back(now + frame / real_time_factor + jitter(chance), told);
      }
    }
    while (!under_way.empty() && under_way.front().first <= now) {
      model.take(under_way.front().second, now);
      under_way.pop_front();
    }
    const double before = force;
    force = model.force({0.0, 0.0, z}, {0.0, 0.0, v}, {}, now).force[2];
    run.roughest = std::max(run.roughest, std::abs(force - before));
    const double wanted = grip.way * std::sin(2.0 * 3.14159265358979 * hertz * now);
    // The force is held until the next turn; the motion in between is followed in finer steps.
    for (int part = 0; part < 10; ++part) {
      const double dt = kTurn / 10.0;
      const double hand = grip.stiffness * (wanted - z) - grip.damping * v;
      v += dt * (force + hand) / grip.mass;
      const double way = dt * v;
      z += way;
      energy -= force * way;
      run.work += std::abs(force * way);
      run.gained = std::max(run.gained, -energy);
    }
  }
  return run;
}

TEST(ForceModel, GivesADeviceNoEnergy) {
  for (const double factor : {1.0, 0.3}) {
    for (const double hertz : {0.25, 0.5, 1.0, 2.0, 3.0}) {
      const Outcome run = push_in_and_out({}, factor, hertz);
      std::printf("x %.1f, %.2f Hz: gained %.3f mJ of %.2f J, roughest %.2f N\n", factor, hertz,
                  1e3 * run.gained, run.work, run.roughest);
      EXPECT_LT(run.gained, 1.0e-3) << factor << " " << hertz;
      EXPECT_LE(run.roughest, 200.0 * 1.01 * kTurn) << "what leaves keeps the slew limit";
      EXPECT_GT(run.work, 0.5);
    }
  }
}

// A stiff grip on a light device, and a hand that shakes a heavy one, speed up several times as
// fast.
TEST(ForceModel, GivesADeviceNoEnergyInAnyGrip) {
  for (const double factor : {1.0, 0.3}) {
    for (const double stiffness : {30.0, 450.0, 2700.0}) {
      for (const double mass : {0.07, 0.2, 1.0}) {
        for (const double hertz : {0.2, 1.7, 7.9}) {
          const Outcome run = push_in_and_out({}, factor, hertz, {stiffness, 1.5, mass, 0.02});
          EXPECT_LT(run.gained, 1.0e-3)
              << factor << " " << stiffness << " " << mass << " " << hertz;
        }
      }
    }
  }
}

// In circles, down into the water and out of it askew: a force across the motion, and one that
// turns.
TEST(ForceModel, GivesADeviceNoEnergyInCircles) {
  for (const double hertz : {0.3, 1.0, 2.5}) {
    ForceModel model;
    Vector x = {0.0, 0.0, 0.0}, v = {0.0, 0.0, 0.0}, f = {0.0, 0.0, 0.0};
    double energy = 0.0, gained = 0.0, work = 0.0;
    std::deque<std::pair<double, Model>> under_way;
    double next = 0.0;
    for (double now = 0.0; now < 30.0; now += kTurn) {
      if (now >= next) {  // a late spring to the middle, and a stream that turns about it
        Model told;
        told.session = 1;
        told.wrench.force = {-60.0 * x[0] - 20.0 * x[1], 20.0 * x[0] - 60.0 * x[1],
                             4.0 - 60.0 * x[2]};
        told.velocity = v;
        told.by_speed = {-2.0, -2.0, -2.0};
        next += 1.0 / 160.0;
        under_way.emplace_back(now + 0.02, told);
      }
      while (!under_way.empty() && under_way.front().first <= now) {
        model.take(under_way.front().second, now);
        under_way.pop_front();
      }
      const Vector before = f;
      f = model.force(x, v, {}, now).force;
      const Vector step = {f[0] - before[0], f[1] - before[1], f[2] - before[2]};
      EXPECT_LE(std::hypot(step[0], step[1], step[2]), 200.0 * 1.01 * kTurn);
      const double phase = 2.0 * 3.14159265358979 * hertz * now;
      const Vector wanted = {0.05 * std::sin(phase), 0.05 * std::cos(phase),
                             0.05 * std::sin(0.7 * phase)};
      for (int part = 0; part < 10; ++part) {
        const double dt = kTurn / 10.0;
        for (std::size_t i = 0; i < 3; ++i) {
          v[i] += dt * (f[i] + 500.0 * (wanted[i] - x[i]) - 3.0 * v[i]) / 0.3;
          const double way = dt * v[i];
          x[i] += way;
          energy -= f[i] * way;
          work += std::abs(f[i] * way);
        }
        gained = std::max(gained, -energy);
      }
    }
    std::printf("circles, %.1f Hz: gained %.3f mJ of %.2f J\n", hertz, 1e3 * gained, work);
    EXPECT_LT(gained, 1.0e-3) << hertz;
    EXPECT_GT(work, 0.5);
  }
}

}  // namespace
}  // namespace splash_force
