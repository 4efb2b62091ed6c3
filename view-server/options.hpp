// SPDX-License-Identifier: MIT
// The command line of view-server.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/command_line.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::view {

struct Options {
  protocol::Endpoint listen;         ///< for browsers (TCP)
  protocol::Endpoint sim;            ///< sim-server's control (UDP)
  protocol::Endpoint synth;          ///< synth-server's control (UDP)
  protocol::Endpoint sim_show;       ///< sim-server --show (TCP)
  protocol::Endpoint synth_show;     ///< synth-server --show (TCP)
  std::vector<std::string> origins;  ///< further names that the server is reached under
};

using ParsedOptions = program::Parsed<Options>;
[[nodiscard]] ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace splash::view
