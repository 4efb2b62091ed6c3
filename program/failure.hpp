// SPDX-License-Identifier: MIT
// Errors that end the program, and how they do. Each kind is a class of its own with one exit code,
// which tells scripts what was wrong: where an error is caught never changes what it is reported
// as.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace splash::program {

// The programs' exit codes, those of sysexits(3); docs/running.md lists them for users.

enum ExitCode : int {
  kExitOk = 0,
  kExitUsage = 64,        ///< the command line
  kExitData = 65,         ///< a file that holds something else than it should
  kExitNoInput = 66,      ///< a file that cannot be read
  kExitUnavailable = 69,  ///< no port, no OpenCL, no such device
  kExitInternal = 70,     ///< an internal error
  kExitIo = 74,           ///< a file that cannot be written
  kExitConfig = 78,       ///< an error in a scene or rig file
};

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

/// Calls `run` and returns the exit code of the program. An exception that ends it is printed to
/// standard error: after the name `program`, unless its text begins with a file and a line.
[[nodiscard]] int exit_code_of(const char* program, const std::function<void()>& run);

}  // namespace splash::program
