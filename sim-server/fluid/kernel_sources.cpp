// SPDX-License-Identifier: MIT
#include "sim-server/fluid/kernel_sources.hpp"

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> divergence_free();
std::vector<KernelSource> fluid();
std::vector<KernelSource> free_bodies();
std::vector<KernelSource> grid_projected();
std::vector<KernelSource> stats();
}  // namespace kernels

std::vector<KernelSource> fluid_sources() {
  return kernels::fluid();
}
std::vector<KernelSource> divergence_free_sources() {
  return kernels::divergence_free();
}
std::vector<KernelSource> grid_projected_sources() {
  return kernels::grid_projected();
}
std::vector<KernelSource> free_body_sources() {
  return kernels::free_bodies();
}
std::vector<KernelSource> stats_sources() {
  return kernels::stats();
}

}  // namespace splash::sim
