// SPDX-License-Identifier: MIT
// Water that is put to sleep, and a box that wakes some of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sim-server/scene/initial_fluid.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {

inline constexpr SleepRule kRule = {.speed = 0.05, .frames = 3};
inline constexpr double kDt = 1.0e-3;

/// A trough 1.2 m long; a box hangs above its left end and comes down when it is told to.
class Sleeping : public ::testing::TestWithParam<int> {
 protected:
  Sleeping() : device_(-1, false, GetParam()) {
    water_.scene = tank_scene(0.03, {1.2, 0.24, 0.6}, 0.12);
    water_.scene.bodies = {body_of("box", {ShapeKind::box, {0.12, 0.12, 0.06}})};
    water_.particles = initial_particles(water_.scene);
    water_.settle = true;
    water_.motions = {[this](double) {
      return BodyState{{0.12, 0.12, height_}, {0, 0, 0, 1}, {0.0, 0.0, -drop_}, {0, 0, 0}};
    }};
    water_.start(device_);
    water_.fluid->zero_velocities();
    water_.fluid->let_sleep(kRule);
  }

  /// One frame of one step.
  void frame() {
    Fluid& fluid = *water_.fluid;
    const Step step = {kDt, 0.0, 0.0, 0, true};
    fluid.set_bodies(water_.bodies->at(water_.time));
    fluid.prepare(step);
    fluid.advance(step);
    device_.queue().finish();
    height_ -= drop_ * kDt;
    water_.time += kDt;
  }

  /// Stops all water, frame by frame, until it sleeps.
  void put_to_sleep() {
    for (int k = 0; k < kRule.frames + 2; ++k) {
      water_.fluid->zero_velocities();
      frame();
    }
    ASSERT_EQ(water_.fluid->stats().asleep, water_.params.count);
  }

  std::vector<int> moving() const {
    return water_.fluid->moving().read(water_.fluid->device(),
                                       static_cast<std::size_t>(water_.params.count));
  }

  static std::size_t where(const Snapshot& state, int id) {
    return static_cast<std::size_t>(std::find(state.id.begin(), state.id.end(), id) -
                                    state.id.begin());
  }

  /// Without waking anyone.
  void set_velocity(const std::vector<float>& velocity) {
    const_cast<Buffer<float>&>(water_.fluid->particles().velocity).write(device_, velocity);
  }

  double height_ = 0.5;
  double drop_ = 0.0;
  Device device_;
  Water water_;
};

}  // namespace splash::sim
