// SPDX-License-Identifier: MIT
// Errors that end the program, with the exit code that tells scripts what was wrong.
#pragma once

#include <stdexcept>
#include <string>

#include "program/exit_codes.hpp"

namespace splash::program {

class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// Runs `action`; whatever std::exception it throws ends the program with `code`.
template <class Action>
auto failing_with(ExitCode code, Action&& action) {
  try {
    return action();
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& error) {
    throw Failure(code, error.what());
  }
}

}  // namespace splash::program
