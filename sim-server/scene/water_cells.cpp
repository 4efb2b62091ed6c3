// SPDX-License-Identifier: MIT
#include "sim-server/scene/water_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

/// Cells that are looked at beyond the outermost water.
constexpr double kMargin = 4.0;

bool is_gate_between(const Gate& gate, const Vector3& a, const Vector3& b) {
  return gate.present && (a[0] < gate.x) != (b[0] < gate.x);
}

bool is_water(const WaterBlock& block, const Vector3& x, double width) {
  WaterBlock grown = block;
  for (std::size_t i = 0; i < 3; ++i) {
    grown.lower[i] -= 0.5 * width;
    grown.upper[i] += 0.5 * width;
    if (x[i] < grown.lower[i] || x[i] > grown.upper[i]) return false;
  }
  return is_filled(grown, x);
}

/// Whether a body displaces water there: it is nearer than half a cell to its surface, or inside.
bool is_displaced(const Scene& scene, std::span<const Keyframe> poses, const Vector3& x,
                  double width) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector3 local = rotate(inverse(poses[i].rotation), x - poses[i].position);
    if (distance_to(scene.bodies[i].shape, local) < 0.5 * width) return true;
  }
  return false;
}

Matter matter_at(const Scene& scene, std::span<const Keyframe> poses, const Vector3& x,
                 double width) {
  if (is_outside(scene, x) || is_displaced(scene, poses, x, width)) return Matter::solid;
  const bool wet =
      std::any_of(scene.water.begin(), scene.water.end(), [&](const WaterBlock& block) {
        return !is_gate_between(scene.gate, x, 0.5 * (block.lower + block.upper)) &&
               is_water(block, x, width);
      });
  return wet ? Matter::water : Matter::air;
}

}  // namespace

WaterCells::WaterCells(const Scene& scene, std::span<const Keyframe> poses)
    : width_(particle_spacing(scene)), gate_(scene.gate) {
  Vector3 upper = {};
  for (std::size_t i = 0; i < 3; ++i) {
    lower_[i] = std::numeric_limits<double>::infinity();
    upper[i] = -lower_[i];
    for (const WaterBlock& block : scene.water) {
      lower_[i] = std::min(lower_[i], block.lower[i] - kMargin * width_);
      upper[i] = std::max(upper[i], block.upper[i] + kMargin * width_);
    }
    counts_[i] = static_cast<std::int64_t>(std::ceil((upper[i] - lower_[i]) / width_));
  }
  matter_.resize(static_cast<std::size_t>(count()));
  for (std::int64_t cell = 0; cell < count(); ++cell) {
    matter_[static_cast<std::size_t>(cell)] = matter_at(scene, poses, middle(cell), width_);
  }
}

std::int64_t WaterCells::number(const Index& index) const noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    if (index[i] < 0 || index[i] >= counts_[i]) return kNone;
  }
  return index[0] + counts_[0] * (index[1] + counts_[1] * index[2]);
}

WaterCells::Index WaterCells::index_of(std::int64_t cell) const noexcept {
  return {cell % counts_[0], cell / counts_[0] % counts_[1], cell / counts_[0] / counts_[1]};
}

Vector3 WaterCells::middle(std::int64_t cell) const {
  const Index index = index_of(cell);
  Vector3 x = lower_;
  for (std::size_t i = 0; i < 3; ++i) x[i] += (static_cast<double>(index[i]) + 0.5) * width_;
  return x;
}

std::array<std::int64_t, 6> WaterCells::beside(std::int64_t cell) const {
  const Index here = index_of(cell);
  const auto behind_gate = [&](std::int64_t other) {
    return other != kNone && is_gate_between(gate_, middle(cell), middle(other));
  };
  std::array<std::int64_t, 6> cells = {};
  for (std::size_t i = 0; i < 3; ++i) {
    Index there = here;
    there[i] = here[i] - 1;
    cells[2 * i] = number(there);
    there[i] = here[i] + 1;
    cells[2 * i + 1] = number(there);
  }
  std::replace_if(cells.begin(), cells.end(), behind_gate, kNone);
  return cells;
}

std::int64_t WaterCells::water_near(const Vector3& place) const {
  Index base = {};
  for (std::size_t i = 0; i < 3; ++i) {
    base[i] = static_cast<std::int64_t>(std::floor((place[i] - lower_[i]) / width_));
  }
  std::int64_t nearest = kNone;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 27; ++k) {
    const std::int64_t cell =
        number({base[0] + k % 3 - 1, base[1] + k / 3 % 3 - 1, base[2] + k / 9 - 1});
    if (cell == kNone || at(cell) != Matter::water) continue;
    if (is_gate_between(gate_, place, middle(cell))) continue;
    const double distance = length(place - middle(cell));
    if (distance < least) nearest = cell;
    least = std::min(least, distance);
  }
  return nearest;
}

}  // namespace splash::sim
