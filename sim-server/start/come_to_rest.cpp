// SPDX-License-Identifier: MIT
#include "sim-server/start/come_to_rest.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "program/failure.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "sim-server/simulation/recovery/recovery.hpp"
#include "sim-server/start/settle.hpp"

namespace splash::sim {
namespace {

/// The lattice is no stable packing: the water finds a better one in the first second, and would
/// be heard doing so. What something holds is given this long before time begins [s].
constexpr double kSettleSeconds = 1.0;

/// Of each particle whether it is held in one of these ways.
std::vector<bool> flagged(const std::vector<SupportState>& support_states, bool flows, bool hangs) {
  std::vector<bool> flags(support_states.size());
  std::transform(support_states.begin(), support_states.end(), flags.begin(),
                 [&](SupportState how) {
                   return (flows && how == SupportState::flowing) ||
                          (hangs && how == SupportState::free_falling);
                 });
  return flags;
}

[[noreturn]] void give_up(Fluid& fluid, const Scene& scene, const Bodies& bodies,
                          const Diagnosis& wrong) {
  StepFault step_fault;
  step_fault.what = wrong;
  locate(step_fault, fluid, bodies, scene, 0.0);
  throw program::Failure(
      program::kExitConfig,
      "the water of scene '" + scene.name +
          "' does not come to rest before it begins, not even with steps an eighth as long: " +
          describe_fault(step_fault) +
          "; weaker forces (fluid.gravity, fluid.pull), bodies that leave it more room, or "
          "fluid.settle: never, would let the scene begin");
}

/// Water that nothing divides.
void bring_to_rest(Fluid& fluid, const Scene& scene, const Bodies& moved,
                   const std::vector<SupportState>& support_states, const Progress& tell) {
  const std::vector<BodyStep> bodies = at_rest(moved.at(0.0));
  const PistonState piston = piston_at(scene.wave_maker, 0.0);
  double dt = largest_time_step(fluid.params(), moved.fastest(0.0),
                                std::abs(scene.fluid.gravity[2]), StepPolicy(scene.fluid).factor());
  pack(fluid, bodies, piston.offset, dt, flagged(support_states, false, true),
       static_cast<std::uint32_t>(scene.seed));
  const Snapshot packed = fluid.snapshot();
  PinnedParticles pinned(fluid, flagged(support_states, true, true));
  std::optional<Diagnosis> wrong;
  for (int k = 0; k <= Recovery::kTries; ++k) {
    settle(fluid, bodies, piston.offset, kSettleSeconds, dt, tell, &pinned);
    const Step step = {dt, piston.offset, 0.0, 0};
    fluid.begin_watch(1);
    fluid.prepare(step);
    fluid.advance(step);
    static_cast<void>(fluid.stats());
    fluid.end_watch();
    wrong = fluid.health().diagnosis();
    pinned.restore();
    fluid.zero_velocities();
    if (!wrong) return;
    fluid.restore(packed);
    dt /= 2.0;
  }
  give_up(fluid, scene, moved, *wrong);
}

/// Of each particle on one side of the gate, its id; their places are where those of `all` are.
std::vector<int> beside(const Gate& gate, const Snapshot& all, bool left) {
  std::vector<int> ids;
  for (std::size_t i = 0; i < all.id.size(); ++i) {
    if ((static_cast<double>(all.position[i]) < gate.x) == left) ids.push_back(all.id[i]);
  }
  return ids;
}

/// The water of `all`, which is in the order of its ids, that has these.
Fluid part_of(Fluid& whole, const Scene& scene, const Bodies& bodies, const Snapshot& all,
              const std::vector<int>& ids, const WallPlane& gate) {
  FluidParams params = whole.params();
  params.count = static_cast<int>(ids.size());
  params.walls[params.wall_count++] = gate;
  std::vector<Vector3> places;
  for (const int id : ids) places.push_back(all.place(static_cast<std::size_t>(id)));
  const std::vector<BoundaryPoint> boundary(bodies.points().begin(), bodies.points().end());
  return {whole.device(),
          params,
          places,
          boundary,
          body_outlines(scene.bodies),
          {.whole = !scene.skip.kernels}};
}

/// What has become of that part is what becomes of them in `all`.
void put_back(Fluid& part, const std::vector<int>& ids, std::size_t stride, Snapshot& all) {
  const Snapshot now = part.snapshot();
  const auto own = static_cast<std::size_t>(part.params().capacity);
  const std::size_t count = ids.size();
  for (std::size_t k = 0; k < count; ++k) {
    const auto local = static_cast<std::size_t>(now.id[k]);
    const auto i = static_cast<std::size_t>(ids[local]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.position[axis * stride + i] = now.position[axis * own + k];
      all.velocity[axis * stride + i] = now.velocity[axis * own + k];
    }
    all.peak_density[i] = now.peak_density[k];
  }
}

}  // namespace

void come_to_rest(Fluid& fluid, const Scene& scene, const Bodies& bodies,
                  const std::vector<SupportState>& support_states, const Progress& tell) {
  if (!scene.gate.present) return bring_to_rest(fluid, scene, bodies, support_states, tell);
  Snapshot all = fluid.snapshot();
  double done = 0.0;  // part of the particles
  for (const bool left : {true, false}) {
    const std::vector<int> ids = beside(scene.gate, all, left);
    if (ids.empty()) continue;
    Fluid part = part_of(fluid, scene, bodies, all, ids, gate_wall(scene.gate, left));
    std::vector<SupportState> held;
    for (const int id : ids) held.push_back(support_states[static_cast<std::size_t>(id)]);
    const double share = static_cast<double>(ids.size()) / static_cast<double>(all.id.size());
    bring_to_rest(part, scene, bodies, held, [&](double now) {
      if (tell) tell(done + now * share);
    });
    done += share;
    put_back(part, ids, static_cast<std::size_t>(fluid.params().capacity), all);
  }
  fluid.restore(all);
}

}  // namespace splash::sim
