// SPDX-License-Identifier: MIT
// What a reader says of a file that it refuses.
#pragma once

#include <string>

#include "program/config.hpp"

namespace splash::tests {

/// The words of the program::ConfigError that `read` ends with; empty: it was read.
template <class Read>
std::string refusal(const Read& read) {
  try {
    static_cast<void>(read());
  } catch (const program::ConfigError& error) {
    return error.what();
  }
  return {};
}

}  // namespace splash::tests
