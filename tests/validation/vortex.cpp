// SPDX-License-Identifier: MIT
// The Taylor-Green cell in a pool: how fast it decays, and the viscosity that betrays.
#include <cmath>
#include <numbers>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kSide = 0.2;  // of the scene [m]
/// E = E0 exp(-2 nu (kx^2 + ky^2) t): Taylor & Green 1937.
const double kSquares = 2.0 * std::pow(std::numbers::pi / kSide, 2);

Outcome evaluate_vortex(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Column& time = run.gauges["time"];
  const Column& kinetic = run.gauges["all_kinetic"];
  // From the start to half of the energy: later the pool's own slosh is part of what is left.
  Column logarithm;
  for (const double e : kinetic) logarithm.push_back(std::log(e / kinetic.front()));
  const double half = first_reach(time, linear(-1.0, logarithm), std::log(2.0));
  const double end = std::isfinite(half) ? half : time.back();
  const double viscosity = -fit_line(time, logarithm, 0.0, end).second / (2.0 * kSquares);
  return {{{"decay rate, error", 100.0 * (viscosity / run.scene.fluid.viscosity - 1.0), "%", -10.0,
            10.0},
           {"viscosity from the decay", viscosity, "m2/s"}},
          {{"", time, linear(1.0 / kinetic.front(), kinetic)}}};
}

std::vector<Curve> reference_vortex() {
  Curve exact = {"nu = 1e-3 m2/s", {}, {}};
  for (int k = 0; k <= 100; ++k) {
    exact.x.push_back(0.01 * k);
    exact.y.push_back(std::exp(-2.0e-3 * kSquares * 0.01 * k));
  }
  return {exact};
}

}  // namespace

Case vortex() {
  return {.name = "vortex",
          .title = "A Taylor-Green cell in a pool, Re = 60",
          .scenes = {"vortex"},
          .seconds = 1.0,
          .spacings = {0.02, 0.01, 0.005},
          .size = kSide,
          .size_name = "L",
          .evaluate = evaluate_vortex,
          .reference = reference_vortex,
          .x_label = "time [s]",
          .y_label = "kinetic energy over that at the start"};
}

}  // namespace splash::validation
