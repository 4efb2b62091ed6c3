// SPDX-License-Identifier: MIT
#include "sim-server/fluid/params/parts.hpp"

#include <algorithm>
#include <cstdlib>

#include "sim-server/fluid/params/smoothing.hpp"

namespace splash::sim {

int KernelParts::left_out() const noexcept {
  return 6 - (int{bodies} + int{slope} + int{piston} + int{friction} + int{mesh} + int{pockets});
}

KernelParts parts_needed(const FluidParams& params, const std::vector<BodyShape>& shapes) {
  return {!shapes.empty(),
          params.slope >= 0,
          params.piston >= 0,
          params.viscous != 0.0F || params.artificial != 0.0F,
          std::any_of(shapes.begin(), shapes.end(),
                      [](const BodyShape& shape) { return shape.kind == SPLASH_MESH; }),
          params.pockets != 0};
}

bool whole_asked() {
  return std::getenv("SPLASH_WHOLE") != nullptr;
}

std::vector<std::string> kernel_defines(const KernelParts& parts) {
  std::vector<std::string> defines;
  // Only what is left out is said (params/parts.h has the rest): whole programs are cached once.
  if (!parts.bodies) defines.emplace_back("HAS_BODIES=0");
  if (!parts.slope) defines.emplace_back("HAS_SLOPE=0");
  if (!parts.piston) defines.emplace_back("HAS_PISTON=0");
  if (!parts.friction) defines.emplace_back("HAS_FRICTION=0");
  if (!parts.pockets) defines.emplace_back("HAS_POCKETS=0");
  if (!parts.mesh) defines.emplace_back("HAS_MESH=0");
  return defines;
}

}  // namespace splash::sim
