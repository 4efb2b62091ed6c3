// SPDX-License-Identifier: MIT
#include "sim-server/start/pinned_particles.hpp"

#include <algorithm>

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> pin();
}  // namespace kernels

PinnedParticles::PinnedParticles(Fluid& fluid, const std::vector<bool>& kept)
    : fluid_(fluid),
      particles_(kept.size()),
      kept_count_(static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true))) {
  if (is_empty()) return;
  const Snapshot now = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  std::vector<float> place(now.position.size());
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis * stride + static_cast<std::size_t>(now.id[i])] = now.position[axis * stride + i];
    }
  }
  kept_ = Buffer<int>(fluid.device(), std::vector<int>(kept.begin(), kept.end()));
  place_ = Buffer<float>(fluid.device(), place);
  put_back_ = Kernel(build_program(fluid.device(), kernels::pin(), {}), "put_back");
}

void PinnedParticles::restore() {
  if (is_empty()) return;
  const PointArrays& water = fluid_.particles();
  put_back_.run(fluid_.device().queue(), particles_,
                {{"p", fluid_.params_buffer()},
                 {"kept", kept_},
                 {"place", place_},
                 {"id", water.id},
                 {"position", water.position},
                 {"velocity", water.velocity}});
}

}  // namespace splash::sim
