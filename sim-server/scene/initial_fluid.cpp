// SPDX-License-Identifier: MIT
#include "sim-server/scene/initial_fluid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim-server/scene/lattice.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/support_state.hpp"

namespace splash::sim {
namespace {

/// Places in a cell, in its edges, that tell how much of it is water: a lattice of rank one whose
/// points have 256 different places along each axis, so that a flat face is known to a 256th
/// (Sloan & Joe 1994, Lattice Methods for Multiple Integration).
constexpr int kSamples = 256;
Vector3 sample(int i) {
  constexpr std::array<int, 3> kGenerator = {1, 83, 189};
  Vector3 place = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place[axis] = (i * kGenerator[axis] % kSamples + 0.5) / kSamples;
  }
  return place;
}

/// A particle needs so much of a cell around it free of solids [1].
constexpr double kRoom = 0.5;
/// Layers, at most, of what lies on top of a block.
constexpr int kMostOnTop = 8;
/// By rounding a layer may seem to end so much above the level [of its height].
constexpr double kRounding = 1.0e-9;

/// What is solid: bodies, the tank's walls and its floor.
class Solids {
 public:
  Solids(const Scene& scene, std::span<const Keyframe> poses) : scene_(scene), poses_(poses) {}

  /// Bodies that may be nearer than this [m].
  [[nodiscard]] std::vector<std::size_t> near(const Vector3& x, double reach) const {
    std::vector<std::size_t> bodies;
    for (std::size_t b = 0; b < poses_.size(); ++b) {
      if (distance_to(scene_.bodies[b].shape, in_body(b, x)) < reach) bodies.push_back(b);
    }
    return bodies;
  }

  /// `bodies`: those that may be there.
  [[nodiscard]] bool at(const Vector3& x, const std::vector<std::size_t>& bodies) const {
    if (is_outside(scene_, x)) return true;
    return std::any_of(bodies.begin(), bodies.end(), [&](std::size_t b) {
      return is_inside(scene_.bodies[b].shape, in_body(b, x));
    });
  }

 private:
  [[nodiscard]] Vector3 in_body(std::size_t b, const Vector3& x) const {
    return rotate(inverse(poses_[b].rotation), x - poses_[b].position);
  }

  const Scene& scene_;
  std::span<const Keyframe> poses_;
};

/// Of a cell of the lattice.
struct FillCell {
  double water = 0.0;   ///< part of it that is water [1]
  Vector3 middle = {};  ///< of that water [m]
  bool has_room = false;
};

/// Fills one block.
class Filling {
 public:
  Filling(const Scene& scene, std::span<const Keyframe> poses, std::size_t block,
          const Lattice& lattice, double sound_speed)
      : scene_(scene),
        block_(scene.water[block]),
        lattice_(lattice),
        solids_(scene, poses),
        reach_(0.5 *
               length(lattice.step + Vector3{0.0, 0.0, scene.slope.gradient * lattice.step[0]})),
        stratification_(stratification(scene, sound_speed)),
        per_cell_(lattice.cell() / particle_volume(scene) /
                  (1.0 + compression(scene, sound_speed))) {
    const Vector3 middle = 0.5 * (block_.lower + block_.upper);
    const bool in_air = block_.lower[2] > floor_height(scene, block_.upper[0]);
    hangs_ = in_air && support_states(scene, poses, {middle}).front() == SupportState::free_falling;
  }

  BlockWater fill(std::vector<Vector3>& out) {
    double cells = 0.0;      // of water
    double particles = 0.0;  // that are wanted
    double due = 0.0;        // of them, and not yet there
    const std::size_t before = out.size();
    for (int k = 0; k < lattice_.counts[2]; ++k) {
      for (int j = 0; j < lattice_.counts[1]; ++j) {
        for (int i = 0; i < lattice_.counts[0]; ++i) {
          const FillCell cell = look_at({i, j, k});
          const double share = cell.water * weight(cell.middle);
          cells += cell.water;
          particles += share;
          due += share;
          if (due < 0.5 || !cell.has_room) continue;
          out.push_back(cell.middle);
          due -= 1.0;
        }
      }
    }
    for (int layer = 0; due >= 0.5 && layer < kMostOnTop; ++layer) put_on_top(layer, due, out);
    const double wanted = cells * lattice_.cell();
    const auto there = static_cast<double>(out.size() - before);
    return {wanted, particles > 0.0 ? wanted * there / particles : 0.0};
  }

 private:
  using Index = std::array<int, 3>;

  /// Where `share`, in its edges, of a cell is [m]. Rows follow the floor.
  [[nodiscard]] Vector3 place(const Index& index, const Vector3& share) const {
    Vector3 x = block_.lower;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      x[axis] += (index[axis] + share[axis]) * lattice_.step[axis];
    }
    x[2] = std::max(block_.lower[2], floor_height(scene_, x[0])) +
           (index[2] + share[2]) * lattice_.step[2];
    return x;
  }

  /// How many particles a cell of the column there is filled with, if all of it is water [1].
  [[nodiscard]] double weight(const Vector3& x) const {
    if (hangs_) return per_cell_;
    const WaterColumn column = water_column(scene_, x);
    return per_cell_ * (1.0 + stratification_ * (column.top - column.bottom) / 2.0);
  }

  [[nodiscard]] FillCell look_at(const Index& index) const {
    const Vector3 middle = place(index, {0.5, 0.5, 0.5});
    const std::vector<std::size_t> bodies = solids_.near(middle, reach_);
    const bool is_cut = place(index, {1.0, 1.0, 1.0 - kRounding})[2] > block_.upper[2];
    if (bodies.empty() && !is_cut && block_.form == WaterForm::box) return {1.0, middle, true};
    FillCell cell;
    int wet = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Vector3 x = place(index, sample(i));
      if (x[2] > block_.upper[2] || !is_filled(block_, x) || solids_.at(x, bodies)) continue;
      cell.middle = cell.middle + x;
      ++wet;
    }
    if (wet == 0) return cell;
    cell.middle = (1.0 / wet) * cell.middle;
    cell.water = static_cast<double>(wet) / kSamples;
    cell.has_room = has_room(cell.middle);
    return cell;
  }

  /// Whether enough of the cell around a place is free of solids.
  [[nodiscard]] bool has_room(const Vector3& x) const {
    const std::vector<std::size_t> bodies = solids_.near(x, reach_);
    int free = 0;
    for (int i = 0; i < kSamples; ++i) {
      Vector3 there = sample(i);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        there[axis] = x[axis] + (there[axis] - 0.5) * lattice_.step[axis];
      }
      free += !solids_.at(there, bodies);
    }
    return free >= kRoom * kSamples;
  }

  /// Of what is `due`, as much as a layer above the block's level takes, evenly; nothing where a
  /// layer below it is not free.
  void put_on_top(int layer, double& due, std::vector<Vector3>& out) const {
    std::vector<Vector3> free;
    for (int j = 0; j < lattice_.counts[1]; ++j) {
      for (int i = 0; i < lattice_.counts[0]; ++i) {
        Vector3 x = place({i, j, 0}, {0.5, 0.5, 0.5});
        bool is_free = x[2] <= block_.upper[2];
        for (int k = 0; k <= layer && is_free; ++k) {
          x[2] = block_.upper[2] + (k + 0.5) * lattice_.step[2];
          is_free = has_room(x) && !is_in_another(x);
        }
        if (is_free) free.push_back(x);
      }
    }
    const double each =
        std::min(1.0, due / static_cast<double>(std::max<std::size_t>(free.size(), 1)));
    double share = 0.0;
    for (const Vector3& x : free) {
      share += each;
      if (share < 0.5) continue;
      out.push_back(x);
      share -= 1.0;
      due -= 1.0;
    }
  }

  [[nodiscard]] bool is_in_another(const Vector3& x) const {
    return std::any_of(scene_.water.begin(), scene_.water.end(), [&](const WaterBlock& block) {
      if (&block == &block_) return false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (x[axis] < block.lower[axis] || x[axis] > block.upper[axis]) return false;
      }
      return true;
    });
  }

  const Scene& scene_;
  const WaterBlock& block_;
  Lattice lattice_;
  Solids solids_;
  double reach_;  ///< nothing of a cell is farther from its middle, nor of one around it [m]
  double stratification_;
  double per_cell_;  ///< particles whose water at rest, without weight, a cell takes [1]
  bool hangs_ = false;
};

using std::numbers::pi;

Vector3 standing_wave(const Scene& scene, const Vector3& place) {
  const Vector3 size = scene.tank.upper - scene.tank.lower;
  const Vector3 x = place - scene.tank.lower;
  const Vector3& g = scene.fluid.gravity;
  const double k = scene.flow.mode * pi / size[0];
  const double depth = water_depth(scene);
  const double omega = std::sqrt(std::hypot(g[0], g[1], g[2]) * k * std::tanh(k * depth));
  // cosh(kz) / sinh(kH) and sinh(kz) / sinh(kH), of which a short wave in deep water overflows
  // both.
  const double scale = scene.flow.amplitude * omega * std::exp(k * (x[2] - depth)) /
                       (1.0 - std::exp(-2.0 * k * depth));
  const double below = std::exp(-2.0 * k * x[2]);
  return {-scale * (1.0 + below) * std::sin(k * x[0]), 0.0,
          scale * (1.0 - below) * std::cos(k * x[0])};
}

Vector3 vortex(const Scene& scene, const Vector3& place) {
  const Vector3 size = scene.tank.upper - scene.tank.lower;
  const Vector3 x = place - scene.tank.lower;
  const double kx = pi / size[0];
  const double ky = pi / size[1];
  return {scene.flow.speed * std::sin(kx * x[0]) * std::cos(ky * x[1]),
          -scene.flow.speed * kx / ky * std::cos(kx * x[0]) * std::sin(ky * x[1]), 0.0};
}

}  // namespace

bool is_filled(const WaterBlock& block, const Vector3& place) {
  if (block.form == WaterForm::box) return true;
  Vector3 share = {};  // from the middle, in half edges
  for (std::size_t i = 0; i < 3; ++i) {
    const double half = 0.5 * (block.upper[i] - block.lower[i]);
    share[i] = (place[i] - block.lower[i]) / half - 1.0;
  }
  if (block.form == WaterForm::cylinder) share[1] = 0.0;
  return std::hypot(share[0], share[1], share[2]) <= 1.0;
}

InitialWater initial_water(const Scene& scene, std::span<const Keyframe> poses,
                           double sound_speed) {
  if (poses.size() != scene.bodies.size()) {
    throw std::invalid_argument("initial_water: one pose for each body");
  }
  const std::vector<Lattice> rows = lattices(scene);
  InitialWater water;
  for (std::size_t b = 0; b < scene.water.size(); ++b) {
    water.blocks.push_back(Filling(scene, poses, b, rows[b], sound_speed).fill(water.particles));
  }
  return water;
}

std::vector<Vector3> initial_particles(const Scene& scene) {
  std::vector<Keyframe> poses;
  for (const auto& body : scene.bodies) poses.push_back(body.rest);
  return initial_particles(scene, poses);
}

std::vector<Vector3> initial_particles(const Scene& scene, std::span<const Keyframe> poses) {
  return initial_water(scene, poses, scene_sound_speed(scene)).particles;
}

Vector3 initial_velocity(const Scene& scene, const Vector3& place) {
  const Flow& flow = scene.flow;
  switch (flow.kind) {
    case FlowKind::uniform:
      return flow.velocity;
    case FlowKind::strain:
      return {flow.rate * (place[0] - flow.centre[0]), 0.0,
              -flow.rate * (place[2] - flow.centre[2])};
    case FlowKind::standing_wave:
      return standing_wave(scene, place);
    case FlowKind::vortex:
      return vortex(scene, place);
    case FlowKind::none:
      break;
  }
  return {0.0, 0.0, 0.0};
}

}  // namespace splash::sim
