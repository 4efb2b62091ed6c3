// SPDX-License-Identifier: MIT
// Errors that end the program. Each kind is a class of its own with one exit code, which tells
// scripts what was wrong: where an error is caught never changes what it is reported as.
#pragma once

#include <stdexcept>
#include <string>

#include "program/exit_codes.hpp"

namespace splash::program {

/// The base of all kinds, for main() alone: who catches it anywhere else catches them all.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// A file holds something else than it should.
class DataError : public Failure {
 public:
  explicit DataError(const std::string& text) : Failure(kExitData, text) {}
};

/// Runs `action`. An exception of `Kind` that it throws ends the program with `code`; a Failure
/// and exceptions of other kinds pass as they are.
template <class Kind, class Action>
auto failing_with(ExitCode code, Action&& action) {
  try {
    return action();
  } catch (const Failure&) {
    throw;
  } catch (const Kind& error) {
    throw Failure(code, error.what());
  }
}

}  // namespace splash::program
