// SPDX-License-Identifier: MIT
#include "sim-server/gauge/wall_push.hpp"

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> gauge();
}  // namespace kernels

namespace {

cl::Program build(Fluid& fluid) {
  return build_program(fluid.device(), kernels::gauge(), {});
}

}  // namespace

WallPush::WallPush(Fluid& fluid)
    : push_by_walls_(build(fluid), "push_by_walls"),
      push_(fluid.device(), 3 * static_cast<std::size_t>(fluid.params().capacity)) {}

std::vector<Vector3> WallPush::read(Fluid& fluid, const Step& step) {
  push_by_walls_.run(fluid.device().queue(), fluid.groups(),
                     {{"p", fluid.params_buffer()},
                      {"position", fluid.particles().position},
                      {"pressure_term", fluid.pressure_term()},
                      {"piston", static_cast<float>(step.piston)},
                      {"push", push_}});
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  const std::vector<float> parts = push_.read(fluid.device(), 3 * stride);
  std::vector<Vector3> push(static_cast<std::size_t>(fluid.params().count));
  for (std::size_t i = 0; i < push.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      push[i][axis] = static_cast<double>(parts[axis * stride + i]);
    }
  }
  return push;
}

}  // namespace splash::sim
