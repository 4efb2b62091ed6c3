// SPDX-License-Identifier: MIT
// The sort: every point in its cell, x fastest, in the order it came, however many chunks, by rank
// or not, and whatever the device's profile.
#include "sim-server/fluid/neighbours/neighbour_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>

#include "sim-server/fluid/params/parts.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

struct Sorted {
  std::vector<float> position;
  std::vector<float> velocity;
  std::vector<int> id;
  std::vector<int> cell_start;
  bool operator==(const Sorted&) const = default;
};

/// 0 chunks: by rank.
struct Path {
  const char* name;
  Profile profile;
  int chunks;
};

void PrintTo(const Path& path, std::ostream* out) {
  *out << path.name;
}

class NeighbourGrids : public ::testing::TestWithParam<Path> {
 protected:
  NeighbourGrids() {
    scene_ = tank_scene(0.02, {0.3, 0.2, 0.2}, 0.1);
    // Some far outside: they count to the outermost inner cells.
    places_ = random_places(1234, {-0.2, -0.2, -0.2}, {0.5, 0.4, 1.0}, 11);
    for (int i = 0; i < 50; ++i) places_.push_back({0.1, 0.1, 0.1});
    params_ = make_params(scene_, places_);
  }

  /// In a row of cells.
  [[nodiscard]] int slices() const { return SPLASH_SLICES * params_.cells_x; }

  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(slices() * params_.cells_y * params_.cells_z);
  }

  /// In the floats of the device, so that rounding puts nobody into another cell. The margin stays
  /// empty, so that the 27 cells around any point exist.
  [[nodiscard]] int cell_of(const Vector3& place) const {
    const auto along = [&](double x, float origin, int cells) {
      const float c = std::floor((static_cast<float>(x) - origin) * params_.inverse_cell);
      return static_cast<int>(std::clamp(c, 1.0F, static_cast<float>(cells - 2)));
    };
    const float at = (static_cast<float>(place[0]) - params_.origin_x) * params_.inverse_cell;
    const int x = std::clamp(static_cast<int>(std::floor(at * SPLASH_SLICES)), SPLASH_SLICES,
                             slices() - SPLASH_SLICES - 1);
    const int y = along(place[1], params_.origin_y, params_.cells_y);
    const int z = along(place[2], params_.origin_z, params_.cells_z);
    return (z * params_.cells_y + y) * slices() + x;
  }

  Sorted sort(int chunks = GetParam().chunks) {
    NeighbourGrid grid(device_, program_, params_, places_.size(), chunks);
    return sort_with(grid);
  }

  /// What a host finds: by cell, else in the order they came.
  [[nodiscard]] std::vector<int> sorted_by_host() const {
    std::vector<int> order(places_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return cell_of(places_[static_cast<std::size_t>(a)]) <
             cell_of(places_[static_cast<std::size_t>(b)]);
    });
    return order;
  }
  [[nodiscard]] std::vector<int> starts_by_host() const {
    std::vector<int> starts(cells() + 1, 0);
    for (const Vector3& place : places_) ++starts[static_cast<std::size_t>(cell_of(place)) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    return starts;
  }

  void expect_as_by_host(const Sorted& sorted) const {
    EXPECT_EQ(sorted.id, sorted_by_host());
    EXPECT_EQ(sorted.cell_start, starts_by_host());
  }

  Sorted sort_with(NeighbourGrid& grid) {
    const std::size_t n = places_.size();
    PointArrays from(device_, n);
    const PointArrays to(device_, n);
    const auto stride = static_cast<std::size_t>(from.stride);
    std::vector<float> position(3 * stride, 0.0F);
    std::vector<float> velocity(3 * stride, 0.0F);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        position[axis * stride + i] = static_cast<float>(places_[i][axis]);
        velocity[axis * stride + i] = static_cast<float>(10 * i + axis);
      }
    }
    std::vector<int> ids(n);
    std::iota(ids.begin(), ids.end(), 0);
    from.position.write(device_, position);
    from.velocity.write(device_, velocity);
    from.id.write(device_, ids);
    const Buffer<FluidParams> params(device_, std::span<const FluidParams>(&params_, 1));
    grid.sort(device_.queue(), params, static_cast<int>(n), from, to);
    return {to.position.read(device_, 3 * stride), to.velocity.read(device_, 3 * stride),
            to.id.read(device_, n), grid.cell_start().read(device_, cells() + 1)};
  }

  Device device_{-1, false, GetParam().profile};
  cl::Program program_ = build_program(device_, kernels::fluid(), {});
  Scene scene_;
  std::vector<Vector3> places_;
  FluidParams params_ = {};
};

INSTANTIATE_TEST_SUITE_P(Paths, NeighbourGrids,
                         ::testing::Values(Path{"vectors_1", cpu_profile(2), 1},
                                           Path{"vectors_2", cpu_profile(2), 2},
                                           Path{"vectors_3", cpu_profile(2), 3},
                                           Path{"vectors_64", cpu_profile(2), 64},
                                           Path{"vectors_by_rank", cpu_profile(2), 0},
                                           Path{"scalar_256", gpu_profile(), 256},
                                           Path{"scalar_by_rank", gpu_profile(), 0}),
                         [](const auto& path) { return path.param.name; });

// Work-groups take 64 points, teams 1024 cells: one fewer, one more.
TEST_P(NeighbourGrids, SortAnyNumber) {
  const std::vector<Vector3> all = places_;
  for (const std::size_t count : std::initializer_list<std::size_t>{
           0, 1, 2, 8, 15, 16, 17, 63, 64, 65, 127, 128, 129, 1023, 1024, 1025, all.size()}) {
    places_.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    SCOPED_TRACE(count);
    expect_as_by_host(sort());
  }
}

TEST_P(NeighbourGrids, SortAllPointsOfOneCell) {
  places_.assign(3000, {0.1, 0.1, 0.1});
  expect_as_by_host(sort());
}

// Where there is no water any more, all is in one cell: nobody is lost, and it takes no hour.
TEST_P(NeighbourGrids, LoseNobodyInACrowd) {
  places_.assign(40'000, {0.1, 0.1, 0.1});
  Sorted sorted = sort();
  std::sort(sorted.id.begin(), sorted.id.end());
  expect_as_by_host(sorted);
}

// A hundred times as many cells as points, and some that do not fill the last team.
TEST_P(NeighbourGrids, SortFewPointsInManyCells) {
  scene_ = tank_scene(0.02, {3.1, 1.1, 0.7}, 0.1);
  places_ = random_places(700, {0, 0, 0}, {3.1, 1.1, 0.7}, 14);
  params_ = make_params(scene_, places_);
  ASSERT_GT(cells(), 100 * places_.size());
  expect_as_by_host(sort());
}

// What is no number is in the first cell inside the margin.
TEST_P(NeighbourGrids, SortWhatIsNoNumber) {
  for (std::size_t i = 0; i < places_.size(); i += 7) {
    for (double& x : places_[i]) x = std::numeric_limits<double>::quiet_NaN();
  }
  const Sorted sorted = sort();
  for (std::size_t i = 0; i < places_.size(); i += 7) places_[i] = {-1.0, -1.0, -1.0};
  expect_as_by_host(sorted);
}

TEST_P(NeighbourGrids, CarryPlacesAndVelocitiesAlong) {
  const Sorted sorted = sort();
  const std::size_t stride = sorted.position.size() / 3;
  for (std::size_t i = 0; i < sorted.id.size(); ++i) {
    const auto id = static_cast<std::size_t>(sorted.id[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(sorted.position[axis * stride + i], static_cast<float>(places_[id][axis]));
      ASSERT_EQ(sorted.velocity[axis * stride + i], static_cast<float>(10 * id + axis));
    }
  }
}

// Cells above the water are left alone from sort to sort: water that rises into them, falls back
// and is fewer must be sorted as by a grid that knows nothing.
TEST_P(NeighbourGrids, SortTheNextTimeAsTheFirst) {
  const std::vector<Vector3> spray = places_;
  const auto low = random_places(places_.size(), {0, 0, 0}, {0.3, 0.2, 0.05}, 12);
  const auto lower = random_places(places_.size(), {0, 0, 0}, {0.3, 0.2, 0.02}, 13);
  const std::vector<Vector3> fewer(low.begin(), low.begin() + 700);
  NeighbourGrid grid(device_, program_, params_, spray.size(), GetParam().chunks);
  for (const auto* next : {&spray, &low, &lower, &spray, &low, &low, &lower, &fewer, &lower, &fewer,
                           &low, &lower, &lower, &spray}) {
    places_ = *next;
    EXPECT_EQ(sort_with(grid), sort());
  }
}

TEST_P(NeighbourGrids, AreTheSameOnEveryRunAndForAnyPath) {
  const Sorted one = sort(1);
  EXPECT_EQ(sort(), one);
  EXPECT_EQ(sort(), one);
}

}  // namespace
}  // namespace splash::sim
