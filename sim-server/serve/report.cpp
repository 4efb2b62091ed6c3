// SPDX-License-Identifier: MIT
// The keys of the JSON are a contract with the benchmark: add, never rename.
#include "sim-server/serve/report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "program/files.hpp"

namespace splash::sim {
namespace {

/// `sum` over `all`, or over 1 if `all` is less [1].
double share(double sum, std::int64_t all) {
  return sum / static_cast<double>(std::max<std::int64_t>(all, 1));
}

/// Mean over the frames that ended without a fault [1].
double mean_density_error(const RunTotals& totals) {
  return share(totals.mean_excess_sum,
               totals.frames - static_cast<std::int64_t>(totals.calmed + totals.resets));
}

/// Bubble particles alive, in particles of water, mean and most of all frames [1].
double mean_bubbles(const RunReport& report) {
  return share(share(report.totals.bubbles_alive_sum, report.totals.frames), report.particles);
}
double most_bubbles(const RunReport& report) {
  return share(static_cast<double>(report.totals.bubbles_alive_most), report.particles);
}

double mean_asleep(const RunTotals& totals) {
  return share(totals.skipped.asleep_sum, totals.frames);
}

/// Impacts that none followed, by reason.
NamedCounts by_reason(const NoCavity& none) {
  return {{"stopped", none.stopped},
          {"shallow", none.shallow},
          {"afloat", none.afloat},
          {"unseen", none.unseen},
          {"filled", none.filled}};
}

using Json = nlohmann::ordered_json;

constexpr double kLitres = 1000.0;  ///< in a cubic metre

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json known_or_null(const std::optional<std::uint64_t>& value) {
  return value ? Json(*value) : Json(nullptr);
}

double per(double amount, double of) {
  return of > 0.0 ? amount / of : std::numeric_limits<double>::quiet_NaN();
}

Json by_name(const NamedCounts& counts) {
  Json json = Json::object();
  for (const auto& [name, count] : counts) json[name] = count;
  return json;
}

/// Per solve [1]; not a number without solves.
double mean_iterations(const SolveWork& solve) {
  return per(static_cast<double>(solve.iterations), static_cast<double>(solve.solves));
}

Json iterations_of(const SolveWork& solve) {
  return {{"mean", finite_or_null(mean_iterations(solve))},
          {"most", solve.most},
          {"given_up", solve.given_up},
          {"solves", solve.solves}};
}

/// Nothing where all are zero.
void put_counts(const char* head, const NamedCounts& counts, std::ostream& text) {
  if (sum_of(counts) == 0) return;
  text << head;
  for (const auto& [name, count] : counts) {
    if (count > 0) text << ' ' << name << ' ' << count;
  }
}

std::string known_or_dash(const std::optional<std::uint64_t>& value) {
  return value ? std::to_string(*value) : "unknown (no target answered)";
}

Json cost_of(const Cost& cost) {
  return {{"wall_seconds", finite_or_null(cost.wall)},
          {"processor_seconds", finite_or_null(cost.processor)}};
}

}  // namespace

std::uint64_t sum_of(const NamedCounts& counts) noexcept {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& entry) { return sum + entry.second; });
}

double RunReport::steps_per_second() const noexcept {
  return per(static_cast<double>(totals.steps), run.wall);
}

double RunReport::real_time_factor() const noexcept {
  return per(simulated_seconds, run.wall);
}

std::string to_json(const RunReport& report) {
  const SkipTotals& skipped = report.totals.skipped;
  Json json;
  json["device"] = report.device;
  json["scene"] = report.scene;
  json["solver"] = report.solver;
  json["solver_notice"] = report.solver_notice;
  json["particles"] = report.particles;
  json["steps"] = report.totals.steps;
  json["frames"] = report.totals.frames;
  json["simulated_seconds"] = finite_or_null(report.simulated_seconds);
  json["wall_seconds"] = finite_or_null(report.run.wall);
  json["processor_seconds"] = finite_or_null(report.run.processor);
  json["start"] = cost_of(report.start);
  json["settling"] = cost_of(report.settling);
  json["settled_file"] = report.settled_file;
  json["steps_per_second"] = finite_or_null(report.steps_per_second());
  json["real_time_factor"] = finite_or_null(report.real_time_factor());
  json["mean_density_error"] = finite_or_null(mean_density_error(report.totals));
  json["maximum_density_error"] = finite_or_null(report.totals.max_excess);
  json["iterations"] = iterations_of(report.solve);
  report.sent.events.each(
      [&](const char* kind, std::uint64_t count) { json["events"][kind] = count; });
  json["no_cavity"] = by_name(by_reason(report.totals.no_cavity));
  json["air"] = {{"entrapped_litres", finite_or_null(kLitres * report.totals.air.entrapped)},
                 {"by_bodies_litres", finite_or_null(kLitres * report.totals.air.by_bodies)},
                 {"told_litres", finite_or_null(kLitres * report.totals.air.told)},
                 {"thinned_bubbles", report.totals.air.thinned}};
  json["bubble_particles"] = {{"mean_share", finite_or_null(mean_bubbles(report))},
                              {"largest_share", finite_or_null(most_bubbles(report))}};
  json["invalid_events"] = report.sent.invalid;
  json["overdue_events"] = report.sent.overdue;
  json["send_failures"] = report.send_failures;
  json["late"] = known_or_null(report.late);
  json["lost"] = known_or_null(report.lost);
  json["shown_frames"] = report.shown;
  json["felt_frames"] = report.totals.felt;
  json["behind"] = report.paced.behind;
  json["slipped_seconds"] = finite_or_null(report.paced.slipped);
  json["most_behind"] = finite_or_null(report.paced.most_behind);
  json["overload"] = {{"lean_seconds", finite_or_null(report.lean_seconds)},
                      {"coarse_seconds", finite_or_null(report.coarse_seconds)},
                      {"slow_seconds", finite_or_null(report.slow_seconds)}};
  json["skipped"] = {{"idle_frames", skipped.idle},
                     {"contact_passes", skipped.contacts},
                     {"bubble_passes", skipped.bubbles},
                     {"cavity_searches", skipped.cavities},
                     {"kernel_parts", skipped.kernel_parts},
                     {"asleep", finite_or_null(mean_asleep(report.totals))}};
  json["refused_poses"] = sum_of(report.refused_poses);
  json["refused"] = {{"poses", by_name(report.refused_poses)},
                     {"datagrams", by_name(report.refused_datagrams)},
                     {"messages", report.refused_messages}};
  json["resets"] = report.totals.resets;
  json["retried_frames"] = report.totals.retried;
  json["calmed_frames"] = report.totals.calmed;
  // A device may call itself anything: bytes that are no UTF-8 are replaced.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_report(const std::filesystem::path& path, const RunReport& report) {
  program::write_file(path, to_json(report), "cannot write the report '" + path.string() + "'");
}

std::string summary(const RunReport& report) {
  const SkipTotals& skipped = report.totals.skipped;
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  text << "scene     " << report.scene << ", " << report.particles << " particles on "
       << report.device << '\n';
  text << "time      " << report.simulated_seconds << " s simulated in " << report.run.wall
       << " s: real-time factor " << report.real_time_factor() << ", " << std::setprecision(0)
       << report.steps_per_second() << " steps/s\n";
  text << std::setprecision(2) << "cost      " << report.run.processor
       << " s of processor; before, ready after " << report.start.wall << " s ("
       << report.start.processor << " s of processor), of which the water took "
       << report.settling.wall << " s (" << report.settling.processor << ") to come to rest"
       << (report.settled_file.empty() ? "" : ", as it is from " + report.settled_file) << '\n';
  text << "pressure  " << report.solver_notice << '\n';
  text << std::setprecision(2) << "density   error mean "
       << 100.0 * mean_density_error(report.totals) << " %, maximum "
       << 100.0 * report.totals.max_excess << " %\n";
  if (report.solve.solves > 0) {
    text << "solver    iterations per step: " << mean_iterations(report.solve) << ", at most "
         << report.solve.most << "; given up " << report.solve.given_up << '\n';
  }
  const char* before = "events    ";
  report.sent.events.each([&](const char* kind, std::uint64_t count) {
    text << std::exchange(before, ", ") << count << ' ' << kind;
  });
  put_counts("; impacts without one:", by_reason(report.totals.no_cavity), text);
  text << '\n';
  text << "air       " << kLitres * report.totals.air.entrapped << " l entrapped ("
       << kLitres * report.totals.air.by_bodies << " by bodies), "
       << kLitres * report.totals.air.told << " l told, " << report.totals.air.thinned
       << " bubbles over the budget; bubble particles " << 100.0 * mean_bubbles(report)
       << " % of the water's on average, " << 100.0 * most_bubbles(report) << " % at most\n";
  text << "receivers late " << known_or_dash(report.late) << ", lost " << known_or_dash(report.lost)
       << ", refused by the network " << report.send_failures << '\n';
  text << "skipped   " << 100.0 * mean_asleep(report.totals) << " % of the water asleep, of "
       << report.totals.frames << " frames " << skipped.idle << " idle, " << skipped.contacts
       << " without contacts, " << skipped.bubbles << " without bubbles, " << skipped.cavities
       << " without cavities\n";
  if (const auto refused = sum_of(report.refused_poses); refused > 0) {
    text << "poses     " << refused;
    put_counts(" refused:", report.refused_poses, text);
    text << '\n';
  }
  text << "pacing    " << report.paced.behind << " of " << report.totals.frames
       << " frames behind, " << std::setprecision(3) << report.paced.slipped << " s slipped, "
       << report.totals.resets << " resets, " << report.totals.calmed << " frames given up, "
       << report.totals.retried << " retried\n";
  return text.str();
}

}  // namespace splash::sim
