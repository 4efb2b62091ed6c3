// SPDX-License-Identifier: MIT
// What the benchmark says that a step asks of a device, against counts by brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tests/bench/fluid_work.hpp"

namespace splash::bench {
namespace {

/// Slice along x, row and layer of cells that a particle is in; those outside are in the outermost
/// inner ones (neighbours/grid.h).
std::array<int, 3> cell_of(const Places& p, std::size_t i) {
  const std::size_t stride = p.position.size() / 3;
  const sim::FluidParams& s = p.params;
  const auto along = [&](std::size_t axis, float origin, int cells, int per_cell) {
    const float x = (p.position[axis * stride + i] - origin) * s.inverse_cell;
    return std::clamp(static_cast<int>(std::floor(x * static_cast<float>(per_cell))), per_cell,
                      (cells - 1) * per_cell - 1);
  };
  return {along(0, s.origin_x, s.cells_x, SPLASH_SLICES), along(1, s.origin_y, s.cells_y, 1),
          along(2, s.origin_z, s.cells_z, 1)};
}

double distance(const Places& p, std::size_t i, std::size_t j) {
  const std::size_t stride = p.position.size() / 3;
  double square = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto apart = static_cast<double>(p.position[axis * stride + i]) -
                       static_cast<double>(p.position[axis * stride + j]);
    square += apart * apart;
  }
  return std::sqrt(square);
}

TEST(StepWork, CountsThePairsThatKernelsVisit) {
  sim::Device device;
  Block block(device, 2'000);
  const Places p = places_of(block);
  const auto count = static_cast<std::size_t>(p.params.count);
  std::vector<std::array<int, 3>> cells;
  for (std::size_t i = 0; i < count; ++i) cells.push_back(cell_of(p, i));
  double around = 0.0, neighbours = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      around += std::abs(cells[i][0] - cells[j][0]) <= SPLASH_SLICES &&
                std::abs(cells[i][1] - cells[j][1]) <= 1 &&
                std::abs(cells[i][2] - cells[j][2]) <= 1;
      neighbours += distance(p, i, j) < static_cast<double>(p.params.support);
    }
  }
  EXPECT_EQ(meet_all(p, 1).visited, around);
  EXPECT_EQ(meet_all(p, 1).tested, 0.0);
  // Vectors cull out what is near none of their particles, and nothing else.
  const Met wide = meet_all(p, 16);
  EXPECT_GT(wide.visited, neighbours);
  EXPECT_LT(wide.visited, 2.0 * around);
  EXPECT_GT(16.0 * wide.tested, wide.visited);
  // A particle has a search of its own, a vector one for each row that it lies in.
  EXPECT_EQ(meet_all(p, 1).turns, p.params.count);
  double turns = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    turns += i % 16 == 0 || cells[i][1] != cells[i - 1][1] || cells[i][2] != cells[i - 1][2];
  }
  EXPECT_EQ(wide.turns, turns);
}

TEST(StepWork, CountsWhatTheSortMovesAlone) {
  Places p;
  for (int k = 0; k < 64; ++k) p.source.push_back(k);
  sim::Profile profile = sim::cpu_profile(2);  // two chunks of two vectors
  EXPECT_EQ(moved_alone(p, profile), 0.0);
  std::swap(p.source[17], p.source[40]);  // in the second and in the third vector
  EXPECT_EQ(moved_alone(p, profile), 32.0);
  p.source.push_back(64);  // chunks of 33: one of each is left over
  EXPECT_GT(moved_alone(p, profile), 32.0);
}

TEST(StepWork, GrowsWithTheWater) {
  sim::Device device;
  Block small(device, 1'000);
  Block large(device, 8'000);
  for (const sim::Profile& profile : {sim::cpu_profile(2), sim::gpu_profile()}) {
    const auto less = work_of(places_of(small), profile);
    const auto more = work_of(places_of(large), profile);
    const double forces =
        more.at("compute_acceleration").operations / less.at("compute_acceleration").operations;
    EXPECT_GT(forces, 8.0) << "a larger cube has fewer of its particles at its faces";
    EXPECT_LT(forces, 16.0);
    EXPECT_NEAR(more.at("integrate").bytes / less.at("integrate").bytes, 8.0, 1e-9);
  }
}

}  // namespace
}  // namespace splash::bench
