// SPDX-License-Identifier: MIT
#include "tests/bench/fluid_work.hpp"

#include <algorithm>

namespace splash::bench {
namespace {

using namespace splash::sim;

struct Box {
  float lower[3], upper[3];  ///< [m]
};

class Search {
 public:
  Search(const Places& places, int lanes) : p_(places), lanes_(lanes) {}

  Met all() {
    const int slices = SPLASH_SLICES * p_.params.cells_x;
    const int rows = p_.params.cells_y * p_.params.cells_z;
    for (int row = 0; row < rows; ++row) {
      const int end = start(row * slices + slices);
      for (int first = start(row * slices); first < end;) {
        // A turn of the work-item that has it: up to its last particle, or the row's.
        const int last = std::min((first / lanes_ + 1) * lanes_, end);
        meet(row, first, last);
        first = last;
      }
    }
    return met_;
  }

 private:
  [[nodiscard]] int start(int cell) const { return p_.cell_start[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] float at(int axis, int i) const {
    const std::size_t stride = p_.position.size() / 3;
    return p_.position[static_cast<std::size_t>(axis) * stride + static_cast<std::size_t>(i)];
  }
  [[nodiscard]] int slice(int i) const {
    const FluidParams& s = p_.params;
    const float cell =
        std::clamp((at(0, i) - s.origin_x) * s.inverse_cell, 1.0F, static_cast<float>(s.cells_x));
    return std::min(static_cast<int>(cell * SPLASH_SLICES), (s.cells_x - 1) * SPLASH_SLICES - 1);
  }
  [[nodiscard]] Box box(int first, int last) const {
    Box box{};
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = box.upper[axis] = at(axis, first);
      for (int i = first; i < last; ++i) {
        box.lower[axis] = std::min(box.lower[axis], at(axis, i));
        box.upper[axis] = std::max(box.upper[axis], at(axis, i));
      }
    }
    return box;
  }
  [[nodiscard]] bool is_near(const Box& box, int j) const {
    float apart2 = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float apart =
          std::max({box.lower[axis] - at(axis, j), at(axis, j) - box.upper[axis], 0.0F});
      apart2 += apart * apart;
    }
    return apart2 < p_.params.support * p_.params.support;
  }

  void meet(int row, int first, int last) {
    const int slices = SPLASH_SLICES * p_.params.cells_x;
    const int from = slice(first) - SPLASH_SLICES;
    const int to = slice(last - 1) + SPLASH_SLICES + 1;
    const Box around = box(first, last);
    for (int k = 0; k < 9; ++k) {
      const int base = (row + (k / 3 - 1) * p_.params.cells_y + k % 3 - 1) * slices;
      const int begin = start(base + from);
      const int end = start(base + to);
      if (lanes_ == 1) {
        met_.visited += end - begin;
        continue;
      }
      const int vectors = (end - begin + lanes_ - 1) / lanes_;
      met_.tested += vectors * lanes_;
      for (int j = begin; j < end; ++j) met_.visited += is_near(around, j) ? lanes_ : 0;
    }
  }

  const Places& p_;
  int lanes_;
  Met met_;
};

// Operations of the formulas, as the kernels write them (density.cl, acceleration.cl, near.h).
constexpr double kOfTest = 18.0, kOfDensity = 20.0, kOfForce = 46.0;

}  // namespace

Places places_of(sim::Device& device, Block& block) {
  block.fluid.prepare(block.step);
  const auto stride = static_cast<std::size_t>(block.fluid.particles().stride);
  Places p;
  p.params = block.params;
  p.position = block.fluid.particles().position.read(device, 3 * stride);
  p.cell_start.resize(SPLASH_SLICES * static_cast<std::size_t>(p.params.cells_x) *
                          static_cast<std::size_t>(p.params.cells_y) *
                          static_cast<std::size_t>(p.params.cells_z) +
                      1);
  device.queue().enqueueReadBuffer(block.fluid.grid().cell_start(), CL_TRUE, 0,
                                   4 * p.cell_start.size(), p.cell_start.data());
  const auto full = std::find(p.cell_start.begin(), p.cell_start.end(), p.params.count);
  p.used = static_cast<int>(full - p.cell_start.begin());
  return p;
}

Met meet_all(const Places& places, int lanes) {
  return Search(places, lanes).all();
}

std::map<std::string, Work> work_of(const Places& p, const sim::Profile& profile) {
  const Met met = meet_all(p, profile.lanes);
  const double n = p.params.count;
  const auto all = static_cast<double>(p.cell_start.size());
  const double used = p.used;
  const double counts = used * std::max(profile.sort_chunks, 1);
  const double tests = kOfTest * met.tested;
  return {{"compute_density", {36.0 * n + 4.0 * used, tests + kOfDensity * met.visited}},
          {"compute_acceleration", {44.0 * n + 4.0 * used, tests + kOfForce * met.visited}},
          {"integrate", {64.0 * n, 40.0 * n}},
          {"count_cells", {16.0 * n + 12.0 * counts, 10.0 * n}},
          {"sum_blocks", {4.0 * counts, counts}},
          {"place_cells", {8.0 * counts + 4.0 * used, counts}},
          {"sort_points", {64.0 * n + 8.0 * counts, 0.0}},
          {"count_points", {28.0 * n, 10.0 * n}},
          {"sum_cells", {4.0 * all, all}},
          {"start_cells", {12.0 * all, all}},
          {"gather_cells", {16.0 * n, 0.0}},
          {"rank_points", {76.0 * n, 4.0 * n}}};
}

}  // namespace splash::bench
