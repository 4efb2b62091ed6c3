// SPDX-License-Identifier: MIT
#include "tests/sim-server/detect/detect_rig.hpp"

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> detect();
}  // namespace kernels

cl::Program detect_program(Device& device) {
  return build_program(device, kernels::detect(), {});
}

Step prepare(Water& water) {
  const Step step = water.step_at(0.0);
  water.fluid->set_bodies(water.bodies->at(water.time));
  water.fluid->prepare(step);
  water.fluid->device().queue().finish();
  return step;
}

Water hanging_block() {
  constexpr double kSpacing = 0.02;
  Water water = {"hanging block", tank_scene(kSpacing, {1.0, 1.0, 1.0}, 1.0)};
  for (int kz = 0; kz < 5; ++kz) {
    for (int ky = 0; ky < 10; ++ky) {
      for (int kx = 0; kx < 10; ++kx) {
        water.particles.push_back({0.4 + (kx + 0.5) * kSpacing, 0.4 + (ky + 0.5) * kSpacing,
                                   kBlockBottom + (kz + 0.5) * kSpacing});
      }
    }
  }
  water.particles.push_back({0.8, 0.8, 0.8});
  return water;
}

void fill_pool(Bubbles& bubbles, const std::vector<Vector3>& places, double born) {
  for (const Vector3& place : places) {
    const int serial = static_cast<int>(bubbles.pool().size());
    bubbles.pool().push_back({place, born, serial, -1});
  }
}

void detect(Water& water, Bubbles& bubbles, double frame) {
  const Step step = prepare(water);
  bubbles.enqueue(step, frame);
  bubbles.enqueue_read();
  water.fluid->device().queue().finish();
}

}  // namespace splash::sim
