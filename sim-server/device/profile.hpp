// SPDX-License-Identifier: MIT
// What suits a device, decided here and nowhere else: how many particles a work-item handles, and
// into how many pieces work is cut. CPUs have few cores with wide vectors and dear synchronisation;
// GPUs have thousands of scalar lanes that read memory together.
#pragma once

#include <cstddef>

namespace splash::sim {

struct Profile {
  int lanes = 1;             ///< particles per vector in kernels: 1, 8 or 16 (fluid/lanes/lanes.h)
  std::size_t group = 64;    ///< work-items of a work-group, where each has a vector of its own
  std::size_t team = 64;     ///< work-items that find a part of a sum together (lanes/team.h)
  std::size_t parts = 256;   ///< of a sum over all particles, one to a team
  std::size_t judges = 256;  ///< work-items of the one work-group that adds up all parts
  int sort_chunks = 0;       ///< runs of points that are sorted side by side; 0: by rank
};

/// `lanes`: 8 or 16.
[[nodiscard]] Profile cpu_profile(unsigned cores, int lanes = 16);

/// Scalar: runs on any device, on a CPU as on a GPU but for the speed.
[[nodiscard]] Profile gpu_profile();

}  // namespace splash::sim
