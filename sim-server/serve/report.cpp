// SPDX-License-Identifier: MIT
// The keys of the JSON are a contract with the benchmark: add, never rename.
#include "sim-server/serve/report.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "program/files.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "sim-server/send/event_sender.hpp"
#include "sim-server/serve/overload.hpp"
#include "sim-server/serve/pacer.hpp"
#include "sim-server/simulation/simulation.hpp"

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

Json iterations_of(const SolveTotals& solve) {
  return {{"mean", finite_or_null(solve.mean())},
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

program::WriteError cannot_write(const std::filesystem::path& path, int error) {
  return {"cannot write the report '" + path.string() + "'", error};
}

/// `path` is what the person asked for, `file_path` where the bytes go.
void write_text(const std::filesystem::path& file_path, const std::filesystem::path& path,
                const std::string& text) {
  errno = 0;
  std::ofstream file(file_path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (file) return;
  const int error = errno;
  std::error_code ignored;  // the first error is the one to tell
  if (file_path != path) std::filesystem::remove(file_path, ignored);
  throw cannot_write(path, error);
}

Json cost_of(const Cost& cost) {
  return {{"wall_seconds", finite_or_null(cost.wall)},
          {"processor_seconds", finite_or_null(cost.processor)}};
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

std::uint64_t sum_of(const NamedCounts& counts) noexcept {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& entry) { return sum + entry.second; });
}

double SolveTotals::mean() const noexcept {
  return per(static_cast<double>(iterations), static_cast<double>(solves));
}

double RunReport::steps_per_second() const noexcept {
  return per(static_cast<double>(steps), wall_seconds);
}

double RunReport::real_time_factor() const noexcept {
  return per(simulated_seconds, wall_seconds);
}

std::string to_json(const RunReport& report) {
  Json json;
  json["device"] = report.device;
  json["scene"] = report.scene;
  json["solver"] = report.solver;
  json["solver_notice"] = report.solver_notice;
  json["particles"] = report.particles;
  json["steps"] = report.steps;
  json["frames"] = report.frames;
  json["simulated_seconds"] = finite_or_null(report.simulated_seconds);
  json["wall_seconds"] = finite_or_null(report.wall_seconds);
  json["processor_seconds"] = finite_or_null(report.processor_seconds);
  json["start"] = cost_of(report.start);
  json["settling"] = cost_of(report.settling);
  json["settled_file"] = report.settled_file;
  json["steps_per_second"] = finite_or_null(report.steps_per_second());
  json["real_time_factor"] = finite_or_null(report.real_time_factor());
  json["mean_density_error"] = finite_or_null(report.mean_density_error);
  json["maximum_density_error"] = finite_or_null(report.maximum_density_error);
  json["iterations"] = iterations_of(report.solve);
  report.events.each([&](const char* kind, std::uint64_t count) { json["events"][kind] = count; });
  json["no_cavity"] = by_name(report.no_cavity);
  json["air"] = {{"entrapped_litres", finite_or_null(kLitres * report.air.entrapped)},
                 {"by_bodies_litres", finite_or_null(kLitres * report.air.by_bodies)},
                 {"told_litres", finite_or_null(kLitres * report.air.told)},
                 {"thinned_bubbles", report.air.thinned}};
  json["bubble_particles"] = {{"mean_share", finite_or_null(report.air.mean_particles)},
                              {"largest_share", finite_or_null(report.air.largest_particles)}};
  json["invalid_events"] = report.invalid_events;
  json["overdue_events"] = report.overdue_events;
  json["send_failures"] = report.send_failures;
  json["late"] = known_or_null(report.late);
  json["lost"] = known_or_null(report.lost);
  json["shown_frames"] = report.shown;
  json["felt_frames"] = report.felt;
  json["behind"] = report.behind;
  json["slipped_seconds"] = finite_or_null(report.slipped_seconds);
  json["most_behind"] = finite_or_null(report.most_behind);
  json["overload"] = {{"lean_seconds", finite_or_null(report.lean_seconds)},
                      {"coarse_seconds", finite_or_null(report.coarse_seconds)},
                      {"slow_seconds", finite_or_null(report.slow_seconds)}};
  json["skipped"] = {
      {"idle_frames", report.idle_frames},       {"contact_passes", report.without_contacts},
      {"bubble_passes", report.without_bubbles}, {"cavity_searches", report.without_cavities},
      {"kernel_parts", report.kernel_parts},     {"asleep", finite_or_null(report.asleep)}};
  json["refused_poses"] = sum_of(report.refused_poses);
  json["refused"] = {{"poses", by_name(report.refused_poses)},
                     {"datagrams", by_name(report.refused_datagrams)},
                     {"messages", report.refused_messages}};
  json["resets"] = report.resets;
  json["retried_frames"] = report.retried;
  json["calmed_frames"] = report.calmed;
  // A device may call itself anything: bytes that are no UTF-8 are replaced.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_report(const std::filesystem::path& path, const RunReport& report) {
  std::error_code ignored;
  const bool in_place =  // never replace a device or a pipe by a file
      std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored);
  if (in_place) {
    write_text(path, path, to_json(report));
    return;
  }
  const std::filesystem::path draft = path.string() + ".part";
  write_text(draft, path, to_json(report));
  std::error_code renamed;
  std::filesystem::rename(draft, path, renamed);
  if (!renamed) return;
  std::filesystem::remove(draft, ignored);
  throw cannot_write(path, renamed.value());
}

std::string summary(const RunReport& report) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  text << "scene     " << report.scene << ", " << report.particles << " particles on "
       << report.device << '\n';
  text << "time      " << report.simulated_seconds << " s simulated in " << report.wall_seconds
       << " s: real-time factor " << report.real_time_factor() << ", " << std::setprecision(0)
       << report.steps_per_second() << " steps/s\n";
  text << std::setprecision(2) << "cost      " << report.processor_seconds
       << " s of processor; before, ready after " << report.start.wall << " s ("
       << report.start.processor << " s of processor), of which the water took "
       << report.settling.wall << " s (" << report.settling.processor << ") to come to rest"
       << (report.settled_file.empty() ? "" : ", as it is from " + report.settled_file) << '\n';
  text << "pressure  " << report.solver_notice << '\n';
  text << std::setprecision(2) << "density   error mean " << 100.0 * report.mean_density_error
       << " %, maximum " << 100.0 * report.maximum_density_error << " %\n";
  if (report.solve.solves > 0) {
    text << "solver    iterations per step: " << report.solve.mean() << ", at most "
         << report.solve.most << "; given up " << report.solve.given_up << '\n';
  }
  const char* before = "events    ";
  report.events.each([&](const char* kind, std::uint64_t count) {
    text << std::exchange(before, ", ") << count << ' ' << kind;
  });
  put_counts("; impacts without one:", report.no_cavity, text);
  text << '\n';
  text << "air       " << kLitres * report.air.entrapped << " l entrapped ("
       << kLitres * report.air.by_bodies << " by bodies), " << kLitres * report.air.told
       << " l told, " << report.air.thinned << " bubbles over the budget; bubble particles "
       << 100.0 * report.air.mean_particles << " % of the water's on average, "
       << 100.0 * report.air.largest_particles << " % at most\n";
  text << "receivers late " << known_or_dash(report.late) << ", lost " << known_or_dash(report.lost)
       << ", refused by the network " << report.send_failures << '\n';
  text << "skipped   " << 100.0 * report.asleep << " % of the water asleep, of " << report.frames
       << " frames " << report.idle_frames << " idle, " << report.without_contacts
       << " without contacts, " << report.without_bubbles << " without bubbles, "
       << report.without_cavities << " without cavities\n";
  if (const auto refused = sum_of(report.refused_poses); refused > 0) {
    text << "poses     " << refused;
    put_counts(" refused:", report.refused_poses, text);
    text << '\n';
  }
  text << "pacing    " << report.behind << " of " << report.frames << " frames behind, "
       << std::setprecision(3) << report.slipped_seconds << " s slipped, " << report.resets
       << " resets, " << report.calmed << " frames given up, " << report.retried << " retried\n";
  return text.str();
}

}  // namespace splash::sim
