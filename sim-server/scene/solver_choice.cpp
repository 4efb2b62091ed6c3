// SPDX-License-Identifier: MIT
#include "sim-server/scene/solver_choice.hpp"

#include <algorithm>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/support_state.hpp"

namespace splash::sim {
namespace {

/// Water that is shallower than two of the grid's cells has no pressure inside [spacings].
constexpr double kShallow = 4.0;

bool has_edges(const BodySettings& body) {
  return body.shape.kind != ShapeKind::sphere;
}

/// Where bodies with edges may lie on each other, steps are short with either solver
/// (bodies/mass.hpp), and a step of the grid's costs more.
bool may_stack(const Scene& scene) {
  const auto stacks = [](const BodySettings& body) {
    return has_edges(body) && body.motion.kind == MotionKind::free;
  };
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), stacks) &&
         std::count_if(scene.bodies.begin(), scene.bodies.end(), has_edges) > 1;
}

/// Why the scene needs the state equation; empty: it does not.
std::string unsuited(const Scene& scene) {
  const FluidSettings& fluid = scene.fluid;
  if (fluid.sound_speed > 0.0) return "the scene says how fast sound is";
  if (fluid.artificial != FluidSettings{}.artificial) {
    return "the scene says how large artificial viscosity is";
  }
  if (length(fluid.pull) > 0.0) {
    return "water that a central field holds swings on too long with grid_projected";
  }
  if (scene.gate.present) return "the gate lets water go that strikes what it meets";
  if (scene.flow.kind == FlowKind::uniform) return "the flow strikes what it meets";
  if (may_stack(scene)) {
    return "bodies with edges may lie on each other, which takes short steps";
  }
  if (!is_all_supported(scene)) {
    return "nothing holds some of the water, and it strikes what it meets";
  }
  if (water_depth(scene) < kShallow * particle_spacing(scene)) {
    return "the water is shallower than four spacings of its particles";
  }
  return {};
}

}  // namespace

std::string name_of(PressureKind solver) {
  switch (solver) {
    case PressureKind::weakly_compressible:
      return "weakly_compressible";
    case PressureKind::grid_projected:
      break;
  }
  return "grid_projected";
}

SolverChoice suitable_solver(const Scene& scene) {
  if (scene.fluid.air_pockets) {
    return {PressureKind::grid_projected, "the scene has air_pockets"};
  }
  const std::string reason = unsuited(scene);
  if (!reason.empty()) return {PressureKind::weakly_compressible, reason};
  return {PressureKind::grid_projected, "the water is deep and held"};
}

std::string solver_notice(const Scene& scene) {
  const SolverChoice choice = suitable_solver(scene);
  const std::string name = name_of(scene.fluid.solver);
  if (choice.solver == scene.fluid.solver) return name + ": " + choice.reason;
  if (scene.fluid.solver != PressureKind::grid_projected) return name + ", as the scene says";
  return name + ", as the scene says, but " + choice.reason + ", and " + name_of(choice.solver) +
         " is what solver: auto would take";
}

}  // namespace splash::sim
