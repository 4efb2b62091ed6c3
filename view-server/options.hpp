// SPDX-License-Identifier: MIT
// The command line of view-server.
#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// What the command line says: options, or the code to exit with (help and errors are printed).
struct ParsedOptions {
  std::optional<Options> options;
  int exit_code = 0;
};
[[nodiscard]] ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace splash::view
