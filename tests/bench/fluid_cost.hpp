// SPDX-License-Identifier: MIT
// What a step costs: the two main kernels beside C++ by hand, the whole step against the number of
// particles, its stages, what a launch costs that does nothing, and all that beside what the device
// can do at most. Each is a table of the benchmark.
#pragma once

#include <utility>

#include "sim-server/device/device.hpp"
#include "tests/bench/fluid_work.hpp"
#include "tests/bench/report.hpp"

namespace splash::bench {

/// When a measurement over growing sizes has to be over.
struct Until {
  double end = 0.0;  ///< as protocol::monotonic_now() counts; 0: never [s]

  /// Whether so many seconds are left.
  [[nodiscard]] bool allows(double seconds) const;
};

/// By kernels that do nothing else; `device` with profiling. The bandwidth is that of its memory.
[[nodiscard]] Limits limits_of(sim::Device& device);
/// Of a kernel that does nothing: what passes, and what processors take [s].
[[nodiscard]] std::pair<double, double> empty_launch(sim::Device& device);
/// Of three arrays that together have so many bytes, from where they are after a first pass [B/s].
[[nodiscard]] double bandwidth_of(sim::Device& device, std::size_t bytes);

/// In one run, on the same particles; `device` with profiling. Throws std::runtime_error when both
/// do not give the same sums.
void beside_the_yardstick(Bench& bench, sim::Device& device, int most_particles);
/// Up to what time and the device's memory allow.
void against_size(Bench& bench, sim::Device& device, int most_particles, const Until& until);
/// Kernel by kernel; `device` with profiling. `there`: another device, of which the least times are
/// told, too, or nothing.
void against_limits(Bench& bench, sim::Device& device, bool cube, bool pool, int most_particles,
                    const Until& until, const Limits& there);
/// Of a cube of water, and of the pool with its bodies and detectors; `device` with profiling.
void stage_by_stage(Bench& bench, sim::Device& device);

}  // namespace splash::bench
