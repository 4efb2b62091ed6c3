// SPDX-License-Identifier: MIT
#include "sim-server/start/scene_start.hpp"

#include <algorithm>
#include <memory>
#include <span>

#include "sim-server/bodies/motion/grabbed_motion.hpp"
#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/bodies/motion/tied_motion.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// What comes to rest is held, whatever holds it.
std::vector<SupportState> wanted_states(const Scene& scene, std::span<const Keyframe> poses,
                                        const std::vector<Vector3>& particles) {
  if (scene.fluid.settle == SettleKind::always) {
    return std::vector<SupportState>(particles.size(), SupportState::supported);
  }
  std::vector<SupportState> all = support_states(scene, poses, particles);
  if (scene.fluid.settle == SettleKind::never) {
    std::fill(all.begin(), all.end(), SupportState::flowing);
  }
  return all;
}

}  // namespace

Bodies make_bodies(const Scene& scene, const std::filesystem::path& tracker,
                   std::vector<PosedMotion*>& live) {
  std::vector<std::unique_ptr<Motion>> motions;
  for (const BodySettings& body : scene.bodies) {
    auto motion = make_motion(body, tracker);
    if (is_grabbable(body)) motion = std::make_unique<GrabbedMotion>(std::move(motion));
    motions.push_back(std::move(motion));
    auto* const tied = dynamic_cast<TiedMotion*>(motions.back().get());
    live.push_back(tied != nullptr ? &tied->tether()
                                   : dynamic_cast<PosedMotion*>(motions.back().get()));
  }
  const double support = scene_support(scene);
  return {sample_bodies(scene.bodies, particle_spacing(scene), support), std::move(motions),
          support};
}

std::vector<Keyframe> poses_at_start(const Bodies& bodies) {
  std::vector<Keyframe> poses;
  for (std::size_t b = 0; b < bodies.count(); ++b) {
    const BodyState state = bodies.state(b, 0.0);
    poses.push_back({0.0, state.position, state.rotation});
  }
  return poses;
}

Fluid make_fluid(Device& device, const Scene& scene, const Bodies& bodies,
                 std::vector<SupportState>& support_states) {
  const double sound = scene_sound_speed(scene, bodies.fastest_ever());
  const std::vector<Keyframe> poses = poses_at_start(bodies);
  const std::vector<Vector3> particles = initial_water(scene, poses, sound).particles;
  support_states = wanted_states(scene, poses, particles);
  const std::vector<BoundaryPoint> boundary(bodies.points().begin(), bodies.points().end());
  return {device,
          make_params(scene, particles, sound),
          settled(scene, particles, sound, support_states),
          boundary,
          body_outlines(scene.bodies),
          {.whole = !scene.skip.kernels}};
}

double start_flow(Fluid& fluid, const Scene& scene) {
  if (scene.flow.kind == FlowKind::none) return 0.0;
  Snapshot state = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  double fastest = 0.0;
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    const Vector3 v = initial_velocity(scene, state.place(i));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      state.velocity[axis * stride + i] = static_cast<float>(v[axis]);
    }
    fastest = std::max(fastest, length(v));
  }
  fluid.restore(state);
  return fastest;
}

}  // namespace splash::sim
