// SPDX-License-Identifier: MIT
// Where the scenes, references and recordings lie that tests and benchmarks read.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace splash::tests {

/// The source tree, or the folder with the same configs/ and tests/ that $SPLASH_SOURCE_DIR names,
/// as in a bundle (./splash bundle).
inline std::filesystem::path source_folder() {
  const char* moved = std::getenv("SPLASH_SOURCE_DIR");
  return moved == nullptr || *moved == '\0' ? SPLASH_SOURCE_DIR : moved;
}

}  // namespace splash::tests
