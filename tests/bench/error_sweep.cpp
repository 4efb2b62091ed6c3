// SPDX-License-Identifier: MIT
#include "tests/bench/error_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "program/text.hpp"
#include "tests/bench/progress.hpp"
#include "tests/support/detections.hpp"

namespace splash::bench {
namespace {

using sim::KernelKind;
using sim::PressureKind;

/// A frame has whole steps: a thousand a second would shorten those of the grid.
constexpr double kFrames = 200.0;
constexpr double kHalf = 0.5;
constexpr double kLonger = 1.25;

void tell(const Progress& progress, const SweepPoint& point) {
  const sim::SolveWork& work = point.result.work;
  std::printf("%s %7d  %8.3f  %8.3f  %9.3g", progress.end().c_str(), point.result.particles,
              point.wall_cost(), point.processor_cost(1), point.error());
  if (work.solves > 0) std::printf("  %.1f (%d)", point.iterations(), work.most);
  std::printf("\n");
  std::fflush(stdout);
}

/// Of SweepPoint::error in the outcome; what has no such figure is a mistake of ours.
double figure_of(const validation::Outcome& outcome, const std::string& name) {
  for (const validation::Figure& figure : outcome.figures) {
    if (figure.name == name) return figure.value;
  }
  throw std::out_of_range("the case has no figure '" + name + "'");
}

validation::Setting setting_of(const Quality& quality, double spacing) {
  validation::Setting setting;
  setting.spacing = spacing;
  setting.solver = quality.solver;
  setting.time_step_factor = quality.time_step_factor;
  setting.detects = false;
  setting.most_frames = kFrames;
  setting.skip.emplace();
  setting.skip->sleep = false;
  setting.skip->idle = false;
  return setting;
}

}  // namespace

std::string Quality::name() const {
  std::string text =
      solver == PressureKind::grid_projected ? "grid-projected" : "weakly compressible";
  if (time_step_factor != 1.0) text += program::format(", dt x %g", time_step_factor);
  if (kernels == KernelKind::reference) text += ", reference kernels";
  return text;
}

double SweepPoint::error() const {
  return std::abs(figure_of(result.outcome, item->figure));
}

double SweepPoint::iterations() const {
  return static_cast<double>(result.work.iterations) / static_cast<double>(result.work.solves);
}

double SweepPoint::wall_cost() const {
  return result.steps_alone.wall / result.simulated;
}

double SweepPoint::processor_cost(unsigned cores) const {
  return result.steps_alone.processor / result.simulated / cores;
}

const std::vector<SweepCase>& sweep_cases() {
  static const std::vector<SweepCase> kCases = {
      {"standing_wave", "period, error"},
      {"hydrostatic", "profile, rms of rho g H", 8.0},
      {"elliptical_drop", "short axis, error"},
      {"oscillating_drop", "axis after one period, error"},
      {"vortex", "decay rate, error"},
      {"dam_martin_moyce", "front, rms with one shift"},
      {"dam_koshizuka_oka", "front, rms with one shift"},
      {"spheric2", "H1 to H4, mean error, of the column", 3.0},
      {"float", "draft, error, of the height"},
  };
  return kCases;
}

std::vector<Quality> quick_qualities() {
  std::vector<Quality> list;
  for (const PressureKind solver : tests::kBothSolvers) list.push_back({solver});
  list.push_back({.time_step_factor = kHalf});
  list.push_back({.kernels = KernelKind::reference});
  return list;
}

std::vector<Quality> all_qualities() {
  std::vector<Quality> list;
  for (const PressureKind solver : tests::kBothSolvers) {
    for (const double factor : {1.0, kHalf, kLonger}) list.push_back({solver, factor});
    list.push_back({solver, 1.0, KernelKind::reference});
  }
  return list;
}

std::vector<SweepPoint> sweep(const SweepPlan& plan, int device,
                              const std::function<void(const std::vector<SweepPoint>&)>& done) {
  sim::Device vectors(device);
  sim::Device scalars(device, false, 1);
  std::vector<SweepPoint> points;
  std::printf(
      "\ncase              resolution  quality                                particles"
      "  seconds   of processors   error   iterations\n");
  for (const SweepCase* item : plan.cases) {
    static std::vector<std::unique_ptr<validation::Case>> kept;  // results point to them
    kept.push_back(std::make_unique<validation::Case>(validation::case_named(item->name)));
    validation::Case& run = *kept.back();
    if (item->seconds > 0.0) run.seconds = item->seconds;
    const std::size_t count = std::min(plan.resolutions, run.spacings.size());
    for (std::size_t k = 0; k < count; ++k) {
      for (const Quality& quality : plan.qualities) {
        Progress progress(program::format("%-17s %s/dp = %-4.0f  %-38s", item->name.c_str(),
                                          run.size_name.c_str(), run.size / run.spacings[k],
                                          quality.name().c_str()));
        sim::Device& where = quality.kernels == KernelKind::reference ? scalars : vectors;
        points.push_back({item, quality,
                          validation::run_case(where, run, setting_of(quality, run.spacings[k]), {},
                                               [&](double share) { progress(share); })});
        tell(progress, points.back());
        done(points);
      }
    }
  }
  return points;
}

}  // namespace splash::bench
