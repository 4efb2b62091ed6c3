// SPDX-License-Identifier: MIT
#include "sim-server/fluid/kernel_sources.hpp"

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> divergence_free();
std::vector<KernelSource> fluid();
std::vector<KernelSource> free_bodies();
std::vector<KernelSource> survey();
std::vector<KernelSource> shared();
}  // namespace kernels

namespace {

std::vector<KernelSource> join(std::vector<KernelSource> first,
                               const std::vector<KernelSource>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

std::vector<KernelSource> shared_sources() {
  return kernels::shared();
}
std::vector<KernelSource> fluid_sources() {
  return join(kernels::shared(), kernels::fluid());
}
std::vector<KernelSource> divergence_free_sources() {
  return join(kernels::shared(), kernels::divergence_free());
}
std::vector<KernelSource> free_body_sources() {
  return join(kernels::shared(), kernels::free_bodies());
}
std::vector<KernelSource> survey_sources() {
  return join(kernels::shared(), kernels::survey());
}

}  // namespace splash::sim
