// SPDX-License-Identifier: MIT
// Why a file could not be written, and what to do about it.
#pragma once

#include <string>

namespace splash::protocol {

/// "No space left on device; free space there or ..." for an errno value; 0: nothing is known.
[[nodiscard]] std::string write_error(int error);

}  // namespace splash::protocol
