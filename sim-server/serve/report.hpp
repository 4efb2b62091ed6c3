// SPDX-License-Identifier: MIT
// The report of a run: as JSON for programs, as a few lines for people.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim-server/fluid/pressure/pressure_solver.hpp"
#include "sim-server/send/event_sender.hpp"
#include "sim-server/serve/pacer.hpp"
#include "sim-server/serve/stopwatch.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// Counts by the name of a reason.
using NamedCounts = std::vector<std::pair<std::string, std::uint64_t>>;
[[nodiscard]] std::uint64_t sum_of(const NamedCounts& counts) noexcept;

struct RunReport {
  std::string device;
  std::string scene;
  std::string solver;         ///< as scene files spell it
  std::string solver_notice;  ///< the same and why (scene/solver_choice.hpp)
  std::int64_t particles = 0;
  double simulated_seconds = 0.0;
  Cost run;                  ///< from the first frame to the last
  Cost start;                ///< before: until kernels and water were ready
  Cost settling;             ///< of it, the water coming to rest
  std::string settled_file;  ///< that the water at rest is from; empty: none
  RunTotals totals;
  SolveWork solve;  ///< without solves: the solver in use needs none
  SendCounts sent;
  std::uint64_t send_failures = 0;    ///< datagrams the kernel refused, all targets
  std::optional<std::uint64_t> late;  ///< events the targets got too late; empty: none answered
  std::optional<std::uint64_t> lost;  ///< bundles the targets missed; empty: none answered
  std::uint64_t shown = 0;            ///< frames that were read back for viewers
  PacerCounts paced;
  double lean_seconds = 0.0;           ///< of wall time with gauges once a second only
  double coarse_seconds = 0.0;         ///< same with longer steps as well
  double slow_seconds = 0.0;           ///< same with simulated time behind the clock as well
  NamedCounts refused_poses;           ///< of trackers, by reason
  NamedCounts refused_datagrams;       ///< at the gate, by reason
  std::uint64_t refused_messages = 0;  ///< by the address table, without the poses above

  /// Per second of wall time [1/s]; not a number when no time passed.
  [[nodiscard]] double steps_per_second() const noexcept;
  /// Simulated time over wall time [1]; not a number when no time passed.
  [[nodiscard]] double real_time_factor() const noexcept;
};

/// Returns the report as JSON; numbers that are not finite become null.
[[nodiscard]] std::string to_json(const RunReport& report);

/// Writes the whole report or nothing, by way of a file beside it. Throws program::WriteError.
void write_report(const std::filesystem::path& path, const RunReport& report);

/// Returns a few lines for the terminal.
[[nodiscard]] std::string summary(const RunReport& report);

}  // namespace splash::sim
