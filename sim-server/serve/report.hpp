// SPDX-License-Identifier: MIT
// The report of a run: as JSON for programs, as a few lines for people.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/event.hpp"
#include "sim-server/serve/stopwatch.hpp"

namespace splash::sim {

class Overload;
class Simulation;
struct PacerCounts;
struct SendCounts;

/// Totals over all solves of a pressure solver that iterates.
struct SolveTotals {
  std::int64_t solves = 0;  ///< one per step; 0: the solver in use needs none
  std::int64_t iterations = 0;
  std::int64_t most = 0;      ///< iterations of one solve
  std::int64_t given_up = 0;  ///< solves that ended with more than the allowed error

  /// Iterations per step [1]; not a number without solves.
  [[nodiscard]] double mean() const noexcept;
};

/// The air that the water entrapped, and the bubble particles that mark its places.
struct AirReport {
  double entrapped = 0.0;          ///< [m3]
  double by_bodies = 0.0;          ///< of it [m3]
  double told = 0.0;               ///< in bubbles [m3]
  std::uint64_t thinned = 0;       ///< bubbles over the scene's budget, told in larger ones
  double mean_particles = 0.0;     ///< bubble particles alive, in particles of water, mean [1]
  double largest_particles = 0.0;  ///< same, largest [1]
};

/// Counts by the name of a reason.
using NamedCounts = std::vector<std::pair<std::string, std::uint64_t>>;
[[nodiscard]] std::uint64_t sum_of(const NamedCounts& counts) noexcept;

struct RunReport {
  std::string device;
  std::string scene;
  std::string solver;         ///< as scene files spell it
  std::string solver_notice;  ///< the same and why (scene/solver_choice.hpp)
  std::int64_t particles = 0;
  std::int64_t steps = 0;
  std::int64_t frames = 0;
  double simulated_seconds = 0.0;
  double wall_seconds = 0.0;
  double processor_seconds = 0.0;      ///< same, of all processors
  Cost start;                          ///< before: until kernels and water were ready
  Cost settling;                       ///< of it, the water coming to rest
  std::string settled_file;            ///< that the water at rest is from; empty: none
  double mean_density_error = 0.0;     ///< of the compressed part, in the rest density [1]
  double maximum_density_error = 0.0;  ///< same [1]
  SolveTotals solve;
  protocol::ByKind<std::uint64_t> events;
  NamedCounts no_cavity;  ///< impacts that none followed, by reason
  AirReport air;
  std::uint64_t invalid_events = 0;    ///< outside the wire's ranges, not sent
  std::uint64_t overdue_events = 0;    ///< their moment had passed when they were sent
  std::uint64_t send_failures = 0;     ///< datagrams the kernel refused, all targets
  std::optional<std::uint64_t> late;   ///< events the targets got too late; empty: none answered
  std::optional<std::uint64_t> lost;   ///< bundles the targets missed; empty: none answered
  std::uint64_t shown = 0;             ///< frames that were read back for viewers
  std::uint64_t felt = 0;              ///< frames whose forces on bodies were found
  std::uint64_t behind = 0;            ///< frames that were late against the wall clock
  double slipped_seconds = 0.0;        ///< simulated time given up to stay in real time
  double most_behind = 0.0;            ///< the latest frame [s]
  double lean_seconds = 0.0;           ///< of wall time with gauges once a second only
  double coarse_seconds = 0.0;         ///< same with longer steps as well
  double slow_seconds = 0.0;           ///< same with simulated time behind the clock as well
  std::uint64_t idle_frames = 0;       ///< nothing was computed: all water slept
  std::uint64_t without_contacts = 0;  ///< frames that did not look for impacts
  std::uint64_t without_bubbles = 0;   ///< same for bubbles
  std::uint64_t without_cavities = 0;  ///< same for cavities
  int kernel_parts = 0;                ///< that the kernels were built without
  double asleep = 0.0;                 ///< share of the particles that slept, on average [1]
  NamedCounts refused_poses;           ///< of trackers, by reason
  NamedCounts refused_datagrams;       ///< at the gate, by reason
  std::uint64_t refused_messages = 0;  ///< by the address table, without the poses above
  std::uint64_t retried = 0;           ///< frames that went well only with shorter steps
  std::uint64_t calmed = 0;            ///< frames given up, and the water around a fault stopped
  std::uint64_t resets = 0;            ///< times the fluid had to be set up anew

  /// Per second of wall time [1/s]; not a number when no time passed.
  [[nodiscard]] double steps_per_second() const noexcept;
  /// Simulated time over wall time [1]; not a number when no time passed.
  [[nodiscard]] double real_time_factor() const noexcept;
};

/// Returns the report without the device, the wall time and the counts of targets and trackers.
[[nodiscard]] RunReport report_on(const Simulation& simulation, const SendCounts& sent,
                                  const PacerCounts& paced, const Overload& overload);

/// Returns the report as JSON; numbers that are not finite become null.
[[nodiscard]] std::string to_json(const RunReport& report);

/// Writes the whole report or nothing, by way of a file beside it. Throws program::WriteError.
void write_report(const std::filesystem::path& path, const RunReport& report);

/// Returns a few lines for the terminal.
[[nodiscard]] std::string summary(const RunReport& report);

}  // namespace splash::sim
