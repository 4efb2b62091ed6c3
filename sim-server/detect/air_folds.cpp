// SPDX-License-Identifier: MIT
#include "sim-server/detect/air_folds.hpp"

#include <algorithm>
#include <cmath>

namespace splash::sim {
namespace {

/// Particles within an eddy's width tell its energy from their mean motion [spacings].
constexpr double kLeastWidth = 2.0;

/// Air that a particle entrains each second, over 4 a (1 - a) (k - k0)^(3/2) [s2]; 0 without
/// gravity, against which the work would be done.
double factor_of(const DetectSettings& settings, const FluidParams& p, double width) {
  const double lift = lift_of(settings, p);
  if (lift <= 0.0) return 0.0;
  const double water = SPLASH_FOLDS_APART * static_cast<double>(p.mass);  // that it stands for [kg]
  return settings.bubble_energy * water / (width * lift);
}

/// Rows of cells along x.
std::size_t rows_of(const FluidParams& p) {
  return static_cast<std::size_t>(p.cells_y) * static_cast<std::size_t>(p.cells_z);
}

}  // namespace

double gravity_of(const FluidParams& params) {
  return std::hypot(static_cast<double>(params.gravity_x), static_cast<double>(params.gravity_y),
                    static_cast<double>(params.gravity_z));
}

double lift_of(const DetectSettings& settings, const FluidParams& params) {
  return static_cast<double>(params.rest_density) * gravity_of(params) * settings.bubble_eddy;
}

double eddy_width(const DetectSettings& settings, double spacing) {
  return std::max(settings.bubble_eddy, kLeastWidth * spacing);
}

AirFolds::AirFolds(Fluid& fluid, const cl::Program& program)
    : fluid_(fluid),
      folds_(fluid.device(),
             static_cast<std::size_t>(fluid.params().count / SPLASH_FOLDS_APART + 1)),
      fastest_(fluid.device(),
               rows_of(fluid.params()) * static_cast<std::size_t>(fluid.params().cells_x)),
      find_fastest_(program, "find_fastest",
                    std::min<std::size_t>(fluid.device().profile().group, 4)),
      fold_air_(program, "fold_air") {}

void AirFolds::enqueue(const Step& step, const DetectSettings& settings, int phase) {
  skip();
  looks_ = settings.bubble_energy > 0.0;
  if (!looks_) return;
  const FluidParams& p = fluid_.params();
  const Boundary& boundary = fluid_.boundary();
  const double width = eddy_width(settings, static_cast<double>(p.spacing));
  folds_.enqueue_clear(fluid_.device());
  find_fastest_.run(fluid_.device().queue(), rows_of(p),
                    {{"p", fluid_.params_buffer()},
                     {"cell_start", fluid_.grid().cell_start()},
                     {"velocity", fluid_.particles().velocity},
                     {"fastest", fastest_}});
  fold_air_.run(fluid_.device().queue(), folds_.room(),
                {{"p", fluid_.params_buffer()},
                 {"cell_start", fluid_.grid().cell_start()},
                 {"position", fluid_.particles().position},
                 {"velocity", fluid_.particles().velocity},
                 {"id", fluid_.particles().id},
                 {"body_count", boundary.body_count()},
                 {"fastest", fastest_},
                 {"piston", as_float(step.piston)},
                 {"reach", as_float(width)},
                 {"least", as_float(1.5 * settings.bubble_onset * settings.bubble_onset)},
                 {"factor", as_float(factor_of(settings, p, width))},
                 {"phase", phase}},
                folds_.args(), boundary.matter());
}

}  // namespace splash::sim
