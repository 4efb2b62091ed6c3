// SPDX-License-Identifier: MIT
// What a step costs: the two main kernels beside C++ by hand, the whole step against the number of
// particles, its stages, and what a launch costs that does nothing. Prints tables.
#pragma once

#include <cstdio>

#include "sim-server/device/device.hpp"

namespace splash::bench {

/// In one run, on the same particles; `device` with profiling. `csv`: or null. Throws
/// std::runtime_error when both do not give the same sums.
void beside_the_yardstick(sim::Device& device, int most_particles, std::FILE* csv);
void against_size(sim::Device& device, int most_particles, std::FILE* csv);
/// Of a cube of water, and of the pool with its bodies and detectors; `device` with profiling.
void stage_by_stage(sim::Device& device, std::FILE* csv);

}  // namespace splash::bench
