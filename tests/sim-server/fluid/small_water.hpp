// SPDX-License-Identifier: MIT
// Small bodies of water to test on: scenes, places, bodies and a fluid made of them; and the ways
// to build it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/solver_choice.hpp"

namespace splash::sim {

/// Every vector width on whatever device there is.
inline const auto kLaneCounts = ::testing::Values(1, 8, 16);
/// For what does not sum over neighbours: 8 lanes are 16 with other numbers.
inline const auto kScalarAndVector = ::testing::Values(1, 16);
inline std::string lanes_name(const ::testing::TestParamInfo<int>& info) {
  return std::to_string(info.param) + "_lanes";
}

inline const auto kBothSolvers =
    ::testing::Values(PressureKind::weakly_compressible, PressureKind::grid_projected);
inline std::string solver_name(const ::testing::TestParamInfo<PressureKind>& info) {
  return name_of(info.param);
}

/// A tank from the origin to `upper`, filled up to `depth`; sound speed 15 m/s.
[[nodiscard]] Scene tank_scene(double spacing, const Vector3& upper, double depth);

/// A body that begins there.
[[nodiscard]] BodySettings body_of(const std::string& name, const Shape& shape,
                                   const BodyState& start = {});

/// `count` places in a box, the same for the same seed.
[[nodiscard]] std::vector<Vector3> random_places(std::size_t count, const Vector3& lower,
                                                 const Vector3& upper, unsigned seed);

/// Everything a test needs of a running fluid.
struct Water {
  std::string name = {};
  Scene scene = {};
  std::vector<Vector3> particles = {};
  std::vector<std::function<BodyState(double)>> motions = {};  ///< of scene.bodies
  bool settle = false;      ///< start as the water stands under its own weight
  PistonState piston = {};  ///< held there

  /// Builds it all on `device`.
  void start(Device& device, const KernelBuild& build = {});
  /// Gives each particle a velocity of up to `speed` along each axis, by its id.
  void stir(double speed, unsigned seed);
  /// One step: prepare, `between`, advance.
  void step(
      double dt, const std::function<void(Fluid&)>& between = [](Fluid&) {});
  [[nodiscard]] Step step_at(double dt) const;

  FluidParams params = {};
  std::unique_ptr<Bodies> bodies = {};
  std::unique_ptr<Fluid> fluid = {};
  double time = 0.0;  ///< [s]
};

/// Of all particles, by their ids [m], [m/s].
[[nodiscard]] std::vector<Vector3> places_of(Fluid& fluid);
[[nodiscard]] std::vector<Vector3> velocities_of(Fluid& fluid);

/// Gives each particle the place and the velocity that `change` makes of its own.
void change_particles(Fluid& fluid,
                      const std::function<void(int id, Vector3& place, Vector3& velocity)>& change);

/// The scene's water as it stands under its own weight, for either solver.
[[nodiscard]] Water fill(const Scene& scene, PressureKind solver);
/// Runs for `seconds` in steps for particles of up to 3 m/s, pushed by gravity alone.
void run(Water& water, double seconds);
/// Starts it as a simulation does, at rest before its time begins.
void start_at_rest(Device& device, Water& water);

}  // namespace splash::sim
