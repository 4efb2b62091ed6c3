// SPDX-License-Identifier: MIT
// Files that cannot be read or written: what is said of them.
#pragma once

#include <filesystem>
#include <string>
#include "program/failure.hpp"

namespace splash::program {

// Checks a file that the command line names before it is read, so that the error names the option
// and not only the file.

/// Throws Failure (kExitNoInput) that names option, file and cause unless `path` is a file that can
/// be read.
void require_readable(const std::string& option, const std::filesystem::path& path);

// The error of a file that cannot be written: its cause and what to do about it.

/// Returns cause and cure of an errno value: "No space left on device; free space there or ...".
/// 0: the cause is not known.
[[nodiscard]] std::string write_error(int error);

/// A file could not be written. `what`: "cannot write the report '...'"; `error`: an errno value.
class WriteError : public Failure {
 public:
  WriteError(const std::string& what, int error)
      : Failure(kExitIo, what + ": " + write_error(error)) {}
};

/// Writes the whole file or nothing, by way of a file beside it; what is no file, such as a device,
/// in place. Throws WriteError with `what`.
void write_file(const std::filesystem::path& path, const std::string& text,
                const std::string& what);

}  // namespace splash::program
