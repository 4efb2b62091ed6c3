// SPDX-License-Identifier: MIT
#include "sim-server/scene/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// By rounding of the sides a cell may seem so much larger than one of the same size [1].
constexpr double kRounding = 1.0e-9;

Lattice lattice_of(const Vector3& edge, const std::array<int, 3>& counts) {
  return {counts, {edge[0] / counts[0], edge[1] / counts[1], edge[2] / counts[2]}};
}

/// How far a lattice is from a cube of side `spacing` per particle: the number of particles counts
/// most, as it sets the mass of each, then the same spacing along every axis.
double lattice_cost(const Lattice& lattice, double spacing) {
  constexpr double kNumberWeight = 30.0;
  double volume = 0.0;
  double shape = 0.0;
  for (const double step : lattice.step) {
    const double stretch = std::log(step / spacing);
    volume += stretch;
    shape += stretch * stretch;
  }
  return kNumberWeight * volume * volume + shape;
}

/// Whole numbers on both sides of `count`, none below one.
std::array<int, 2> around(double count) {
  const int below = std::max(1, static_cast<int>(std::floor(count)));
  return {below, below + 1};
}

/// Rows along each axis that fill the block, in cells of at most `most` [m3]. What rounding a thin
/// axis takes or gives, the next longer one makes up for, so that the number of particles is kept.
Lattice best_lattice(const Vector3& edge, double spacing, double most) {
  std::array<std::size_t, 3> axis = {0, 1, 2};
  std::sort(axis.begin(), axis.end(),
            [&](std::size_t a, std::size_t b) { return edge[a] < edge[b]; });
  const auto [thin, middle, wide] = axis;
  const double volume = spacing * spacing * spacing;
  Lattice best;
  double lowest = std::numeric_limits<double>::infinity();
  for (const int thin_count : around(edge[thin] / spacing)) {
    const double thin_step = edge[thin] / thin_count;
    for (const int middle_count : around(edge[middle] / std::sqrt(volume / thin_step))) {
      const double area = thin_step * edge[middle] / middle_count;
      for (const int wide_count : around(edge[wide] * area / volume)) {
        std::array<int, 3> counts = {};
        counts[thin] = thin_count;
        counts[middle] = middle_count;
        counts[wide] = wide_count;
        const Lattice lattice = lattice_of(edge, counts);
        if (lattice.cell() > most * (1.0 + kRounding)) continue;
        const double cost = lattice_cost(lattice, spacing);
        if (cost < lowest) best = lattice;
        lowest = std::min(cost, lowest);
      }
    }
  }
  return best;
}

double box_volume(const WaterBlock& block) {
  const Vector3 edge = block.upper - block.lower;
  return edge[0] * edge[1] * edge[2];
}

Lattice largest_lattice(const Scene& scene) {
  const WaterBlock& largest = *std::max_element(
      scene.water.begin(), scene.water.end(),
      [](const WaterBlock& a, const WaterBlock& b) { return box_volume(a) < box_volume(b); });
  return best_lattice(largest.upper - largest.lower, particle_spacing(scene),
                      std::numeric_limits<double>::infinity());
}

}  // namespace

std::vector<Lattice> lattices(const Scene& scene) {
  const Lattice largest = largest_lattice(scene);
  std::vector<Lattice> all;
  for (const WaterBlock& block : scene.water) {
    const Vector3 edge = block.upper - block.lower;
    const bool is_alike = lattice_of(edge, largest.counts).step == largest.step;
    all.push_back(is_alike ? largest
                           : best_lattice(edge, std::cbrt(largest.cell()), largest.cell()));
  }
  return all;
}

double particle_volume(const Scene& scene) {
  return largest_lattice(scene).cell();
}

}  // namespace splash::sim
