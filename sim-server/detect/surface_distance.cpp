// SPDX-License-Identifier: MIT
#include "sim-server/detect/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim-server/fluid/params/smoothing.hpp"

namespace splash::sim {
namespace {

constexpr std::size_t kEntries = 512;

}  // namespace

SurfaceDistance::SurfaceDistance(double spacing, double support, double layer_weight)
    : spacing_(spacing),
      support_(support),
      layer_weight_(layer_weight),
      depth_(kSurfaceLoss * spacing),
      nearest_(-spacing / 2.0 - depth_),
      farthest_(support - spacing / 2.0 - depth_) {
  colours_.reserve(kEntries);
  for (std::size_t k = 0; k < kEntries; ++k) {
    const double part = static_cast<double>(k) / (kEntries - 1);
    colours_.push_back(colour_at(nearest_ + part * (farthest_ - nearest_)));
  }
}

double SurfaceDistance::colour_at(double d) const {
  double colour = 0.0;
  const int layers = static_cast<int>(std::ceil((support_ - d) / spacing_)) + 1;
  for (int layer = 0; layer < layers; ++layer) {
    colour += layer_weight_ * plane_marginal(d + depth_ + (layer + 0.5) * spacing_, support_);
  }
  return colour;
}

double SurfaceDistance::distance_for(double colour) const {
  if (colour >= colours_.front()) return nearest_;
  if (colour <= colours_.back()) return farthest_;
  const auto below = std::lower_bound(colours_.begin(), colours_.end(), colour,
                                      [](double entry, double value) { return entry > value; });
  const auto k = static_cast<std::size_t>(below - colours_.begin());
  const double part = (colours_[k - 1] - colour) / (colours_[k - 1] - colours_[k]);
  const double step = (farthest_ - nearest_) / (kEntries - 1);
  return nearest_ + (static_cast<double>(k - 1) + part) * step;
}

}  // namespace splash::sim
