// SPDX-License-Identifier: MIT
// The command line of sim-server.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "program/command_line.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::sim {

struct Options {
  std::filesystem::path scene;
  std::filesystem::path tracker;  ///< a marker file that replaces the scene's; empty: none
  std::vector<protocol::Endpoint> targets;
  protocol::Endpoint listen;
  std::vector<std::uint32_t> allow;  ///< hosts besides loopback that may control (IPv4)

  std::optional<protocol::Endpoint> show;  ///< where viewers are let in; empty: nowhere

  std::filesystem::path record;   ///< event log to write; empty: none
  bool record_forces = false;     ///< with the forces on bodies
  std::filesystem::path report;   ///< JSON to write; empty: none
  std::filesystem::path vtk;      ///< folder for the water, for ParaView; empty: none
  std::filesystem::path gauges;   ///< CSV to write the scene's gauges to; empty: none
  std::filesystem::path settled;  ///< keeps the water at rest; empty: none
  double duration = 0.0;          ///< simulated seconds; 0: until it is stopped
  bool real_time = true;
  bool quiet = false;  ///< no line on the state every two seconds

  bool check = false;  ///< say what the scene is, and end
  bool list_devices = false;
  int check_device = -1;  ///< only test this one, as --list-devices counts
  std::string device;     ///< its number, a part of its name, "gpu" or "cpu"; empty: chosen
};

using ParsedOptions = program::Parsed<Options>;
[[nodiscard]] ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace splash::sim
