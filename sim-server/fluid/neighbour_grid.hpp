// SPDX-License-Identifier: MIT
// Points sorted by the grid cell they are in: fluid particles, body points and bubbles alike.
#pragma once

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/program.hpp"
#include "sim-server/fluid/fluid_params.h"

namespace splash::sim {

/// Vectors of neighbours may be read this far past the last point.
inline constexpr std::size_t kReadAhead = 32;

/// Points as structure of arrays: x, y and z parts `stride` elements apart.
struct PointArrays {
  PointArrays() = default;
  /// Room for `points` and the read-ahead, filled with far away points at rest.
  PointArrays(Device& device, std::size_t points);

  int stride = 0;
  Buffer<float> position;  ///< [m]
  Buffer<float> velocity;  ///< [m/s]
  Buffer<int> id;          ///< stays with its point through all sorts
};

class NeighbourGrid {
 public:
  NeighbourGrid() = default;
  /// `chunks`: runs of points that are sorted side by side.
  NeighbourGrid(Device& device, const cl::Program& program, const FluidParams& params,
                std::size_t max_points, int chunks);

  /// Sorts the first `points` of `from` into `to`; stable, the same on every run. Cells above all
  /// points are left alone as long as there are as many points as last time.
  void sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
            const PointArrays& from, const PointArrays& to);

  /// Where each sorted point was before the sort.
  [[nodiscard]] const cl::Buffer& source() const noexcept { return source_.memory(); }
  /// First point of each cell; one more entry than cells.
  [[nodiscard]] const cl::Buffer& cell_start() const noexcept { return cell_start_.memory(); }

 private:
  int chunks_ = 1;
  int blocks_ = 1;
  Buffer<int> cells_;
  Buffer<int> count_;
  Buffer<int> block_sum_;
  Buffer<int> cell_start_;
  Buffer<int> source_;
  Buffer<int> extent_;      ///< cells in use (kernels/cell_count.cl)
  int sorted_points_ = -1;  ///< of the last sort
  Kernel count_cells_;
  Kernel sum_blocks_;
  Kernel place_cells_;
  Kernel sort_points_;
};

}  // namespace splash::sim
