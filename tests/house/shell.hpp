// SPDX-License-Identifier: MIT
// Runs a command as a user would type it.
#pragma once

#include <string>

namespace splash::house {

struct CommandResult {
  int exit_code = -1;  ///< -1: could not be run, or killed
  std::string output;  ///< standard output and error together
};

CommandResult run_command(const std::string& command);

}  // namespace splash::house
