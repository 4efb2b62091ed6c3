// SPDX-License-Identifier: MIT
#include "sim-server/serve/run_report.hpp"

#include <algorithm>

#include "sim-server/scene/solver_choice.hpp"

namespace splash::sim {
namespace {

SolveTotals totals_of(const SolveWork& work) {
  return {work.solves, work.iterations, work.most, work.given_up};
}

/// Of `all`, at least one [1].
double share(double sum, std::int64_t all) {
  return sum / static_cast<double>(std::max<std::int64_t>(all, 1));
}

void put_water(const Simulation& simulation, RunReport& report) {
  const RunTotals& totals = simulation.totals();
  report.scene = simulation.scene().name;
  report.solver = name_of(simulation.scene().fluid.solver);
  report.solver_notice = solver_notice(simulation.scene());
  report.particles = simulation.particles();
  report.steps = totals.steps;
  report.frames = totals.frames;
  report.simulated_seconds = simulation.seconds();
  const auto healthy = totals.frames - static_cast<std::int64_t>(totals.calmed + totals.resets);
  report.mean_density_error = share(totals.mean_excess_sum, healthy);
  report.maximum_density_error = totals.max_excess;
  report.solve = totals_of(simulation.solver_work());
  report.felt = totals.felt;
  report.retried = totals.retried;
  report.calmed = totals.calmed;
  report.resets = totals.resets;
}

void put_air(const RunTotals& totals, std::int64_t particles, RunReport& report) {
  const double mean = share(totals.bubbles_alive_sum, totals.frames);
  report.air = {
      .entrapped = totals.air.entrapped,
      .by_bodies = totals.air.by_bodies,
      .told = totals.air.told,
      .thinned = totals.air.thinned,
      .mean_particles = share(mean, particles),
      .largest_particles = share(static_cast<double>(totals.bubbles_alive_most), particles)};
}

void put_cavities(const NoCavity& none, RunReport& report) {
  report.no_cavity = {{"stopped", none.stopped},
                      {"shallow", none.shallow},
                      {"afloat", none.afloat},
                      {"unseen", none.unseen},
                      {"filled", none.filled}};
}

void put_skips(const RunTotals& totals, RunReport& report) {
  const SkipTotals& skipped = totals.skipped;
  report.idle_frames = skipped.idle;
  report.without_contacts = skipped.contacts;
  report.without_bubbles = skipped.bubbles;
  report.without_cavities = skipped.cavities;
  report.kernel_parts = skipped.kernel_parts;
  report.asleep = share(skipped.asleep_sum, totals.frames);
}

}  // namespace

RunReport report_on(const Simulation& simulation, const SendCounts& sent, const PacerCounts& paced,
                    const Overload& overload) {
  RunReport report;
  put_water(simulation, report);
  put_air(simulation.totals(), simulation.particles(), report);
  put_cavities(simulation.totals().no_cavity, report);
  put_skips(simulation.totals(), report);
  report.events = sent.events;
  report.invalid_events = sent.invalid;
  report.overdue_events = sent.overdue;
  report.behind = paced.behind;
  report.slipped_seconds = paced.slipped;
  report.most_behind = paced.most_behind;
  report.lean_seconds = overload.spent_at(Load::lean);
  report.coarse_seconds = overload.spent_at(Load::coarse);
  report.slow_seconds = overload.spent_at(Load::slow);
  return report;
}

}  // namespace splash::sim
