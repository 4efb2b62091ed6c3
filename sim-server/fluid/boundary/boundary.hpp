// SPDX-License-Identifier: MIT
// The rigid bodies as the water meets them: points that stand for the fluid they displace, carried
// to where each body is in a step and sorted like particles (Akinci et al. 2012), and the outlines
// that particles are kept out of.
#pragma once

#include <array>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/neighbours/neighbour_grid.hpp"
#include "sim-server/fluid/params/boundary_point.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

// The bodies' outlines as the device has them (boundary/outline.h).

struct Outlines {
  std::vector<BodyShape> shapes;  ///< one for each body
  std::vector<float> meshes;      ///< distances and vertices of those that are meshes [m]
};

/// Throws std::length_error where the meshes have more numbers than an int counts.
[[nodiscard]] Outlines body_outlines(const std::vector<BodySettings>& bodies);

class Boundary {
 public:
  Boundary() = default;
  /// `program`: the fluid's; `points`: of all bodies, in any order.
  Boundary(Device& device, const cl::Program& program, const FluidParams& params,
           const std::vector<BoundaryPoint>& points, const Outlines& outlines);

  /// Bodies of all steps of the coming frame, step after step; the copy is not waited for.
  void set_steps(Device& device, const std::vector<BodyStep>& steps);
  /// These go where the water moves them; waits.
  void release(Device& device, const std::vector<FreeBody>& bodies);
  /// Carries the points to where the bodies are in this step, and sorts them.
  void place(cl::CommandQueue& queue, const Buffer<FluidParams>& params, const Step& step);

  [[nodiscard]] int point_count() const noexcept { return point_count_; }
  [[nodiscard]] int body_count() const noexcept { return body_count_; }
  /// Sorted by cell.
  [[nodiscard]] const PointArrays& points() const noexcept { return sorted_; }
  [[nodiscard]] const NeighbourGrid& grid() const noexcept { return grid_; }
  /// Of each sorted point, the water it stands for [m3].
  [[nodiscard]] const Buffer<float>& volume() const noexcept { return volume_; }
  /// Body of each point, by the point's id.
  [[nodiscard]] const Buffer<int>& owner() const noexcept { return owner_; }
  [[nodiscard]] const Buffer<BodyShape>& shapes() const noexcept { return shapes_; }
  /// Numbers of those that are meshes.
  [[nodiscard]] const Buffer<float>& meshes() const noexcept { return meshes_; }
  /// Where the bodies are in all steps of the frame, and how many entries set_steps gave.
  [[nodiscard]] const Buffer<BodyStep>& steps() const noexcept { return steps_; }
  /// As set_steps gave them: free bodies are there in the frame's first step only.
  [[nodiscard]] const std::vector<BodyStep>& given_steps() const noexcept { return uploaded_; }
  // For kernels: where the bodies are in a step, what they look like, and their points.
  [[nodiscard]] std::array<KernelArg, 2> steps_at(const Step& step) const {
    return {{{"bodies", steps_}, {"first_body", step.first_body}}};
  }
  [[nodiscard]] std::array<KernelArg, 3> bodies_at(const Step& step) const {
    return {{{"bodies", steps_}, {"first_body", step.first_body}, {"body_count", body_count_}}};
  }
  [[nodiscard]] std::array<KernelArg, 2> outlines() const {
    return {{{"shapes", shapes_}, {"meshes", meshes_}}};
  }
  [[nodiscard]] std::array<KernelArg, 4> matter() const {
    return {{{"body_start", grid_.cell_start()},
             {"body_position", sorted_.position},
             {"body_volume", volume_},
             {"body_stride", sorted_.stride}}};
  }
  [[nodiscard]] int step_entries() const noexcept { return static_cast<int>(uploaded_.size()); }

 private:
  void load(Device& device, const FluidParams& params, const std::vector<BoundaryPoint>& points);

  int point_count_ = 0;
  int body_count_ = 0;
  Buffer<float> sample_;  ///< places in body axes [m]
  Buffer<int> owner_;
  Buffer<float> sample_volume_;  ///< [m3]
  Buffer<BodyShape> shapes_;
  Buffer<float> meshes_;
  Buffer<BodyStep> steps_;
  std::vector<BodyStep> uploaded_;  ///< kept until the queue has read them
  PointArrays unsorted_;
  PointArrays sorted_;
  Buffer<float> volume_;
  NeighbourGrid grid_;
  Kernel place_bodies_;
  Kernel gather_volumes_;
};

}  // namespace splash::sim
