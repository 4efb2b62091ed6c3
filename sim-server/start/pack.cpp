// SPDX-License-Identifier: MIT
#include "sim-server/start/pack.hpp"

#include <algorithm>

#include "sim-server/fluid/random_draw.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/start/pinned_particles.hpp"

namespace splash::sim {
namespace {

/// Of the cube of the lattice that a particle is in the middle of [spacings].
constexpr double kHalfCube = 0.5;

/// Enough for the pressures to fade: after 100 and after 300 a drop of ten spacings in radius is
/// the same to 1e-5 of its size.
constexpr int kPackingSteps = 100;

/// Uniform on [-1, 1) along each axis.
Vector3 displacement(std::uint32_t seed, int particle) {
  const auto shares = random_draw({static_cast<std::uint32_t>(particle), 0U, 0U, 0U},
                                  {seed, 0x7061636BU});  // "pack"
  return {2.0 * shares[0] - 1.0, 2.0 * shares[1] - 1.0, 2.0 * shares[2] - 1.0};
}

void scatter(Fluid& fluid, const std::vector<bool>& loose, std::uint32_t seed) {
  Snapshot state = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  const double most = kHalfCube * static_cast<double>(fluid.params().spacing);
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    if (!loose[static_cast<std::size_t>(state.id[i])]) continue;
    const Vector3 way = most * displacement(seed, state.id[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      state.position[axis * stride + i] += static_cast<float>(way[axis]);
    }
  }
  fluid.restore(state);
}

}  // namespace

void pack(Fluid& fluid, const std::vector<BodyStep>& bodies, double piston, double dt,
          const std::vector<bool>& loose, std::uint32_t seed) {
  if (std::find(loose.begin(), loose.end(), true) == loose.end()) return;
  std::vector<bool> others = loose;
  others.flip();
  PinnedParticles rest(fluid, others);
  scatter(fluid, loose, seed);
  fluid.set_bodies(bodies);
  fluid.disable_gravity();
  for (int k = 0; k < kPackingSteps; ++k) {
    const Step step = {dt, piston, 0.0, 0};
    fluid.prepare(step);
    fluid.advance(step);
    fluid.zero_velocities();
    rest.restore();
  }
  fluid.enable_gravity();
}

}  // namespace splash::sim
