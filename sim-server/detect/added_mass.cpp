// SPDX-License-Identifier: MIT
#include "sim-server/detect/added_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::sim {
namespace {

constexpr double kWater = 1000.0;  // [kg/m3]
constexpr int kSteps = 20;
constexpr double kNearly = 0.85;  ///< [1]

/// Of the wetting, at the end of a step.
struct Stage {
  double mass = 0.0, momentum = 0.0, area = 0.0, after = 0.0;
};

}  // namespace

double reach_of_blow(double area) {
  return 0.36 * std::sqrt(area);
}

double added_mass(double area, double aspect) {
  const double narrow = 1.0 / std::max(aspect, 1.0);
  const double shape = 1.0 / (1.0 + 0.727 * std::pow(narrow, 1.2));
  const double width = std::sqrt(area * narrow);
  return kWater * std::numbers::pi / 8.0 * shape * width * area;
}

void Patch::add(const Wetting& skin) {
  area_ += skin.area;
  backed_ += skin.area * skin.ahead;
  pressed_ += skin.area * skin.ahead * skin.speed;
  for (std::size_t a = 0; a < 3; ++a) {
    first_[a] += skin.area * skin.place[a];
    for (std::size_t b = 0; b < 3; ++b) {
      second_[a][b] += skin.area * skin.place[a] * skin.place[b];
    }
  }
}

double Patch::aspect() const {
  double trace = 0.0;
  double minors = 0.0;
  const auto variance = [&](std::size_t a, std::size_t b) {
    return second_[a][b] / area_ - first_[a] * first_[b] / (area_ * area_);
  };
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    trace += variance(a, a);
    minors += variance(a, a) * variance(b, b) - variance(a, b) * variance(a, b);
  }
  const double root = std::sqrt(std::max(trace * trace / 4.0 - minors, 0.0));
  const double least = trace / 2.0 - root;
  // A row of points has a width, too.
  const double longest = trace / 2.0 + root;
  const double narrowest = area_ * area_ / (144.0 * std::max(longest, 1e-12));
  return std::sqrt(std::max(longest / std::max({least, narrowest, 1e-12}), 1.0));
}

Growth growth_of(std::vector<Wetting> wettings, double step) {
  std::sort(wettings.begin(), wettings.end(),
            [](const Wetting& a, const Wetting& b) { return a.after < b.after; });
  Growth growth;
  Patch at_once;
  for (const Wetting& skin : wettings) {
    if (skin.after <= kAtOnce) at_once.add(skin);
  }
  growth.area_at_once = at_once.backed();
  growth.mass_at_once = at_once.mass();
  growth.momentum_at_once = at_once.momentum();
  std::vector<Stage> stages(1);
  Patch patch;
  auto next = wettings.begin();
  for (int k = 1; k <= kSteps; ++k) {
    Stage stage = stages.back();
    for (; next != wettings.end() && next->after <= k * step; ++next) {
      patch.add(*next);
      stage.after = next->after;
    }
    stage.mass = patch.mass();
    stage.momentum = patch.momentum();
    stage.area = patch.area();
    stages.push_back(stage);
  }
  double steepest = 0.0;
  for (std::size_t k = 1; k < stages.size(); ++k) {
    steepest = std::max(steepest, stages[k].mass - stages[k - 1].mass);
  }
  for (std::size_t k = 1; k < stages.size(); ++k) {
    if (stages[k].mass - stages[k - 1].mass < kNearly * steepest) continue;
    growth.rise = stages[k].after;
    growth.area = stages[k].area;
    growth.momentum = stages[k].momentum;
    break;
  }
  return growth;
}

}  // namespace splash::sim
