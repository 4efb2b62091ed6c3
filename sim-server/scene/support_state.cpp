// SPDX-License-Identifier: MIT
#include "sim-server/scene/support_state.hpp"

#include <algorithm>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/water_cells.hpp"

namespace splash::sim {
namespace {

/// Levels may differ by so much [spacings]: less is closed by the packing.
constexpr double kEven = 2.0;

using Cells = std::vector<std::int64_t>;

/// Energy of water per mass in gravity and pull [J/kg].
double potential(const FluidSettings& fluid, const Vector3& x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double way = x[i] - fluid.pull_centre[i];
    sum += 0.5 * fluid.pull[i] * fluid.pull[i] * way * way - fluid.gravity[i] * x[i];
  }
  return sum;
}

/// How much it grows in one spacing there, at most [J/kg].
double rise(const FluidSettings& fluid, const Vector3& x, double spacing) {
  Vector3 slope = {};
  for (std::size_t i = 0; i < 3; ++i) {
    slope[i] = fluid.pull[i] * fluid.pull[i] * (x[i] - fluid.pull_centre[i]) - fluid.gravity[i];
  }
  return spacing * length(slope);
}

/// All bodies of water of a scene, one after the other.
class WaterBodies {
 public:
  WaterBodies(const Scene& scene, std::span<const Keyframe> poses)
      : fluid_(scene.fluid),
        spacing_(particle_spacing(scene)),
        cells_(scene, poses),
        body_(static_cast<std::size_t>(cells_.count()), 0),
        air_(body_.size(), 0) {
    for (std::int64_t cell = 0; cell < cells_.count(); ++cell) {
      if (cells_.at(cell) == Matter::water && body_of(cell) == 0) add_body(cell);
    }
  }

  [[nodiscard]] SupportState at(const Vector3& place) const {
    const std::int64_t cell = cells_.water_near(place);
    if (cell == WaterCells::kNone) return SupportState::supported;
    return support_states_[static_cast<std::size_t>(body_of(cell) - 1)];
  }

  [[nodiscard]] bool all_supported() const {
    return std::all_of(support_states_.begin(), support_states_.end(),
                       [](SupportState state) { return state == SupportState::supported; });
  }

 private:
  [[nodiscard]] int body_of(std::int64_t cell) const {
    return body_[static_cast<std::size_t>(cell)];
  }
  [[nodiscard]] double energy(std::int64_t cell) const {
    return potential(fluid_, cells_.middle(cell));
  }

  /// All water that can be reached from this cell.
  void add_body(std::int64_t first) {
    const int body = static_cast<int>(support_states_.size()) + 1;
    Cells water = {first};
    body_[static_cast<std::size_t>(first)] = body;
    double level = energy(first);
    for (std::size_t k = 0; k < water.size(); ++k) {
      level = std::max(level, energy(water[k]));
      for (const std::int64_t next : cells_.beside(water[k])) {
        if (next == WaterCells::kNone || cells_.at(next) != Matter::water || body_of(next) != 0) {
          continue;
        }
        body_[static_cast<std::size_t>(next)] = body;
        water.push_back(next);
      }
    }
    support_states_.push_back(!finds_way_down(water, level, body) ? SupportState::supported
                              : stands(water)                     ? SupportState::flowing
                                                                  : SupportState::free_falling);
  }

  /// Whether through air that is below its level it gets deep.
  [[nodiscard]] bool finds_way_down(Cells reached, double level, int body) {
    for (std::size_t k = 0; k < reached.size(); ++k) {
      for (const std::int64_t next : cells_.beside(reached[k])) {
        if (next == WaterCells::kNone || cells_.at(next) != Matter::air) continue;
        int& seen = air_[static_cast<std::size_t>(next)];
        const double deep = level - energy(next);
        if (seen == body || deep <= 0.0) continue;
        if (deep > kEven * rise(fluid_, cells_.middle(next), spacing_)) return true;
        seen = body;
        reached.push_back(next);
      }
    }
    return false;
  }

  /// Whether something solid is beneath any of it.
  [[nodiscard]] bool stands(const Cells& water) const {
    return std::any_of(water.begin(), water.end(), [this](std::int64_t cell) {
      const auto beside = cells_.beside(cell);
      return std::any_of(beside.begin(), beside.end(), [&](std::int64_t next) {
        return next != WaterCells::kNone && cells_.at(next) == Matter::solid &&
               energy(next) < energy(cell);
      });
    });
  }

  FluidSettings fluid_;
  double spacing_;
  WaterCells cells_;
  std::vector<int> body_;  ///< of each cell, from 1 on; 0: none
  std::vector<int> air_;   ///< the last body whose air this cell was
  std::vector<SupportState> support_states_;
};

}  // namespace

std::vector<SupportState> support_states(const Scene& scene, std::span<const Keyframe> poses,
                                         const std::vector<Vector3>& particles) {
  std::vector<SupportState> all(particles.size(), SupportState::free_falling);
  if (length(scene.fluid.gravity) == 0.0 && length(scene.fluid.pull) == 0.0) return all;
  const WaterBodies water(scene, poses);
  std::transform(particles.begin(), particles.end(), all.begin(),
                 [&](const Vector3& place) { return water.at(place); });
  return all;
}

bool is_all_supported(const Scene& scene) {
  if (length(scene.fluid.gravity) == 0.0 && length(scene.fluid.pull) == 0.0) return false;
  std::vector<Keyframe> poses;
  for (const BodySettings& body : scene.bodies) poses.push_back(body.rest);
  return WaterBodies(scene, poses).all_supported();
}

}  // namespace splash::sim
