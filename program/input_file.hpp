// SPDX-License-Identifier: MIT
// Checks a file that the command line names before it is read, so that the error names the option
// and not only the file.
#pragma once

#include <filesystem>
#include <string>

namespace splash::program {

/// Throws Failure (kExitNoInput) that names option, file and cause unless `path` is a file that can
/// be read.
void require_readable(const std::string& option, const std::filesystem::path& path);

}  // namespace splash::program
