// SPDX-License-Identifier: MIT
// Why a file could not be written, and what to do about it.
#pragma once

#include <string>

#include "program/failure.hpp"

namespace splash::program {

/// "No space left on device; free space there or ..." for an errno value; 0: nothing is known.
[[nodiscard]] std::string write_error(int error);

/// A file could not be written. `what`: "cannot write the report '...'"; `error`: an errno value.
class WriteError : public Failure {
 public:
  WriteError(const std::string& what, int error)
      : Failure(kExitIo, what + ": " + write_error(error)) {}
};

}  // namespace splash::program
