// SPDX-License-Identifier: MIT
// The error of a file that cannot be written: its cause and what to do about it.
#pragma once

#include <string>

#include "program/failure.hpp"

namespace splash::program {

/// Returns cause and cure of an errno value: "No space left on device; free space there or ...".
/// 0: the cause is not known.
[[nodiscard]] std::string write_error(int error);

/// A file could not be written. `what`: "cannot write the report '...'"; `error`: an errno value.
class WriteError : public Failure {
 public:
  WriteError(const std::string& what, int error)
      : Failure(kExitIo, what + ": " + write_error(error)) {}
};

}  // namespace splash::program
