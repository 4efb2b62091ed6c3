// SPDX-License-Identifier: MIT
#include "sim-server/gauge/wall_push.hpp"

#include "sim-server/scene/rotation.hpp"

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
  return as_vectors(push_.read(fluid.device(), 3 * stride), stride,
                    static_cast<std::size_t>(fluid.params().count));
}

}  // namespace splash::sim
