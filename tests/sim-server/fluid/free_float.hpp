// SPDX-License-Identifier: MIT
// A small body of water with bodies that it moves, step by step, and what they have together.
#pragma once

#include "sim-server/bodies/body_steps.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {

/// Momentum and angular momentum about the origin, of the water and of the bodies.
struct Balance {
  Vector3 water = {0.0, 0.0, 0.0};    ///< [kg m/s]
  Vector3 bodies = {0.0, 0.0, 0.0};   ///< [kg m/s]
  Vector3 turning = {0.0, 0.0, 0.0};  ///< of both [kg m2/s]
  Vector3 spin = {0.0, 0.0, 0.0};     ///< the bodies', each about its own centre [kg m2/s]
  double energy = 0.0;                ///< kinetic, of the bodies [J]
  double scale = 0.0;                 ///< sum of the magnitudes of all momenta [kg m/s]
  [[nodiscard]] Vector3 all() const;
};

struct FreeFloat {
  Scene scene;
  std::vector<BodyStep> steps = {};
  std::unique_ptr<Bodies> bodies = {};
  std::unique_ptr<Fluid> fluid = {};
  double dt = 0.0;    ///< [s]
  double time = 0.0;  ///< [s]

  void add(const Shape& shape, double density, const BodyState& start);
  /// One that goes its way, straight on, whatever it meets; after all free ones.
  void add_led(const Shape& shape, const BodyState& start);
  /// Builds it and lets the bodies go.
  void start(Device& device);
  /// For `seconds`, in steps of dt.
  void run(double seconds);
  [[nodiscard]] BodyState state(std::size_t body) const { return state_of(steps[body]); }
  [[nodiscard]] Balance balance();
};

/// A drop of water in the middle of a large tank, nothing near the walls, no gravity; and a body.
inline FreeFloat drop_and_body(const Shape& shape, double density, const BodyState& start) {
  FreeFloat world = {tank_scene(0.02, {1.0, 1.0, 1.0}, 0.2)};
  world.scene.fluid.gravity = {0.0, 0.0, 0.0};
  world.scene.water = {{{0.4, 0.4, 0.4}, {0.6, 0.6, 0.56}}};
  world.add(shape, density, start);
  return world;
}

/// A large tank with one particle of water in its corner, far from where the bodies are: more would
/// not bear steps of 10 ms.
inline FreeFloat dry_world(double gravity) {
  FreeFloat world = {tank_scene(0.05, {3.0, 3.0, 2.0}, 0.1)};
  world.scene.water = {{{0.0, 0.0, 0.0}, {0.05, 0.05, 0.05}}};
  world.scene.fluid.gravity = {0.0, 0.0, gravity};
  return world;
}

}  // namespace splash::sim
