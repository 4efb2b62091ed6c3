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
    ++met_.turns;
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

// Operations of the formulas, as the kernels write them (density.cl, acceleration.cl, near.h), and
// the numbers that they load of a neighbour: a CPU does that beside its arithmetic, a GPU instead.
constexpr double kOfTest = 18.0, kOfDensity = 20.0, kOfForce = 46.0;
constexpr double kLoadsOfDensity = 3.0, kLoadsOfForce = 7.0;
// Of a group besides its pairs (group.h: its box; density.cl: the state equation).
constexpr double kOfGroup = 60.0;
// Scalar instructions: of a turn (group.h, rest.h), of a run (grid.h, near.h: two addresses and
// look-ups, where to go on), of a point's cell (grid.h) with its loads and store, of a point that
// is moved alone (points.h: eight numbers in and out) or a vector that stays together, of a point's
// place in the sort.
constexpr double kOfTurn = 100.0, kOfRun = 25.0, kOfCell = 28.0, kOfMove = 16.0, kOfPlace = 4.0;

/// What both pair loops have in common beside their pairs.
Work search_work(const Met& met, double n, const sim::Profile& profile) {
  const double scalar = kOfTurn * met.turns + kOfRun * 9.0 * met.turns;
  Work work = {.operations = kOfTest * met.tested + kOfGroup * n, .runs = 9.0 * met.turns};
  (profile.lanes > 1 ? work.scalar : work.operations) += profile.lanes > 1 ? scalar : 2.0 * scalar;
  return work;
}

Work pair_work(const Work& search, double bytes, double pairs, double operations, double loads,
               const sim::Profile& profile) {
  Work work = search;
  work.bytes = bytes;
  work.operations += pairs * (operations + (profile.lanes > 1 ? 0.0 : 2.0 * loads));
  return work;
}

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
  p.source.resize(static_cast<std::size_t>(p.params.count));
  device.queue().enqueueReadBuffer(block.fluid.grid().source(), CL_TRUE, 0, 4 * p.source.size(),
                                   p.source.data());
  const auto full = std::find(p.cell_start.begin(), p.cell_start.end(), p.params.count);
  p.used = static_cast<int>(full - p.cell_start.begin());
  return p;
}

Met meet_all(const Places& places, int lanes) {
  return Search(places, lanes).all();
}

double moved_alone(const Places& places, const sim::Profile& profile) {
  const auto count = places.source.size();
  const auto lanes = static_cast<std::size_t>(profile.lanes);
  const auto chunks = static_cast<std::size_t>(std::max(profile.sort_chunks, 1));
  std::vector<std::size_t> place(count);
  for (std::size_t k = 0; k < count; ++k) place[static_cast<std::size_t>(places.source[k])] = k;
  const std::size_t size = (count + chunks - 1) / chunks;
  std::size_t together = 0;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const std::size_t end = std::min((chunk + 1) * size, count);
    for (std::size_t i = chunk * size; i + lanes <= end; i += lanes) {
      bool apart = false;
      for (std::size_t k = 1; k < lanes; ++k) apart = apart || place[i + k] != place[i] + k;
      together += apart ? 0 : lanes;
    }
  }
  return static_cast<double>(count - together);
}

std::map<std::string, Work> work_of(const Places& p, const sim::Profile& profile) {
  const Met met = meet_all(p, profile.lanes);
  const double n = p.params.count;
  const auto all = static_cast<double>(p.cell_start.size());
  const double used = p.used;
  const double counts = used * std::max(profile.sort_chunks, 1);
  const Work search = search_work(met, n, profile);
  const double alone = moved_alone(p, profile);
  return {{"compute_density", pair_work(search, 36.0 * n + 4.0 * used, met.visited, kOfDensity,
                                        kLoadsOfDensity, profile)},
          {"compute_acceleration",
           pair_work(search, 44.0 * n + 4.0 * used, met.visited, kOfForce, kLoadsOfForce, profile)},
          {"integrate", {.bytes = 64.0 * n, .operations = 40.0 * n}},
          {"count_cells", {.bytes = 16.0 * n + 12.0 * counts, .scalar = kOfCell * n, .counts = n}},
          {"sum_blocks", {.bytes = 4.0 * counts, .scalar = counts}},
          {"place_cells", {.bytes = 8.0 * counts + 4.0 * used, .scalar = 5.0 * counts}},
          {"sort_points",
           {.bytes = 64.0 * n + 8.0 * counts,
            .scalar = kOfPlace * n + kOfMove * (alone + (n - alone) / profile.lanes),
            .counts = n}},
          {"count_points", {.bytes = 28.0 * n, .operations = 2.0 * kOfCell * n}},
          {"sum_cells", {.bytes = 4.0 * all, .operations = all}},
          {"start_cells", {.bytes = 12.0 * all, .operations = all}},
          {"gather_cells", {.bytes = 16.0 * n}},
          {"rank_points", {.bytes = 76.0 * n, .operations = 2.0 * (kOfMove + 4.0 * kOfPlace) * n}}};
}

}  // namespace splash::bench
